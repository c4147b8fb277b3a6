/* SPDX-License-Identifier: Apache-2.0 */
#include "view/upload.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace {

/* A frame's spending. */
struct purse {
    size_t budget_bytes;
    size_t spent = 0; /* sent, and kept aside for what page_end will send */
    size_t sent = 0;  /* of it */

    /* What cannot be split may go alone: else it would wait for ever. */
    bool affords(size_t bytes) const { return spent == 0 || (spent < budget_bytes && bytes <= budget_bytes - spent); }
};

enum class outcome { done, unaffordable, refused };

/* --- frames --- */

/* Behind everything drawn since the last update: that may be more than one picture, the last one's fence counts. */
void put_fence(upload *u)
{
    if (!u->fences.empty() && u->fences.back().frame == u->frame) {
        glDeleteSync(u->fences.back().sync);
        u->fences.pop_back();
    }
    if (const GLsync sync = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0))
        u->fences.push_back({u->frame, sync}); /* where there is none, the next one stands for both */
}

void begin_frame(upload *u)
{
    if (u->frame > 0 && (u->fences.empty() || u->fences.back().frame < u->frame))
        put_fence(u);
    while (!u->fences.empty()) {
        const GLenum state = glClientWaitSync(u->fences.front().sync, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
        if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED)
            break;
        u->done = u->fences.front().frame;
        glDeleteSync(u->fences.front().sync);
        u->fences.pop_front();
    }
    u->frame++;
}

/* The device has done with every frame but the one that now begins. */
bool is_idle(const upload &u) { return u.done + 1 >= u.frame; }

void take_back(upload *u)
{
    while (!u->left.empty() && u->left.front().frame <= u->done) {
        const upload_range r = u->left.front().range;
        page_leave(&u->pages[r.page], r.first, r.units);
        u->left.pop_front();
    }
}

/* last_frame: that shows the range. */
void leave(upload *u, const upload_range &r, uint64_t last_frame)
{
    if (r.units == 0)
        return;
    page_hide(&u->pages[r.page], r.first);
    if (last_frame > u->done)
        u->left.push_back({last_frame, r});
    else
        page_leave(&u->pages[r.page], r.first, r.units);
    u->counts.held--;
}

void close_all(upload *u)
{
    for (page &p : u->pages)
        page_close(&p);
    for (const upload_fence &f : u->fences)
        glDeleteSync(f.sync);
    upload fresh;
    fresh.with_lines = u->with_lines;
    fresh.counts.bytes = u->counts.bytes;
    fresh.counts.patches = u->counts.patches;
    *u = std::move(fresh);
}

/* --- ranges --- */

bool take_anywhere(upload *u, int units, upload_range *out, std::string *trouble_out)
{
    out->units = units;
    for (out->page = 0;; out->page++) {
        if (out->page == UPLOAD_PAGES_MAX) {
            *trouble_out =
                "the piece has more surface than can be shown: " + std::to_string(UPLOAD_PAGES_MAX) + " pages";
            return false;
        }
        if (out->page == u->pages.size()) {
            page fresh;
            if (!page_open(&fresh, u->with_lines, trouble_out))
                return false;
            u->pages.push_back(std::move(fresh));
        }
        out->first = berth_take(&u->pages[out->page].units, units);
        if (out->first != BERTH_NONE)
            return true;
    }
}

bool take(upload *u, const upload_slot &s, int units, upload_range *out, std::string *trouble_out)
{
    if (s.before.units >= units && berth_take_at(&u->pages[s.before.page].units, s.before.first, units)) {
        *out = {s.before.page, s.before.first, units};
        return true;
    }
    return take_anywhere(u, units, out, trouble_out);
}

/* That page_end may send for what is shown and hidden there. */
size_t table_bytes(const upload &u, const upload_range &shown, const upload_range &hidden)
{
    size_t bytes = 0;
    if (shown.units > 0)
        bytes += PAGE_TEXEL_BYTES + page_backlog(u.pages[shown.page], u.done);
    if (hidden.units > 0)
        bytes += PAGE_TEXEL_BYTES;
    if (hidden.units > 0 && (shown.units == 0 || shown.page != hidden.page))
        bytes += page_backlog(u.pages[hidden.page], u.done);
    return bytes;
}

/* --- patches --- */

outcome lost(upload *u, std::string *trouble_out)
{
    close_all(u);
    *trouble_out = "the device took back the memory of the surface";
    return outcome::refused;
}

outcome drop(upload *u, const upload_range &shown, purse *money)
{
    const size_t bytes = table_bytes(*u, {}, shown);
    if (!money->affords(bytes))
        return outcome::unaffordable;
    money->spent += bytes;
    page_begin(&u->pages[shown.page], u->done);
    leave(u, shown, u->frame - 1);
    return outcome::done;
}

