/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A sink that keeps what it is given and fails after a set number of bytes, and a source over kept bytes.
 * Is not:  A file.
 * Errors:  past `room` the sink keeps what still fits and answers STATUS_IO; calls after that are counted.
 */
#ifndef GLAISE_EXCHANGE_BUCKET_H
#define GLAISE_EXCHANGE_BUCKET_H

#include "sculpture/sculpture.h"

#include <string>

struct bucket {
    std::string bytes;
    size_t room = SIZE_MAX;
    bool failed = false;
    int calls_after_failure = 0;
};

status bucket_put(void *self, const void *bytes, size_t n);
status bucket_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out);

#endif
