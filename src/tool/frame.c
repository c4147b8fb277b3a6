/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/frame.h"

#include <math.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

status frame_invert(const frame *f, double row_out[3][3])
{
    double lengths = 1;
    for (int a = 0; a < 3; a++) {
        double length = sqrt(dot(f->axis[a], f->axis[a]));
        /* Written so that NaN fails too. */
        if (!(length >= FRAME_AXIS_MIN && length <= FRAME_AXIS_MAX) || !isfinite(f->origin[a]))
            return STATUS_BAD_POSE;
        lengths *= length;
    }
    double normal[3][3];
    for (int a = 0; a < 3; a++)
        cross(f->axis[(a + 1) % 3], f->axis[(a + 2) % 3], normal[a]);
    double volume = dot(f->axis[0], normal[0]);
    if (!(fabs(volume) >= FRAME_FLAT * lengths))
        return STATUS_BAD_POSE;
    for (int a = 0; a < 3; a++)
        for (int c = 0; c < 3; c++)
            row_out[a][c] = normal[a][c] / volume;
    return STATUS_OK;
}
