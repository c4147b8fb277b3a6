/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A piece as it is at one moment, for whoever writes it out: a file takes seconds, a freezing some
 *          milliseconds, and after that sculpting goes on.
 * Is not:  A sculpture: nothing can be done to it. Formats (exchange).
 * Units:   as the sculpture's.
 * Owner:   the caller owns the struct. still_begin and still_end belong to the sculpture's thread; in between any one
 *          thread may write it out or take its mesh.
 * Errors:  as freeze_begin (clay/freeze.h), checkpoint_write and mesh_init; the still stays as it is.
 * Cost:    still_begin: clay/freeze.h. still_mesh makes the whole surface (some 3 us a patch) and welds it.
 */
#ifndef GLAISE_SCULPTURE_STILL_H
#define GLAISE_SCULPTURE_STILL_H

#include "clay/freeze.h"
#include "sculpture/sculpture.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct still {
    freeze field;
    double step_mm;
    uint64_t dab; /* number of the next dab */
} still;

STATUS_CHECKED status still_begin(still *s, sculpture *of);
void still_end(still *s);

/* The native file: the whole field. */
STATUS_CHECKED status still_write(still *s, checkpoint_sink sink, void *self);
/* The surface, welded; the caller finishes it. */
STATUS_CHECKED status still_mesh(const still *s, mesh *mesh_out);

#ifdef __cplusplus
}
#endif
#endif
