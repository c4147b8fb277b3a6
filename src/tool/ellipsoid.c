/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/ellipsoid.h"

#include "clay/potential.h"

#include <math.h>

static float wyvill(float rho2)
{
    float q = 1 - rho2;
    return rho2 < 1 ? q * q * (9 - 4 * rho2) * (POTENTIAL_MAX / 9) : POTENTIAL_MIN;
}

static float box_shaped(float rho2, float border)
{
    float q = (1 - sqrtf(rho2)) / border;
    q = q < 0 ? 0 : q > 1 ? 1 : q;
    return POTENTIAL_MAX * (q * q * (3 - 2 * q));
}

static void evaluate(const void *self, const float *x, const float *y, const float *z, float *potential, int n)
{
    const ellipsoid *e = (const ellipsoid *)self;
    if (e->profile == ELLIPSOID_WYVILL)
        for (int p = 0; p < n; p++)
            potential[p] = wyvill(x[p] * x[p] + y[p] * y[p] + z[p] * z[p]);
    else
        for (int p = 0; p < n; p++)
            potential[p] = box_shaped(x[p] * x[p] + y[p] * y[p] + z[p] * z[p], e->border);
}

status ellipsoid_init(ellipsoid *e, ellipsoid_profile profile, double border)
{
    if (!(border >= ELLIPSOID_BORDER_MIN && border <= 1))
        return STATUS_BAD_PARAMETER;
    e->profile = profile;
    e->border = (float)border;
    return STATUS_OK;
}

shape ellipsoid_shape(const ellipsoid *e)
{
    shape s = {e, evaluate, {-1, -1, -1}, {1, 1, 1}, true, e->profile == ELLIPSOID_WYVILL};
    return s;
}
