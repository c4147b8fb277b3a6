/* SPDX-License-Identifier: Apache-2.0 */
#include "view/quality.h"

#include "view/canvas.h"
#include "view/hollow.h"
#include "view/shadow.h"

#include <algorithm>
#include <cassert>

namespace {

void window_begin(quality *q) { q->frames = q->late = 0; }

bool down(quality *q)
{
    window_begin(q);
    q->calm = 0;
    if (q->since_up > 0)
        q->wait = std::min(2 * q->wait, static_cast<int>(QUALITY_WAIT_MAX));
    q->since_up = 0;
    if (q->level == QUALITY_LEVELS - 1)
        return false;
    q->level++;
    return true;
}

bool up(quality *q)
{
    q->calm = 0;
    if (q->level == 0)
        return false;
    window_begin(q);
    q->level--;
    q->since_up = 1;
    return true;
}

} // namespace

bool quality_frame(quality *q, int64_t took_ns)
{
    const bool late = took_ns > q->frame_ns;
    const bool room = static_cast<double>(took_ns) < QUALITY_ROOM * static_cast<double>(q->frame_ns);
    if (q->since_up > 0 && ++q->since_up > QUALITY_CALM) {
        q->since_up = 0; /* it held */
        q->wait = 1;
    }
    q->calm = room ? q->calm + 1 : 0;
    q->frames++;
    q->late += late;
    if (q->late >= QUALITY_LATE)
        return down(q);
    if (q->frames >= QUALITY_WINDOW)
        window_begin(q);
    return q->calm >= QUALITY_CALM * q->wait && up(q);
}

quality_rules quality_rules_of(int level)
{
    assert(level >= 0 && level < QUALITY_LEVELS);
    quality_rules r;
    r.blur = level < 1;
    r.shadow_taps = level >= 4 ? 0 : level >= 2 ? SHADOW_TAPS_FEWER : SHADOW_TAPS;
    r.hollow_taps = level >= 3 ? 0 : level >= 2 ? HOLLOW_TAPS_FEWER : HOLLOW_TAPS;
    r.samples = level >= 5 ? CANVAS_SAMPLES / 2 : CANVAS_SAMPLES;
    r.scale = level >= 7 ? 0.5 : level >= 6 ? 0.75 : 1;
    return r;
}

const char *quality_text(int level)
{
    static constexpr const char *texts[QUALITY_LEVELS] = {
        "",
        "drawn without depth of field",
        "drawn with coarser shadows",
        "drawn without darker hollows",
        "drawn without shadows",
        "drawn with rougher edges",
        "drawn with fewer pixels",
        "drawn with half the pixels",
    };
    assert(level >= 0 && level < QUALITY_LEVELS);
    return texts[level];
}
