/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The outcomes a C room can report. A function that returns `status` must have its answer looked at.
 * Is not:  Absence (no corner, no brick), which is a state; a bug of ours, which is an assert.
 * Errors:  After anything but STATUS_OK the thing acted on is as it was before the call.
 */
#ifndef GLAISE_LATTICE_STATUS_H
#define GLAISE_LATTICE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

#define STATUS_CHECKED __attribute__((warn_unused_result))

typedef enum status {
    STATUS_OK = 0,
    STATUS_POOL_FULL,     /* a pool reached its named limit */
    STATUS_NO_MEMORY,     /* the machine gave no memory below that limit */
    STATUS_BAD_POSE,      /* NaN, singular, or a scale outside the stated range */
    STATUS_BAD_PARAMETER, /* a setting outside its stated range */
    STATUS_OUT_OF_RANGE,  /* would touch corners beyond KEY_MIN..KEY_MAX */
    STATUS_TOO_LARGE,     /* one dab larger than its named limit */
    STATUS_HISTORY_ENDS,  /* nothing older (undo) or newer (redo) is kept */
    STATUS_IO,            /* the byte store failed; errno-like detail is the store's to tell */
    STATUS_NO_SPACE,      /* the byte store is full */
    STATUS_BUSY,          /* the byte store has not caught up yet */
    STATUS_CORRUPT,       /* bytes are not what their checksum or format promises */
    STATUS_NEWER,         /* written by a version later than this one */
} status;

/* One lower-case sentence without a full stop, static storage. Never fails. */
const char *status_text(status s);

#ifdef __cplusplus
}
#endif
#endif
