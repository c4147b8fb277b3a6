/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Text put together out of pieces and numbers in an array of the caller's: findings, names of files.
 * Is not:  printf (the C rooms know no stdio); any language but the one the pieces are in.
 * Shape:   always ends in a zero byte; what does not fit is cut off.
 * Owner:   the caller owns the array.
 * Errors:  None.
 */
#ifndef GLAISE_HISTORY_SENTENCE_H
#define GLAISE_HISTORY_SENTENCE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct sentence {
    char *text;
    size_t room, length; /* length < room */
} sentence;

/* Empties the array; room >= 1. */
sentence sentence_begin(char *text, size_t room);
void sentence_add(sentence *s, const char *piece);
/* In decimal, with leading zeros up to that many digits. */
void sentence_add_number(sentence *s, uint64_t number, int digits_min);

#ifdef __cplusplus
}
#endif
#endif
