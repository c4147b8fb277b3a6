/* SPDX-License-Identifier: Apache-2.0 */
#include "clay/reconstruct.h"

#include "clay/colour.h"

#include <math.h>
#include <string.h>

/* Brick that holds a corner, by links from the cursor's brick where they reach. */
static uint32_t brick_of(reconstruct *r, key corner)
{
    key at = key_brick(corner);
    if (r->known) {
        int di = at.i - r->at.i, dj = at.j - r->at.j, dk = at.k - r->at.k;
        if (di >= -1 && di <= 1 && dj >= -1 && dj <= 1 && dk >= -1 && dk <= 1)
            return r->ids[brick_neighbour_index(di, dj, dk)];
    }
    r->at = at;
    r->known = true;
    clay_neighbours(r->of, at, r->ids);
    return r->ids[BRICK_SELF];
}

static float corner_read(reconstruct *r, key corner, uint32_t *rgba_out)
{
    uint32_t id = brick_of(r, corner);
    if (id == POOL_NONE) {
        *rgba_out = COLOUR_NONE;
        return POTENTIAL_MIN;
    }
    const brick_page *p = clay_brick(r->of, id)->page;
    *rgba_out = p->rgba[key_slot(corner)];
    return p->potential[key_slot(corner)];
}

/* Smallest corner of the cube round (x,y,z) and the place inside it; false where nothing can be stored. */
static bool cube_of(double x, double y, double z, key *corner_out, float part_out[3])
{
    const double lo = (double)KEY_MIN - 1, hi = (double)KEY_MAX;
    if (!(x >= lo && x <= hi && y >= lo && y <= hi && z >= lo && z <= hi))
        return false;
    double fx = floor(x), fy = floor(y), fz = floor(z);
    *corner_out = (key){(int32_t)fx, (int32_t)fy, (int32_t)fz};
    part_out[0] = (float)(x - fx);
    part_out[1] = (float)(y - fy);
    part_out[2] = (float)(z - fz);
    return true;
}

static float weight_of(const float part[3], int c)
{
    float wi = c & 1 ? part[0] : 1 - part[0];
    float wj = c & 2 ? part[1] : 1 - part[1];
    float wk = c & 4 ? part[2] : 1 - part[2];
    return wi * wj * wk;
}

float reconstruct_potential(reconstruct *r, double x, double y, double z, uint32_t *rgba_out)
{
    key corner;
    float part[3], sum = 0, weight = 0, channel[4] = {0, 0, 0, 0};
    if (rgba_out)
        *rgba_out = COLOUR_NONE;
    if (!cube_of(x, y, z, &corner, part))
        return POTENTIAL_MIN;
    for (int c = 0; c < 8; c++) {
        uint32_t rgba;
        float v = corner_read(r, key_add(corner, c & 1, c >> 1 & 1, c >> 2), &rgba), w = weight_of(part, c);
        sum += w * v;
        if (v > POTENTIAL_MIN) {
            weight += w;
            for (int n = 0; n < 4; n++)
                channel[n] += w * (float)colour_channel(rgba, n);
        }
    }
    if (rgba_out && weight > 0)
        for (int n = 0; n < 4; n++) {
            float v = channel[n] / weight + 0.5f;
            *rgba_out |= (uint32_t)(v > 255 ? 255 : v) << (8 * n);
        }
    return sum < POTENTIAL_MAX ? sum : POTENTIAL_MAX; /* the eight weights may add up to a little over one */
}

void reconstruct_corner_gradient(reconstruct *r, key corner, float gradient_out[3])
{
    uint32_t unused;
    for (int a = 0; a < 3; a++) {
        float above = corner_read(r, key_add(corner, a == 0, a == 1, a == 2), &unused);
        float below = corner_read(r, key_add(corner, -(a == 0), -(a == 1), -(a == 2)), &unused);
        gradient_out[a] = (above - below) * 0.5f;
    }
}

void reconstruct_gradient(reconstruct *r, double x, double y, double z, float gradient_out[3])
{
    key corner;
    float part[3];
    memset(gradient_out, 0, 3 * sizeof *gradient_out);
    if (!cube_of(x, y, z, &corner, part))
        return;
    for (int c = 0; c < 8; c++) {
        float g[3], w = weight_of(part, c);
        reconstruct_corner_gradient(r, key_add(corner, c & 1, c >> 1 & 1, c >> 2), g);
        for (int a = 0; a < 3; a++)
            gradient_out[a] += w * g[a];
    }
}
