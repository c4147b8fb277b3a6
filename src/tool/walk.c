/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/walk.h"

#include "clay/capacity.h"

#include <float.h>
#include <math.h>

/* floor, brought into the lattice. */
static int32_t key_floor(double x)
{
    double f = floor(x);
    f = f < (double)KEY_MIN ? (double)KEY_MIN : f;
    f = f > (double)KEY_MAX ? (double)KEY_MAX : f;
    return (int32_t)f;
}

/* The bricks of the ellipsoid that the frame makes of the unit ball: it reaches less far than its axes' sum. */
static box ball_bricks(const frame *f)
{
    int32_t lo[3], hi[3];
    for (int c = 0; c < 3; c++) {
        double squared = 0;
        for (int a = 0; a < 3; a++)
            squared += f->axis[a][c] * f->axis[a][c];
        double extent = sqrt(squared) * (1 + 1e-6); /* tool space knows floats only */
        lo[c] = key_floor(f->origin[c] - extent);
        hi[c] = key_floor(f->origin[c] + extent);
    }
    const box corners = {{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
    return box_of_bricks(corners);
}

/* Range of corners per axis from floor(c - e) to floor(c + e), of the box round the oriented box. */
static status range_set(walk *w, const frame *f)
{
    int32_t lo[3], hi[3];
    for (int c = 0; c < 3; c++) {
        double centre = f->origin[c], extent = 0;
        for (int a = 0; a < 3; a++) {
            centre += f->axis[a][c] * (w->lo[a] + w->hi[a]) * 0.5;
            extent += fabs(f->axis[a][c]) * (w->hi[a] - w->lo[a]) * 0.5;
        }
        double first = floor(centre - extent), last = floor(centre + extent);
        if (!(last >= (double)KEY_MIN && first <= (double)KEY_MAX)) /* an endless shape makes NaN */
            return STATUS_OUT_OF_RANGE;
        lo[c] = key_floor(centre - extent);
        hi[c] = key_floor(centre + extent);
    }
    w->corners = (box){{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}};
    w->visited = box_count(w->corners);
    w->reached = w->is_ball ? ball_bricks(f) : box_of_bricks(w->corners);
    w->bricks = box_of_bricks(w->corners);
    return box_count(w->bricks) > CAPACITY_DAB_BRICKS ? STATUS_TOO_LARGE : STATUS_OK;
}

status walk_begin(walk *w, const frame *f, const shape *s)
{
    status outcome = frame_invert(f, w->row);
    if (outcome != STATUS_OK)
        return outcome;
    for (int a = 0; a < 3; a++) {
        w->origin[a] = f->origin[a];
        w->lo[a] = s->lo[a];
        w->hi[a] = s->hi[a];
        for (int n = 0; n < 8; n++)
            w->along[a][n] = (float)(w->row[a][0] * n);
        for (int n = 0; n < 64; n++)
            w->plane[a][n] = (float)(w->row[a][1] * (n >> 3) + w->row[a][2] * (n & 7));
    }
    w->is_ball = s->is_ball;
    for (int a = 0; a < 3; a++) {
        const double bound = walk_bound(w, a);
        w->slab_middle[a] = (float)(3.5 * (w->row[a][1] + w->row[a][2]));
        w->slab_reach[a] = (float)(3.5 * (fabs(w->row[a][1]) + fabs(w->row[a][2])) + bound);
        w->brick_reach[a] = 3.5 * (fabs(w->row[a][0]) + fabs(w->row[a][1]) + fabs(w->row[a][2])) + bound;
    }
    return range_set(w, f);
}

double walk_bound(const walk *w, int a)
{
    double size = fabs(w->lo[a]) > fabs(w->hi[a]) ? fabs(w->lo[a]) : fabs(w->hi[a]);
    for (int c = 0; c < 3; c++)
        size += 8 * fabs(w->row[a][c]);
    return 4 * FLT_EPSILON * size;
}

static void to_tool(const walk *w, double i, double j, double k, double out[3])
{
    double d[3] = {i - w->origin[0], j - w->origin[1], k - w->origin[2]};
    for (int a = 0; a < 3; a++)
        out[a] = w->row[a][0] * d[0] + w->row[a][1] * d[1] + w->row[a][2] * d[2];
}

/* Middle of a brick in tool space. */
static void brick_middle(const walk *w, key brick_at, double middle_out[3])
{
    key first = key_of_brick(brick_at);
    to_tool(w, first.i + 3.5, first.j + 3.5, first.k + 3.5, middle_out);
}

static bool is_in_box(const walk *w, const double middle[3])
{
    for (int a = 0; a < 3; a++)
        if (middle[a] - w->brick_reach[a] > w->hi[a] || middle[a] + w->brick_reach[a] < w->lo[a])
            return false;
    return true;
}

bool walk_touches(const walk *w, key brick_at)
{
    double middle[3];
    brick_middle(w, brick_at, middle);
    return is_in_box(w, middle);
}

bool walk_reaches(const walk *w, key brick_at)
{
    double middle[3], squared = 0;
    brick_middle(w, brick_at, middle);
    for (int a = 0; a < 3 && w->is_ball; a++) {
        double gap = fabs(middle[a]) - w->brick_reach[a];
        squared += gap > 0 ? gap * gap : 0;
    }
    return is_in_box(w, middle) && squared <= 1;
}

void walk_start(const walk *w, key brick_at, float start_out[3])
{
    key first = key_of_brick(brick_at);
    double p[3];
    to_tool(w, first.i, first.j, first.k, p);
    for (int a = 0; a < 3; a++)
        start_out[a] = (float)p[a];
}

void walk_row(const walk *w, const float start[3], int di, int dj, float x[8], float y[8], float z[8])
{
    float *out[3] = {x, y, z};
    for (int a = 0; a < 3; a++) {
        float at = start[a] + w->along[a][di];
        for (int n = 0; n < 8; n++)
            out[a][n] = at + w->plane[a][dj * 8 + n];
    }
}

unsigned walk_inside(const walk *w, key brick_at, int di, int dj, const float x[8], const float y[8], const float z[8])
{
    key first = key_add(key_of_brick(brick_at), di, dj, 0);
    if (first.i < w->corners.min.i || first.i > w->corners.max.i || first.j < w->corners.min.j ||
        first.j > w->corners.max.j)
        return 0;
    const float lo[3] = {(float)w->lo[0], (float)w->lo[1], (float)w->lo[2]};
    const float hi[3] = {(float)w->hi[0], (float)w->hi[1], (float)w->hi[2]};
    unsigned mask = 0;
    for (int n = 0; n < 8; n++) {
        bool in = x[n] > lo[0] && x[n] < hi[0] && y[n] > lo[1] && y[n] < hi[1] && z[n] > lo[2] && z[n] < hi[2];
        in = in && first.k + n >= w->corners.min.k && first.k + n <= w->corners.max.k;
        mask |= (unsigned)in << n;
    }
    return mask;
}
