/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   which names a C or C++ file declares at file scope, how long its functions are, and which variables of it
 *         outlive a call and can change.
 * Is not: a compiler. It knows the declarations this tree is written in: no macro that opens a brace, no K&R parameter
 *         lists. Members of structs and classes are no file-scope names; operators and qualified names (a::b) neither.
 * Errors: text with unbalanced brackets ends the scan where the text ends.
 * Cost:   linear in the text.
 */
#ifndef GLAISE_CONFORMANCE_SOURCE_SCAN_H
#define GLAISE_CONFORMANCE_SOURCE_SCAN_H

#include <string>
#include <string_view>
#include <vector>

enum class source_scan_kind { function, type, forward, variable, enumerator, macro, name_space };

struct source_scan_name {
    source_scan_kind kind;
    std::string name;
    int line;
};

/* A function with a body, methods and file-scope functions alike; lambdas count with the function around them. */
struct source_scan_body {
    std::string name;
    int first_line; /* where its declaration starts */
    int last_line;  /* of the closing brace */
};

/* A variable with static storage that is not constant, at file scope or static in a function. */
struct source_scan_mutable {
    std::string name;
    int line;
};

struct source_scan {
    std::vector<source_scan_name> names;
    std::vector<source_scan_body> bodies;
    std::vector<source_scan_mutable> mutables;
};

source_scan source_scan_text(std::string_view text);

const char *source_scan_kind_text(source_scan_kind kind);

#endif
