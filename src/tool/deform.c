/* SPDX-License-Identifier: Apache-2.0 */
#include "tool/deform.h"

#include "clay/potential.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>

static bool settings_fit(double s, double m, double r, double n, double kappa)
{
    /* Written so that NaN fails; the small slack admits sums such as 1.5 + 0.5 + 1.0 in binary. */
    return fabs(s - (POTENTIAL_MAX - POTENTIAL_ISO)) <= 1e-9 && m > 0 && r > 0 && n >= 0 && n <= POTENTIAL_MAX &&
           kappa >= 0 && isfinite(kappa) && s + m + r <= (double)POTENTIAL_MAX - POTENTIAL_MIN + 1e-9;
}

static void piece_set(float piece[4], double cubic, double square, double slope, double value)
{
    piece[0] = (float)cubic;
    piece[1] = (float)square;
    piece[2] = (float)slope;
    piece[3] = (float)value;
}

status deform_init(deform *d, double s, double m, double r, double n, double kappa)
{
    if (!settings_fit(s, m, r, n, kappa))
        return STATUS_BAD_PARAMETER;
    const double most = 3 / s < 3 * n / m ? 3 / s : 3 * n / m;
    kappa = kappa < most ? kappa : most;
    *d = (deform){.s = s, .m = m, .r = r, .n = n, .kappa = kappa};
    piece_set(d->piece[0], (s * kappa - 2) / (s * s * s), (3 - s * kappa) / (s * s), 0, -1);
    piece_set(d->piece[1], (kappa * m - 2 * n) / (m * m * m), (3 * n - 2 * kappa * m) / (m * m), kappa, 0);
    piece_set(d->piece[2], 2 * n / (r * r * r), -3 * n / (r * r), 0, n);
    return STATUS_OK;
}

deform deform_default(void)
{
    deform d;
    status s = deform_init(&d, 1.5, 0.4, 0.9, 0.3, 1.0);
    assert(s == STATUS_OK);
    (void)s;
    return d;
}

float deform_at(const deform *d, float v)
{
    float s = (float)d->s, m = (float)d->m, r = (float)d->r, u = v;
    const float *p = d->piece[0];
    /* A joint belongs to the piece that starts there, which has its value to the bit: def(s) is 0 and not nearly 0. */
    if (v >= s + m + r)
        return 0;
    if (v >= s + m) {
        p = d->piece[2];
        u = v - (s + m);
    } else if (v >= s) {
        p = d->piece[1];
        u = v - s;
    }
    u = u > 0 ? u : 0;
    return ((p[0] * u + p[1]) * u + p[2]) * u + p[3];
}