/* The patch is packed for the range, and sent. */
outcome write(upload *u, const upload_slot &s, const patch &p, const upload_range &r, purse *money)
{
    const bool stays = r.page == s.shown.page && r.first == s.shown.first && s.shown.units > 0;
    packed_make(&u->scratch, p, r.first, r.units, u->with_lines);
    page_plan(u->pages[r.page], u->scratch, r.first, r.units, &u->change);
    const size_t bytes =
        u->change.bytes + (stays && key_equal(s.at, p.at) ? 0 : table_bytes(*u, r, stays ? upload_range{} : s.shown));
    if (!money->affords(bytes))
        return outcome::unaffordable;
    if (!page_write(&u->pages[r.page], u->scratch, r.first, r.units, u->change))
        return outcome::refused;
    money->spent += bytes;
    money->sent += u->change.bytes;
    return outcome::done;
}

void show(upload *u, upload_slot *s, const patch &p, const upload_range &r)
{
    const bool is_new = s->shown.units == 0;
    const bool stays = !is_new && r.page == s->shown.page && r.first == s->shown.first;
    if (!stays || !key_equal(s->at, p.at)) {
        page_begin(&u->pages[r.page], u->done);
        if (!stays && !is_new) {
            page_begin(&u->pages[s->shown.page], u->done);
            page_hide(&u->pages[s->shown.page], s->shown.first);
        }
        page_show(&u->pages[r.page], r.first, p.at);
    }
    u->counts.held += is_new;
    u->counts.patches++;
    s->shown = r;
    s->at = p.at;
    s->generation = p.generation;
    s->waiting = 0;
}

/* An idle device shows nothing that could be spoilt: the patch stays where it is while it fits, else its range is free
   for the patch itself. */
outcome put_idle(upload *u, upload_slot *s, const patch &p, int units, purse *money, std::string *trouble_out)
{
    const upload_range old = s->shown;
    const bool stays = units <= old.units && 2 * units >= old.units;
    upload_range r = old;
    if (!stays && old.units > 0)
        page_leave(&u->pages[old.page], old.first, old.units);
    outcome state = outcome::refused;
    const bool taken = stays || take_anywhere(u, units, &r, trouble_out);
    if (taken)
        state = write(u, *s, p, r, money);
    if (state == outcome::done) {
        show(u, s, p, r);
        s->before = upload_range{};
        return state;
    }
    if (taken && state == outcome::refused)
        return lost(u, trouble_out);
    if (taken && !stays)
        berth_give(&u->pages[r.page].units, r.first, r.units);
    if (!stays && old.units > 0)
        page_return(&u->pages[old.page], old.first, old.units);
    return state;
}

outcome put_aside(upload *u, upload_slot *s, const patch &p, int units, purse *money, std::string *trouble_out)
{
    upload_range r;
    if (!take(u, *s, units, &r, trouble_out))
        return outcome::refused;
    const outcome state = write(u, *s, p, r, money);
    if (state == outcome::refused)
        return lost(u, trouble_out);
    if (state == outcome::unaffordable) {
        berth_give(&u->pages[r.page].units, r.first, r.units);
        return state;
    }
    const upload_range old = s->shown;
    show(u, s, p, r);
    if (old.units > 0) {
        u->left.push_back({u->frame - 1, old});
        s->before = old;
    }
    return state;
}

const patch *patch_of(const surface *s, uint32_t slot)
{
    const patch *p = slot < surface_slots(s) ? surface_patch(s, slot) : nullptr;
    return p && p->triangle_count > 0 ? p : nullptr;
}

bool by_brick(const upload_gone &a, const upload_gone &b) { return key_compare(a.at, b.at) < 0; }

/* A brick's patch may have got another slot: then what is shown of the brick goes with it, so that it is never shown
   twice. What is shown of bricks without a patch is gone. */
void follow_bricks(upload *u, const surface *s)
{
    for (uint32_t n = 0; n < u->slots.size(); n++) {
        upload_slot &slot = u->slots[n];
        const patch *p = patch_of(s, n);
        if (slot.shown.units > 0 && !(p && key_equal(slot.at, p->at))) {
            u->gone.push_back({slot.at, slot.generation, slot.shown});
            slot = upload_slot{};
        }
    }
    std::sort(u->gone.begin(), u->gone.end(), by_brick);
    for (uint32_t n = 0; n < u->slots.size() && !u->gone.empty(); n++) {
        const patch *p = u->slots[n].shown.units == 0 ? patch_of(s, n) : nullptr;
        if (!p)
            continue;
        const auto at = std::lower_bound(u->gone.begin(), u->gone.end(), upload_gone{p->at, 0, {}}, by_brick);
        if (at != u->gone.end() && key_equal(at->at, p->at)) {
            u->slots[n].at = at->at;
            u->slots[n].generation = at->generation;
            u->slots[n].shown = at->shown;
            u->gone.erase(at);
        }
    }
}

