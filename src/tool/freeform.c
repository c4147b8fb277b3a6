/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/freeform.h"

#include "clay/reconstruct.h"

#include <string.h>

static void evaluate(const void *self, const float *x, const float *y, const float *z, float *potential, int n)
{
    const freeform *f = (const freeform *)self;
    reconstruct r = reconstruct_begin(&f->copy);
    for (int p = 0; p < n; p++)
        potential[p] = reconstruct_potential(&r, x[p] + f->middle[0], y[p] + f->middle[1], z[p] + f->middle[2], NULL);
}

status freeform_init(freeform *f, const clay *from)
{
    memset(f, 0, sizeof *f);
    box b = clay_box(from);
    if (box_is_empty(b))
        return STATUS_BAD_PARAMETER;
    status s = clay_init(&f->copy, clay_brick_count(from));
    if (s != STATUS_OK)
        return s;
    s = clay_copy(&f->copy, from);
    if (s != STATUS_OK) {
        freeform_finish(f);
        return s;
    }
    const int32_t lo[3] = {b.min.i, b.min.j, b.min.k}, hi[3] = {b.max.i, b.max.j, b.max.k};
    for (int a = 0; a < 3; a++) {
        f->middle[a] = ((double)lo[a] + hi[a]) * 0.5;
        f->reach[a] = ((double)hi[a] - lo[a]) * 0.5 + 1;
    }
    return STATUS_OK;
}

void freeform_finish(freeform *f)
{
    clay_finish(&f->copy);
    memset(f, 0, sizeof *f);
}

shape freeform_shape(const freeform *f)
{
    shape s = {.self = f, .evaluate = evaluate};
    for (int a = 0; a < 3; a++) {
        s.lo[a] = -f->reach[a];
        s.hi[a] = f->reach[a];
    }
    return s;
}
