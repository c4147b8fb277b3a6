/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a tool does to a corner it reaches: the papers' actions, as functions of the corner, its neighbours
 *          and the tool's potential there.
 * Is not:  The walk (walk.h), the writing (tool.h), or fast: this is the definition, corner by corner, that the vectors
 *          of action_rows.h are held to, bit by bit.
 * Shape:   w = v_tool / 3 in (0, 1]; amount = rate x time of the dab.
 *              toothpaste    F + min(amount w, 3 - F)   colour mixed by contribution; a full corner takes no more
 *              soft eraser   F - amount w
 *              eraser        removed where w > 0
 *              painter       the tool's colour where w > 0 and the corner exists
 *              soft painter  colour mixed, the tool weighing amount w against F
 *              smooth        F + min(amount,1) w (L[F] - F), L = binomial [1 2 1]/4 on each axis, old values; what is
 *                            left at or under POTENTIAL_FAINT is removed
 *              stamp         F + min(amount,1) def(3 - v_tool)      the long paper: a contribution
 *              print         F + min(amount,1) def(3 - v_tool) F    the short paper: a ratio of what is there
 * Units:   potential; amount in potential (or parts of one for smooth, stamp, print).
 * Errors:  None: total functions; results are clamped by clay_brick_close.
 * Source:  000 sections 4.2, 4.3; 002 section 2.2. We differ: clay pushed into empty space by smooth or stamp takes
 *          the mean colour of the clay round it; the papers do not say.
 */
#ifndef GLAISE_TOOL_ACTION_H
#define GLAISE_TOOL_ACTION_H

#include "clay/brick.h"
#include "tool/deform.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum action {
    ACTION_TOOTHPASTE,
    ACTION_SOFT_ERASER,
    ACTION_ERASER,
    ACTION_PAINTER,
    ACTION_SOFT_PAINTER,
    ACTION_SMOOTH,
    ACTION_STAMP, /* contribution */
    ACTION_PRINT, /* ratio */
} action;
enum { ACTION_COUNT = 8 };

/* A dab's constants, as the actions need them. */
typedef struct action_setting {
    action kind;
    uint32_t rgba;
    float amount;
    const deform *def; /* stamp and print */
    uint64_t dab;      /* number of the dab, for the dither */
} action_setting;

/* Name as tapes and screens write it: "toothpaste", "soft-eraser", ... Static storage. */
const char *action_name(action a);
/* Does the action read neighbours (and so need an apron)? */
bool action_reads_neighbours(action a);
/* Can it make clay where there was none? */
bool action_makes_clay(action a);
/* Is there a contribution where the tool's potential is v_tool > 0? (dirtied, in the paper's count) */
bool action_contributes(const action_setting *s, float v_tool);

/* Acts on the eight corners of a row, those with a bit in `mask`. potential and rgba: in as they were, out as they
   become (clay_brick_close clamps). Neighbour readers get the apron (side ACTION_APRON_SIDE, clay/apron.h) from the
   row's first corner on; others pass NULL. */
enum { ACTION_APRON_SIDE = 10 };
/* Mean colour of the clay round a corner, the nearer and denser the weightier; the tool's where there is no clay. */
uint32_t action_colour_round(const action_setting *s, const float *apron, const uint32_t *apron_rgba);
void action_row(const action_setting *s, key first, unsigned mask, const float v_tool[8], const float *apron_potential,
                const uint32_t *apron_rgba, float potential[8], uint32_t rgba[8]);

#ifdef __cplusplus
}
#endif
#endif
