/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Everything a benchmark prints, once more as JSON: a list of objects, one a row.
 * Is not:  The table for people.
 * Shape:   [{"section": "dab", "object": "1M", "field_us": 12.5, ...}, ...]
 * Owner:   the caller owns the record, the record its rows.
 * Errors:  write answers false when the file cannot be written.
 */
#ifndef GLAISE_BENCH_BENCH_RECORD_H
#define GLAISE_BENCH_BENCH_RECORD_H

#include <string>
#include <utility>
#include <vector>

class bench_record {
public:
    using word = std::pair<const char *, std::string>;
    using number = std::pair<const char *, double>;

    void add(const char *section, const std::vector<word> &words, const std::vector<number> &numbers);
    bool write(const std::string &file) const;

private:
    std::vector<std::string> rows;
};

#endif
