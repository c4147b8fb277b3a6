/* SPDX-License-Identifier: Apache-2.0 */
#include "station/controls.h"

#include <algorithm>

controls controls_at_first()
{
    controls d;
    d.pedal[0].means = d.button[0].means = CONTROLS_MEANS_APPLY;
    d.pedal[1].means = d.button[1].means = CONTROLS_MEANS_UNDO;
    d.moves[0] = CONTROLS_SCENE;
    d.moves[1] = CONTROLS_TOOL;
    d.moves[2] = CONTROLS_SCENE;
    return d;
}

void controls_do(controls *d, const command &c)
{
    const auto &n = c.number;
    const auto index = static_cast<size_t>(static_cast<int64_t>(n[0]));
    const auto what = static_cast<int>(n[1]);
    switch (c.kind) {
    case COMMAND_PUCK:
        for (size_t a = 0; a < 6; a++)
            d->puck[index][a] = static_cast<int16_t>(n[1 + a]);
        break;
    case COMMAND_MOVES: d->moves[index] = static_cast<controls_thing>(what); break;
    case COMMAND_MEANS_PEDAL: d->pedal[index].means = static_cast<controls_meaning>(what); break;
    case COMMAND_MEANS_BUTTON: d->button[index].means = static_cast<controls_meaning>(what); break;
    case COMMAND_SPEED:
        d->speed_mm = n[0];
        d->speed_degrees = n[1];
        break;
    case COMMAND_FILTER: d->filter = {n[0], n[1]}; break;
    default: break;
    }
}

controls_press *controls_press_of(controls *d, const command &c)
{
    if (c.kind == COMMAND_PEDAL)
        return &d->pedal[static_cast<size_t>(c.number[0])];
    const auto n = static_cast<size_t>(c.number[1]);
    return n < d->button.size() ? &d->button[n] : nullptr;
}

controls_meaning controls_edge(controls_press *p, bool down, bool taken)
{
    if (down) {
        p->held = true;
        p->taken = taken;
        p->went_down_as = p->means;
        return p->means;
    }
    /* An edge that was missed must not leave anything held for ever: up is heard without a down, too. */
    const controls_meaning was = p->taken ? CONTROLS_MEANS_NOTHING : p->held ? p->went_down_as : p->means;
    p->held = p->taken = false;
    return was;
}

controls_thing controls_moved(const controls &d, size_t puck)
{
    const controls_thing what = d.moves[1 + puck];
    if (d.clutch && what == CONTROLS_TOOL)
        return CONTROLS_SCENE;
    if (d.clutch && what == CONTROLS_SCENE)
        return CONTROLS_TOOL;
    return what;
}

int controls_count(const controls &d, controls_meaning means)
{
    const auto is = [means](const controls_press &p) { return p.means == means; };
    return static_cast<int>(std::count_if(d.pedal.begin(), d.pedal.end(), is) +
                            std::count_if(d.button.begin(), d.button.end(), is));
}
