/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Bytes that grow as needed and keep their memory until the end.
 * Is not:  A bounded block (checkpoint.c streams through one).
 * Owner:   the caller; a zeroed struct is an empty buffer.
 * Errors:  STATUS_NO_MEMORY; bytes and size are then as they were.
 * Cost:    room at least doubles whenever it grows.
 */
#ifndef GLAISE_HISTORY_BYTE_BUFFER_H
#define GLAISE_HISTORY_BYTE_BUFFER_H

#include "lattice/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct byte_buffer {
    uint8_t *bytes;
    size_t size, room;
} byte_buffer;

/* Room for `room` bytes in all; size stays. */
STATUS_CHECKED status byte_buffer_reserve(byte_buffer *b, size_t room);
void byte_buffer_finish(byte_buffer *b);

#ifdef __cplusplus
}
#endif
#endif
