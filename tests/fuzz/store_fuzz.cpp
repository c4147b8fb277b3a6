/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    Whatever lies in a store, opening ends in sound clay or in a clear refusal that changes nothing; a stroke, an
 *         undo and a redo work after it, and it opens again. As long as nobody forged checksums, what was kept after
 *         the damage is there the next time.
 * Method  The input is a script of two bytes a step. Until the first byte 0 a history is made: strokes, stretches,
 *         undo, forks, checkpoints, syncs that fail. After it the files are changed: bytes turned over, cut, copied
 *         onto each other, renamed, removed, numbers put into headers whose checksums are then put right.
 */
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "clay/digest.h"
#include "history/byte_order.h"
#include "history/history.h"
#include "tests/unit/history/memory_store.h"

namespace {

enum { BRICKS = 48, STEPS_MAX = 60, BLOCK = RECORD_BLOCK_BYTES };

void require(bool truth)
{
    if (!truth) {
        std::abort();
    }
}

/* --- a history --- */

struct life {
    clay c;
    history h;
    history_finding finding;
    delta changed = {};
    status opened;

    life(byte_store store, uint8_t limits)
    {
        require(clay_init(&c, BRICKS) == STATUS_OK);
        const history_settings settings = {1u + limits % 16, RING_FILE_BYTES_MIN,
                                           uint64_t{RING_FILE_BYTES_MIN} * (1 + limits / 16), 1 << 20, limits % 3u};
        opened = history_open(&h, store, &settings, 0.5, &c, &finding);
    }
    ~life()
    {
        if (opened == STATUS_OK)
            history_close(&h);
        delta_finish(&changed);
        clay_finish(&c);
    }
    life(const life &) = delete;
    life &operator=(const life &) = delete;