/* Slots whose patch is another than what is shown, in the order they go. */
std::vector<uint32_t> list_changed(upload *u, const surface *s, bool in_turn)
{
    using turn = std::tuple<int, uint64_t, uint32_t>;
    std::vector<turn> turns;
    for (uint32_t n = 0; n < u->slots.size(); n++) {
        const patch *p = patch_of(s, n);
        upload_slot &slot = u->slots[n];
        if (p ? slot.shown.units > 0 && slot.generation == p->generation : slot.shown.units == 0) {
            slot.waiting = 0;
            continue;
        }
        if (slot.waiting == 0)
            slot.waiting = u->frame;
        if (!in_turn)
            turns.emplace_back(0, 0, n);
        else if (slot.waiting + UPLOAD_WAIT_FRAMES <= u->frame)
            turns.emplace_back(1, slot.waiting, n);
        else
            turns.emplace_back(2, ~p->generation, n);
    }
    std::sort(turns.begin(), turns.end());
    std::vector<uint32_t> list;
    for (const turn &t : turns)
        list.push_back(std::get<2>(t));
    return list;
}

outcome put(upload *u, upload_slot *s, const patch &p, purse *money, std::string *trouble_out)
{
    const int units = packed_units(p, u->with_lines);
    assert(units <= PACKED_UNITS_MAX);
    return (is_idle(*u) ? put_idle : put_aside)(u, s, p, units, money, trouble_out);
}

outcome drop_gone(upload *u, purse *money)
{
    while (!u->gone.empty()) {
        if (drop(u, u->gone.back().shown, money) != outcome::done)
            return outcome::unaffordable;
        u->gone.pop_back();
    }
    return outcome::done;
}

/* What is left of the list waits. */
outcome send_changed(upload *u, const surface *s, purse *money, std::string *trouble_out)
{
    const bool in_turn = money->budget_bytes != UPLOAD_ALL;
    if (in_turn || !u->gone.empty())
        follow_bricks(u, s);
    const std::vector<uint32_t> list = list_changed(u, s, in_turn);
    outcome state = drop_gone(u, money);
    size_t n = 0;
    while (state == outcome::done && n < list.size()) {
        upload_slot &slot = u->slots[list[n]];
        if (const patch *p = patch_of(s, list[n])) {
            state = put(u, &slot, *p, money, trouble_out);
        } else {
            assert(!in_turn); /* there follow_bricks took it away */
            state = drop(u, slot.shown, money);
            slot = upload_slot{};
        }
        n += state == outcome::done;
    }
    u->counts.waiting = static_cast<uint32_t>(list.size() - n + u->gone.size());
    return state;
}

box bricks_shown(const upload &u)
{
    box b = box_empty();
    for (const upload_slot &slot : u.slots)
        if (slot.shown.units > 0)
            b = box_include(b, slot.at);
    for (const upload_gone &g : u.gone)
        b = box_include(b, g.at);
    return b;
}

void draw(const upload &u, GLenum kind)
{
    for (const page &p : u.pages)
        page_draw(p, kind);
    glBindVertexArray(0);
}

} // namespace

void upload_init(upload *u, bool with_lines)
{
    *u = upload{};
    u->with_lines = with_lines;
}

void upload_finish(upload *u)
{
    close_all(u);
    *u = upload{};
}

void upload_clear(upload *u)
{
    for (const upload_slot &s : u->slots)
        leave(u, s.shown, u->frame);
    for (const upload_gone &g : u->gone)
        leave(u, g.shown, u->frame);
    for (page &p : u->pages)
        page_blank(&p);
    u->slots.clear();
    u->gone.clear();
    u->newest = 0;
    u->counts.waiting = 0;
    u->bricks = box_empty();
}

bool upload_update(upload *u, const surface *s, size_t budget_bytes, std::string *trouble_out)
{
    begin_frame(u);
    take_back(u);
    /* A surface's generations only grow: a smaller one is another surface, whose numbers mean nothing here. */
    if (s->generation < u->newest)
        upload_clear(u);
    purse money{budget_bytes};
    bool good = true;
    /* A patch that is given back moves no generation on, but takes its triangles with it. */
    if (s->generation != u->newest || s->triangles != u->triangles || u->counts.waiting > 0) {
        u->newest = s->generation;
        u->triangles = s->triangles;
        if (u->slots.size() < surface_slots(s))
            u->slots.resize(surface_slots(s));
        good = send_changed(u, s, &money, trouble_out) != outcome::refused;
        u->bricks = bricks_shown(*u);
    }
    for (page &p : u->pages)
        money.sent += page_end(&p, u->frame);
    u->counts.bytes += money.sent;
    return good;
}

void upload_drawn(upload *u) { put_fence(u); }

void upload_draw_triangles(const upload &u) { draw(u, GL_TRIANGLES); }

void upload_draw_lines(const upload &u)
{
    if (u.with_lines)
        draw(u, GL_LINES);
}
