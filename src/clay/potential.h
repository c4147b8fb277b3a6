/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The three numbers that define the field: its range and the value at which the surface lies.
 * Is not:  A density or a distance; how far a value reaches is the tool's affair.
 * Units:   none: a potential has no dimension.
 * Source:  000 section 3.1 (minVal = 0, maxVal = 3). The papers print no iso; it has to be the middle of the range,
 *          or the stamp's "s = iso" and "def is 0 on the tool's surface" contradict each other.
 */
#ifndef GLAISE_CLAY_POTENTIAL_H
#define GLAISE_CLAY_POTENTIAL_H

#define POTENTIAL_MIN 0.0f /* a corner at or under it is not stored */
#define POTENTIAL_MAX 3.0f /* a corner above it is clamped to it */
#define POTENTIAL_FAINT 0.002f /* smoothing leaves nothing at or under it: else it would creep on for ever */
#define POTENTIAL_ISO 1.5f /* inside means >= iso, equality included, everywhere */

#endif
