/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Counts one dab as paper 000 section 6 does: visited, computed and dirtied corners.
 * Is not:  The dab (tool.h), which does not need the counts and does not look at corners one by one.
 * Shape:   the walk's definition, corner by corner: transformed by addition, tested against the tool's own box, its
 *          potential evaluated, the action asked for a contribution.
 * Errors:  None: the walk has begun.
 * Cost:    some nanoseconds a visited corner.
 * Source:  000 sections 3.2, 6.
 */
#ifndef GLAISE_TOOL_CENSUS_H
#define GLAISE_TOOL_CENSUS_H

#include "tool/action.h"
#include "tool/tool.h"
#include "tool/walk.h"

#ifdef __cplusplus
extern "C" {
#endif

tool_counts census_take(const shape *form, const action_setting *set, const walk *w);

#ifdef __cplusplus
}
#endif
#endif
