/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The one door to the engine: a piece of clay with its surface and its history. Strokes are begun, dabbed and
 *          ended here; undo, redo, patches, meshes, files and digests are asked for here.
 * Is not:  The person's state (station: what is moved, which tool is in the hand); drawing (view); files other programs
 *          read (exchange).
 * Shape:   world = step_mm * key: corner (i,j,k) lies at (i, j, k) * step_mm. A dab goes tool -> clay -> surface in
 *          one call, so patches are always those of the clay.
 * Units:   millimetres and seconds outside, lattice steps inside.
 * Owner:   the caller owns the struct (large: keep it on the heap); the byte store must outlive it.
 *          All calls belong to one thread. History is written by the keeper: at once, in that same thread, until one
 *          with a thread of its own is given (sculpture_keeper_set).
 * Errors:  a refused dab leaves the clay as before the dab. A stroke that the surface refuses ends (in_stroke is false)
 *          where it was last handed to the keeper (sculpture_part; before the first time: as before the stroke). A
 *          refused undo or redo leaves everything. The status says why.
 * Cost:    see tool.h, surface.h, history.h; sculpture adds nothing per corner. Threads (clay.crew, lattice/crew.h) and
 *          vectors (clay.rows, lattice/lanes.h) are set after opening by whoever has them; the bits are the same.
 * Source:  000 sections 3 and 4.
 */
#ifndef GLAISE_SCULPTURE_SCULPTURE_H
#define GLAISE_SCULPTURE_SCULPTURE_H

#include "clay/capacity.h"
#include "clay/colour.h"
#include "clay/freeze.h"
#include "clay/reconstruct.h"
#include "history/check.h"
#include "history/keeper.h"
#include "surface/mesh.h"
#include "surface/surface.h"
#include "tool/ellipsoid.h"
#include "tool/freeform.h"
#include "tool/tool.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SCULPTURE_STEP_MM_DEFAULT 1.0
#define SCULPTURE_STEP_MM_MIN 1e-3
#define SCULPTURE_STEP_MM_MAX 1e3

/* Jobs under way to the keeper, and how many of them may be parts of strokes that are not over: those can wait and
   become one. */
enum { SCULPTURE_JOBS = 64, SCULPTURE_PARTS = 4 };

typedef struct sculpture_jobs {
    keeper_job at[SCULPTURE_JOBS]; /* a ring: [first .. first + count) modulo SCULPTURE_JOBS */
    uint32_t first, count, puts;
    keeper_job *fetch; /* the one whose answer is awaited, or NULL */
    keeper_job checkpoint;
    freeze field;      /* while the checkpoint is written */
    bool writes_field;
} sculpture_jobs;

typedef struct sculpture {
    double step_mm;
    struct clay clay;
    struct surface surface;
    tool_scratch scratch;
    struct history history; /* the keeper's */
    struct keeper keeper;
    sculpture_jobs jobs;
    bool has_history; /* false: no store was given, a stroke cannot be undone */
    bool in_stroke;
    bool stroke_changed; /* so far */
    uint64_t dab;     /* number of the next dab */
    uint64_t strokes; /* ended with a change since opening */
} sculpture;

/* A dab as the station gives it: world space, per second. */
typedef struct sculpture_dab {
    frame at_world;     /* mm */
    double rate;        /* potential per second (parts per second for smooth, stamp, print, painter) */
    double seconds;     /* since the dab before */
} sculpture_dab;

typedef struct sculpture_counts {
    tool_counts tool;
    surface_counts surface;
} sculpture_counts;

/* store NULL: no history. bricks: the limit (CAPACITY_BRICKS). settings NULL: HISTORY_SETTINGS_DEFAULT. */
STATUS_CHECKED status sculpture_open(sculpture *s, const byte_store *store, uint32_t bricks,
                                     const history_settings *settings, double step_mm, history_finding *finding_out);
/* Waits until all is kept, and writes a checkpoint when something changed since the last. The struct is finished
   whatever the answer. */
STATUS_CHECKED status sculpture_close(sculpture *s);

/* Waits for what was handed to the keeper so far, and goes on with another, which sculpture_close is not to find any
   more: NULL is in place. */
void sculpture_keeper_set(sculpture *s, const keeper *k);
/* Takes in what the keeper has done, and gives it what it wants. Once a frame; never waits. */
void sculpture_attend(sculpture *s);
/* How history stands. Without one: all zero, room STATUS_OK. */
keeper_facts sculpture_facts(sculpture *s);

/* May a stroke begin? */
STATUS_CHECKED status sculpture_room(sculpture *s);
void sculpture_stroke_begin(sculpture *s);
/* Hands what the stroke has done so far to the keeper; every 100 ms at the latest, so that a cut costs no more. */
void sculpture_part(sculpture *s);
/* counts_out: NULL where nobody counts, here and in the halves below; counting costs more than the dab. */
STATUS_CHECKED status sculpture_apply(sculpture *s, const tool *t, const sculpture_dab *d,
                                      sculpture_counts *counts_out);
/* The two halves of sculpture_apply, for those who time them apart: the field, then the surface. */
STATUS_CHECKED status sculpture_apply_field(sculpture *s, const tool *t, const sculpture_dab *d,
                                            tool_counts *counts_out);
STATUS_CHECKED status sculpture_apply_surface(sculpture *s, surface_counts *counts_out);
STATUS_CHECKED status sculpture_stroke_end(sculpture *s);

/* A step through history, in two halves: what it changes is read; when that is ready, the clay goes there. In between
   no stroke begins and no other step. way, stroke: see history_way. */
void sculpture_step_begin(sculpture *s, history_way way, uint64_t stroke);
bool sculpture_step_is_ready(sculpture *s);
/* Waits where it is not ready. */
STATUS_CHECKED status sculpture_step_end(sculpture *s);
/* Both halves. */
STATUS_CHECKED status sculpture_step(sculpture *s, history_way way, uint64_t stroke);
STATUS_CHECKED status sculpture_undo(sculpture *s);
STATUS_CHECKED status sculpture_redo(sculpture *s);

/* Makes the clay as it is now a tool (freeform.h). */
STATUS_CHECKED status sculpture_duplicate(const sculpture *s, freeform *tool_out);
/* Empties the clay as one stroke, so that it can be undone. Not during a stroke. */
STATUS_CHECKED status sculpture_clear(sculpture *s);

/* Looks through a store without changing it (history/check.h). */
STATUS_CHECKED status sculpture_check(const byte_store *store, check_teller tell, void *self, check_facts *facts_out);
/* Renames a file of a store that is not open, so that opening does not see it (history/stored_file.h). */
STATUS_CHECKED status sculpture_set_aside(const byte_store *store, const char *file);

/* Native file (still.h writes it): replaces the clay whole as one stroke, or not at all; a step other than the
   sculpture's is STATUS_BAD_PARAMETER unless the sculpture is empty and keeps no history (then it takes the step). */
STATUS_CHECKED status sculpture_read(sculpture *s, checkpoint_source source, void *self,
                                     checkpoint_trouble *trouble_out);

/* The box that just holds the surface, mm; false when there is none. Looks at every vertex. */
bool sculpture_bounds_mm(const sculpture *s, double lo_out[3], double hi_out[3]);

/* Field and step. The mesh's own is surface_digest(&s->surface). */
uint64_t sculpture_digest(const sculpture *s);
/* The same for a clay_digest that is known (keeper_facts). */
uint64_t sculpture_digest_of(double step_mm, uint64_t clay_digest);

#ifdef __cplusplus
}
#endif
#endif