    status field()
    {
        const status s = history_field_begin(&h, &c);
        while (s == STATUS_OK && history_work(&h))
            continue;
        return s;
    }
    status keep()
    {
        const status s = history_keep(&h);
        return s == STATUS_OK && h.wants_field && !h.in_stroke ? field() : s;
    }
    /* Turns one corner or a row of them over. False: there was no room. */
    bool stretch(uint8_t seed, bool ends)
    {
        bool written = true;
        clay_change_begin(&c);
        for (int n = 0; n < 1 + seed % 3 * 20; n++) {
            const key at = {seed % 29 - 14, n * 3 % 31 - 15, seed / 29 + n / 11};
            const float before = clay_read(&c, at, nullptr);
            written = clay_write(&c, at, before > 1 ? 0 : before + 1, seed) == STATUS_OK && written;
        }
        if (written) {
            require(delta_cut(&changed, &c) == STATUS_OK);
            delta_sort(&changed);
            require(history_put(&h, &changed, h.dab + 1, ends, c.rows) == STATUS_OK);
        }
        delta_give(&changed, &c);
        if (written)
            clay_change_end(&c);
        else
            clay_change_revert(&c);
        dirt_clear(&c.dirty);
        return written;
    }
    status go(history_way way, uint64_t to)
    {
        route r = {};
        status s = history_fetch(&h, way, to, &r);
        if (s == STATUS_OK)
            s = route_apply(&r, &c);
        if (s == STATUS_OK) {
            clay_change_end(&c);
            require(history_move(&h, &r) == STATUS_OK);
        } else if (r.count > 0) {
            require(s == STATUS_CORRUPT || s == STATUS_POOL_FULL);
            if (s == STATUS_CORRUPT)
                history_refuse(&h, &r);
        }
        route_finish(&r);
        dirt_clear(&c.dirty);
        require(clay_digest(&c) == h.digest);
        return s;
    }
};

void live(life &l, memory_store &m, uint8_t what, uint8_t how)
{
    if (l.h.in_stroke && what % 12 != 1)
        (void)l.stretch(how, true);
    switch (what % 12) {
    case 1: (void)l.stretch(how, how % 4 == 0); break;
    case 2: (void)l.go(HISTORY_BACK, 0); break;
    case 3: (void)l.go(HISTORY_FORTH, 0); break;
    case 4: (void)l.go(HISTORY_FORK, 0); break;
    case 5: (void)l.go(HISTORY_TO, how % 16); break;
    case 6: (void)l.field(); break;
    case 7: m.fail_at = m.calls + 1 + how % 8; break;
    default: (void)l.stretch(how, true); break;
    }
    m.fail_having_done = how & 1;
    if (what < 200)
        (void)l.keep();
    m.fail_at = what % 12 == 7 ? m.fail_at : 0;
}

/* --- what becomes of the files --- */

using byte_string = std::vector<uint8_t>;

void seal_record(byte_string &b, size_t at)
{
    if (at + RECORD_HEADER_BYTES > b.size())
        return;
    uint8_t *h = &b[at];
    const uint64_t stored = byte_order_get_u64(h + 136);
    if (stored <= b.size() - at - RECORD_HEADER_BYTES)
        byte_order_put_u64(h + 144, digest_bytes(h + RECORD_HEADER_BYTES, static_cast<size_t>(stored),
                                                 byte_order_get_u64(h + 16)));
    byte_order_put_u64(h + 152, digest_bytes(h, 152, 0));
}

void seal_field(byte_string &b)
{
    if (b.size() < CHECKPOINT_HEADER_BYTES)
        return;
    byte_order_put_u64(&b[88], digest_bytes(b.data(), 88, 0));
    for (size_t at = CHECKPOINT_HEADER_BYTES; at + 8 <= b.size();) {
        const uint64_t vouched = 8 + uint64_t{byte_order_get_u32(&b[at + 4])};
        if (vouched + 8 > b.size() - at)
            return;
        byte_order_put_u64(&b[at + vouched], digest_bytes(&b[at], vouched, 0));
        at += vouched + 8;
    }
}

byte_string *file_number(memory_store &m, uint8_t which, std::string *name_out)
{
    if (m.files.empty())
        return nullptr;
    auto at = m.files.begin();
    std::advance(at, which % m.files.size());
    *name_out = at->first;
    return &at->second;
}

/* A number of a header, one more or less or of the other end, under checksums that hold. */
void forge(byte_string &b, bool field, uint8_t where, uint8_t how)
{
    const size_t block = field ? 0 : static_cast<size_t>(where / 32) * BLOCK;
    const size_t words = field ? 11 : 19, at = block + 8 + 8 * (where % 32 % (words - 1));
    if (at + 8 > b.size())
        return;
    const uint64_t v = byte_order_get_u64(&b[at]);
    const uint64_t to[] = {v + 1, v - 1, 0, 1, how, v ^ uint64_t{1} << how / 8, v + how, UINT64_C(1) << 61};
    byte_order_put_u64(&b[at], to[how % 8]);
    if (field)
        seal_field(b);
    else
        seal_record(b, block);
}

struct damage {
    uint8_t file = 0;
    bool forged = false;
};

void spoil(memory_store &m, damage *d, uint8_t what, uint8_t how)
{
    std::string name, other;
    byte_string *b = file_number(m, d->file, &name);
    if (!b)
        return;
    const bool field = name.starts_with("field");
    const size_t block = b->size() / BLOCK ? how % (b->size() / BLOCK) * BLOCK : 0;
    switch (what % 10) {
    case 0: d->file = how; break;
    case 1:
        if (!b->empty())
            (*b)[(static_cast<size_t>(what) << 8 | how) * 13 % b->size()] ^= static_cast<uint8_t>(1 | what);
        break;
    case 2: b->resize(b->size() * how / 256); break;
    case 3:
        for (size_t n = 0; n < BLOCK && block + n < b->size(); n++)
            (*b)[block + n] = static_cast<uint8_t>(how * n);
        break;
    case 4: m.files[ring_name_of(how % 20).text] = byte_string(*b); break;
    case 5: m.files.erase(name); break;
    case 6: m.files[how % 2 ? HISTORY_FIELD_NAME : HISTORY_FIELD_BEFORE_NAME] = byte_string(*b); break;
    case 7: { /* a block of another file in the place of this one's */
        const byte_string *from = file_number(m, how, &other);
        for (size_t n = 0; n < BLOCK && block + n < b->size() && block + n < from->size(); n++)
            (*b)[block + n] = (*from)[block + n];
        break;
    }
    case 8:
        if (b->size() > RECORD_HEADER_BYTES) { /* bricks under checksums that hold */
            (*b)[RECORD_HEADER_BYTES + how % (b->size() - RECORD_HEADER_BYTES)] ^= what;
            field ? seal_field(*b) : seal_record(*b, 0);
            d->forged = true;
        }
        break;
    default:
        forge(*b, field, what / 10 * 10 + how % 10, how);
        d->forged = true;
        break;
    }
}

/* --- and what must hold --- */

/* Answers false where there was no room. */
bool works(life &l)
{
    const uint64_t before = clay_digest(&l.c);
    uint8_t seed = 0;
    while (!l.stretch(seed, true))
        if (++seed == 0)
            return false;
    const uint64_t after = clay_digest(&l.c);
    require(after != before && l.h.digest == after);
    require(l.keep() == STATUS_OK);
    require(l.go(HISTORY_BACK, 0) == STATUS_OK && clay_digest(&l.c) == before);
    require(l.keep() == STATUS_OK);
    require(l.go(HISTORY_FORTH, 0) == STATUS_OK && clay_digest(&l.c) == after);
    require(l.keep() == STATUS_OK && clay_is_valid(&l.c));
    return true;
}

void open_it(memory_store &m, uint8_t limits, bool forged)
{
    const auto before = m.files;
    m.spoilt.clear();
    m.unsynced.clear();
    uint64_t digest = 0;
    {
        life l(m.port(), limits);
        require(l.opened == STATUS_OK || l.opened == STATUS_NEWER || l.opened == STATUS_POOL_FULL);
        require(clay_is_valid(&l.c));
        if (l.opened == STATUS_NEWER)
            require(m.files == before && l.finding.text[0] != '\0');
        if (l.opened != STATUS_OK) {
            require(clay_brick_count(&l.c) == 0);
            return;
        }
        require(clay_digest(&l.c) == l.h.digest);
        (void)works(l);
        for (int n = 0; n < 100 && history_can_undo(&l.h); n++)
            if (l.go(HISTORY_BACK, 0) != STATUS_OK)
                break;
        require(clay_is_valid(&l.c) && l.keep() == STATUS_OK);
        digest = clay_digest(&l.c);
    }
    for (const auto &[name, bytes] : before) { /* what cannot be read is somewhere still */
        const bool written_anew = name.starts_with("undo-") || name.starts_with("field");
        require(written_anew || m.files.count(name) == 1);
    }
    life again(m.port(), limits);
    require(again.opened == STATUS_OK && clay_is_valid(&again.c) && clay_digest(&again.c) == again.h.digest);
    require(forged || clay_digest(&again.c) == digest);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    if (size < 3)
        return 0;
    memory_store m;
    const uint8_t *at = bytes + 1, *end = bytes + size;
    int steps = 0;
    {
        life l(m.port(), bytes[0]);
        require(l.opened == STATUS_OK);
        for (; end - at >= 2 && at[0] != 0 && steps < STEPS_MAX; at += 2, steps++)
            live(l, m, at[0], at[1]);
        m.fail_at = 0;
        require(clay_is_valid(&l.c) && clay_digest(&l.c) == l.h.digest);
    }
    damage d;
    for (at += std::min<std::ptrdiff_t>(end - at, 2); end - at >= 2 && steps < 2 * STEPS_MAX; at += 2, steps++)
        spoil(m, &d, at[0], at[1]);
    open_it(m, bytes[0], d.forged);
    return 0;
}
