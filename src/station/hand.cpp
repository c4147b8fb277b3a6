/* SPDX-License-Identifier: Apache-2.0 */
#include "station/hand.h"

#include "station/station.h"

#include <algorithm>

namespace {

/* World length of each of the tool's unit axes. */
motion_vector axis_lengths(const hand &h)
{
    if (h.shape != HAND_FREEFORM)
        return h.size_mm;
    return {h.scale[0] * h.made_step_mm, h.scale[1] * h.made_step_mm, h.scale[2] * h.made_step_mm};
}

/* Half the tool's extent along each of its axes, mm. */
motion_vector reach_mm(const hand &h)
{
    motion_vector r = axis_lengths(h);
    if (h.shape == HAND_FREEFORM)
        for (int a = 0; a < 3; a++)
            r[a] *= h.made.reach[a];
    return r;
}

double part_of(const hand_glide &g, int64_t time_us)
{
    if (time_us >= g.end_us)
        return 1;
    return static_cast<double>(time_us - g.start_us) / static_cast<double>(g.end_us - g.start_us);
}

void glide_apply(hand *h, hand_glide *g, int64_t time_us)
{
    if (g->kind == HAND_GLIDE_NONE || time_us < g->start_us)
        return;
    double part = part_of(*g, time_us);
    if (g->kind == HAND_GLIDE_LINE) {
        for (int a = 0; a < 3; a++)
            h->pose.place[a] = g->from.place[a] + (g->to[a] - g->from.place[a]) * part;
    } else {
        motion_quaternion q = motion_about(g->axis, g->radians * part);
        h->pose.turn = motion_product(q, g->from.turn);
        if (g->kind == HAND_GLIDE_ORBIT)
            h->pose.place = motion_sum(g->to, motion_rotate(q, motion_sum(g->from.place, g->to, -1)));
    }
    if (time_us >= g->end_us)
        g->kind = HAND_GLIDE_NONE;
}

} // namespace

void hand_finish(hand *h)
{
    if (!h->has_freeform)
        return;
    surface_finish(&h->made_surface);
    freeform_finish(&h->made);
    h->has_freeform = false;
}

status hand_make_tool(hand *h, const sculpture *piece)
{
    freeform made;
    surface made_surface;
    surface_counts counts;
    status s = sculpture_duplicate(piece, &made);
    if (s != STATUS_OK)
        return s;
    s = surface_init(&made_surface, 8 * made.copy.bricks.limit); /* cubes reach into the bricks before */
    if (s == STATUS_OK) {
        s = surface_rebuild(&made_surface, &made.copy, &counts);
        if (s != STATUS_OK)
            surface_finish(&made_surface);
    }
    if (s != STATUS_OK) {
        freeform_finish(&made);
        return s;
    }
    hand_finish(h);
    h->made = made;
    h->made_surface = made_surface;
    h->made_step_mm = piece->step_mm;
    h->has_freeform = true;
    return STATUS_OK;
}

void hand_advance(hand *h, int64_t time_us)
{
    glide_apply(h, &h->carry, time_us);
    glide_apply(h, &h->spin, time_us);
}

tool hand_tool(hand *h, double step_mm)
{
    tool t{};
    t.kind = h->kind;
    t.rgba = h->rgba;
    t.def = h->def;
    if (h->shape == HAND_FREEFORM) {
        t.form = freeform_shape(&h->made);
        return t;
    }
    double least = *std::min_element(h->size_mm.begin(), h->size_mm.end());
    /* A fall narrower than a lattice step would show stairs. */
    double border = std::clamp(h->border, std::min(step_mm / least, 1.0), 1.0);
    status s = ellipsoid_init(&h->round, h->shape == HAND_BOX ? ELLIPSOID_BOX : ELLIPSOID_WYVILL, border);
    assert(s == STATUS_OK);
    (void)s;
    t.form = ellipsoid_shape(&h->round);
    return t;
}

frame hand_frame(const hand *h, const motion_pose &at)
{
    frame f{};
    motion_vector length = axis_lengths(*h);
    for (int a = 0; a < 3; a++) {
        f.origin[a] = at.place[a];
        motion_vector unit{};
        unit[a] = length[a];
        motion_vector axis = motion_rotate(at.turn, unit);
        std::copy(axis.begin(), axis.end(), f.axis[a]);
    }
    return f;
}

stroke_rule hand_rule(const hand *h)
{
    motion_vector r = reach_mm(*h);
    double least = *std::min_element(r.begin(), r.end()), most = *std::max_element(r.begin(), r.end());
    return {h->spacing * least, most, STATION_DAB_US / 1e6, STATION_DABS_A_STEP};
}
