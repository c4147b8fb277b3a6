/* SPDX-License-Identifier: Apache-2.0 */
#include "station/stroke.h"

#include <cmath>

namespace {

double moved_mm(const stroke &s, const motion_pose &now, const stroke_rule &rule)
{
    return motion_length(motion_sum(now.place, s.last.place, -1)) +
           motion_turn_distance(now.turn, s.last.turn, rule.reach_mm);
}

void dab_to(stroke *s, const motion_pose &now, double moved, const stroke_rule &rule, std::vector<stroke_dab> *out)
{
    double wanted = std::ceil(moved / rule.spacing_mm);
    int n = wanted >= rule.most ? rule.most : wanted < 1 ? 1 : static_cast<int>(wanted);
    for (int m = 1; m <= n; m++)
        out->push_back({m == n ? now : motion_between(s->last, now, static_cast<double>(m) / n), s->waiting_s / n});
    s->last = now;
    s->waiting_s = 0;
    s->fresh = false;
}

} // namespace

stroke stroke_begin(const motion_pose &now) { return {now, 0, true}; }

void stroke_jump(stroke *s, const motion_pose &now) { s->last = now; }

void stroke_step(stroke *s, const motion_pose &now, double seconds, const stroke_rule &rule,
                 std::vector<stroke_dab> *out)
{
    s->waiting_s += seconds;
    double moved = moved_mm(*s, now, rule);
    /* Half a step of slack: sums of 0.004 do not reach 0.04 exactly. */
    if (s->fresh || moved >= rule.spacing_mm || s->waiting_s + seconds / 2 >= rule.wait_s)
        dab_to(s, now, moved, rule, out);
}

void stroke_end(stroke *s, const motion_pose &now, const stroke_rule &rule, std::vector<stroke_dab> *out)
{
    if (s->waiting_s > 0)
        dab_to(s, now, moved_mm(*s, now, rule), rule, out);
}
