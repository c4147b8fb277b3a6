/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/crash/crash_life.h"

#include "history/record.h"

#include <algorithm>
#include <cstdlib>

crash_life_count crash_life_counted;

/* --- the book --- */

void crash_life_book::put(uint64_t sequence, const crash_life_state &s)
{
    states[sequence] = s;
    ever.insert(s.digest);
}

void crash_life_book::cut(uint64_t sequence)
{
    lost.insert(states.upper_bound(sequence), states.end());
    states.erase(states.upper_bound(sequence), states.end());
    kept = std::min(kept, sequence);
}

void crash_life_book::revive(uint64_t sequence, uint64_t digest)
{
    const auto is = states.find(sequence);
    if (is != states.end() && is->second.digest == digest)
        return;
    bool found = false;
    for (auto [at, end] = lost.equal_range(sequence); at != end; ++at)
        found = found || at->second.digest == digest;
    if (!found)
        return;
    states.erase(states.upper_bound(kept), states.end());
    for (const auto &[at, state] : lost)
        if (at > kept && (at < sequence || (at == sequence && state.digest == digest)))
            states[at] = state;
}

uint64_t crash_life_book::whole(uint64_t sequence) const { return std::prev(states.upper_bound(sequence))->first; }

uint64_t crash_life_book::digest_of(uint64_t cursor, uint64_t until) const
{
    for (auto at = states.rbegin(); at != states.rend(); ++at)
        if (at->first <= until && at->second.cursor == cursor && (!at->second.move || cursor == 0))
            return at->second.digest;
    ADD_FAILURE() << "there never was a stroke " << cursor;
    return 0;
}

/* --- settings from outside --- */

uint64_t crash_life_factor()
{
    const char *asked = std::getenv("GLAISE_CRASHES");
    const uint64_t factor = asked ? std::strtoull(asked, nullptr, 10) : 1;
    return factor ? factor : 1;
}

uint64_t crash_life_seed()
{
    const char *asked = std::getenv("GLAISE_CRASH_SEED");
    return asked ? std::strtoull(asked, nullptr, 0) : 1;
}

namespace {

enum { INNER_BRICKS_MORE = 64, CUTS_WHILE_OPENING = 60, UNDO_ALL_MOST = 40 };

/* --- one opened piece against the book --- */

/* The strokes that can be gone over wherever the clay stands. What was forgotten for want of room may be found again,
   in an undo-file that was about to be written anew: then it is there, or cannot be read, and that is told. */
using surely = std::set<uint64_t>;

bool may_be_damaged(const piece &p, const surely &sure)
{
    const std::string text = p.h.trouble.text;
    return text.rfind("stroke ", 0) == 0 && !sure.count(std::strtoull(text.c_str() + 7, nullptr, 10));
}

/* Undo, step by step, and back: every state on the way is one of the book. */
void undo_all(piece &p, const crash_life_book &book, const surely &sure)
{
    const uint64_t here = p.h.sequence;
    for (int n = 0; n < 2 * UNDO_ALL_MOST; n++) {
        const bool back = n < UNDO_ALL_MOST;
        if (!(back ? history_can_undo(&p.h) : history_can_redo(&p.h)))
            continue;
        const status s = back ? p.undo() : p.redo();
        if (s == STATUS_CORRUPT) {
            ASSERT_TRUE(may_be_damaged(p, sure)) << p.h.trouble.text;
        } else {
            ASSERT_EQ(s, STATUS_OK) << p.h.trouble.text;
        }
        ASSERT_EQ(p.digest(), book.digest_of(p.h.tree.cursor, here)) << "came to stroke " << p.h.tree.cursor;
    }
}

/* From where it stands, undo reaches as far as it did before. */
void reaches_as_far(const piece &p, const surely &sure, const std::map<uint64_t, uint64_t> &parents)
{
    uint64_t at = p.h.tree.cursor;
    for (auto step = parents.find(at); step != parents.end() && sure.count(at); step = parents.find(at)) {
        ASSERT_NE(tree_find(&p.h.tree, at), nullptr) << "stroke " << at << " cannot be undone any more";
        at = step->second;
    }
}

/* A stroke, and back. */
void stroke_and_undo(piece &p, seeded &chance)
{
    const uint64_t before = p.digest(), cursor = p.h.tree.cursor;
    ASSERT_EQ(history_room(&p.h), STATUS_OK);
    ASSERT_EQ(p.stroke(piece_stroke_random(chance, 30)), STATUS_OK) << p.h.trouble.text;
    ASSERT_EQ(p.h.kept, p.h.sequence);
    if (p.h.tree.cursor == cursor)
        return;
    ASSERT_EQ(p.digest(), p.h.digest);
    ASSERT_TRUE(history_can_undo(&p.h));
    ASSERT_EQ(p.undo(), STATUS_OK) << p.h.trouble.text;
    ASSERT_EQ(p.digest(), before);
    ASSERT_EQ(p.h.tree.cursor, cursor);
}

/* What lies on a disk, for whoever looks into a failure. */
std::string disk_as_text(const sim_disk &d)
{
    std::string text;
    for (const auto &[name, f] : d.names) {
        text += name + " " + std::to_string(f->now.size()) + " bytes:";
        for (size_t at = 0; at < f->now.size(); at += RECORD_BLOCK_BYTES) {
            record r;
            preamble_trouble trouble;
            if (record_read(&r, f->now.data() + at, f->now.size() - at, &trouble) != STATUS_OK)
                continue;
            std::vector<uint8_t> bricks(static_cast<size_t>(r.bytes) + 1);
            const bool sound = RECORD_HEADER_BYTES + r.stored <= f->now.size() - at &&
                               record_check(&r, f->now.data() + at + RECORD_HEADER_BYTES, bricks.data(), &trouble) ==
                                   STATUS_OK;
            text += " [" + std::to_string(at / RECORD_BLOCK_BYTES) + ": use " + std::to_string(r.use) + " seq " +
                    std::to_string(r.sequence) + " stroke " + std::to_string(r.stroke) + "/" +
                    std::to_string(r.part) + " from " + std::to_string(r.parent) + " cursor " +
                    std::to_string(r.cursor) + " tip " + std::to_string(r.tip) + " kept " + std::to_string(r.kept) +
                    (r.marks ? " whole" : "") + (sound ? "]" : " DAMAGED]");
        }
        checkpoint_facts facts;
        if (name.rfind("field", 0) == 0 && f->now.size() >= CHECKPOINT_HEADER_BYTES) {
            std::memcpy(&facts.sequence, f->now.data() + 24, 8);
            std::memcpy(&facts.cursor, f->now.data() + 56, 8);
            text += " sequence " + std::to_string(facts.sequence) + " cursor " + std::to_string(facts.cursor);
        }
        text += "\n";
    }
    return text;
}

void opened_as_it_was(const piece &p, crash_life_book &book, uint64_t kept, bool failing)
{
    crash_life_counted.recoveries++;
    ASSERT_EQ(p.opened, STATUS_OK) << p.finding.text;
    ASSERT_TRUE(clay_is_valid(&p.c));
    ASSERT_EQ(p.digest(), p.h.digest);
    ASSERT_STREQ(p.finding.text, "");
    ASSERT_GE(p.h.sequence, book.whole(kept)) << "what was kept is gone";
    if (failing)
        book.revive(p.h.sequence, p.h.digest);
    const auto at = book.states.find(p.h.sequence);
    ASSERT_NE(at, book.states.end()) << "no state had sequence " << p.h.sequence;
    ASSERT_EQ(p.h.tree.cursor, at->second.cursor);
    ASSERT_EQ(p.digest(), at->second.digest) << "sequence " << p.h.sequence;
}

/* What records say was kept when they were written: those that lie in their place or behind something that cannot be
   read. What lies behind a sound record of an earlier use of its file is not looked for. */
std::set<uint64_t> kept_claims(const sim_disk &d)
{
    std::set<uint64_t> claims;
    for (const auto &[name, f] : d.names) {
        if (name.rfind("undo-", 0) != 0 || name.find("set-aside") != std::string::npos)
            continue;
        uint64_t use = 0;
        for (size_t at = 0; at < f->now.size(); at += RECORD_BLOCK_BYTES) {
            record r;
            preamble_trouble trouble;
            if (record_read(&r, f->now.data() + at, f->now.size() - at, &trouble) != STATUS_OK)
                continue;
            use = at == 0 ? r.use : use;
            if ((use == 0 || r.use == use) && record_span(r.stored) <= f->now.size() - at)
                claims.insert(r.kept);
        }
    }
    return claims;
}

/* On a disk that lies: a state that existed, and the truth about what is missing. False when something is. */
bool opened_after_lies(const piece &p, const std::set<uint64_t> &claims, const crash_life_book &book, uint64_t kept)
{
    crash_life_counted.recoveries++;
    EXPECT_EQ(p.opened, STATUS_OK) << p.finding.text;
    if (p.opened != STATUS_OK)
        return false;
    EXPECT_TRUE(clay_is_valid(&p.c));
    EXPECT_EQ(p.digest(), p.h.digest);
    EXPECT_TRUE(book.ever.count(p.digest())) << "sequence " << p.h.sequence;
    if (p.h.sequence >= book.whole(kept) && p.finding.text[0] == '\0')
        return true;
    crash_life_counted.losses++;
    const std::string text = p.finding.text;
    const bool told = text.find("lost") != std::string::npos || text.find("damaged") != std::string::npos;
    const bool shown = !claims.empty() && book.whole(*claims.rbegin()) > p.h.sequence;
    crash_life_counted.losses_told += told;
    EXPECT_TRUE(told || !shown) << "acknowledged: " << kept << ", stands at " << p.h.sequence << ": " << text;
    return false;
}

/* --- a life --- */

struct life {
    const crash_life_kind &kind;
    seeded chance, probing;
    std::unique_ptr<sim_disk> disk;
    crash_life_book book;
    piece_ring limits = {};
    std::unique_ptr<piece> p;
    std::unique_ptr<freeze> frozen; /* what the checkpoint under way reads */
    surely sure;
    std::map<uint64_t, uint64_t> parents; /* of the strokes there are */
    bool over = false;              /* this start of the program, by a cut in mid-call */

    life(uint64_t seed, const crash_life_kind &k)
        : kind(k), chance{seed}, probing{seed ^ 0x5bd1e995u}, disk(std::make_unique<sim_disk>(seed + 1))
    {
        watch();
    }
    ~life() { end_process(); }
    life(const life &) = delete;
    life &operator=(const life &) = delete;

    void watch()
    {
        disk->watch = [this] {
            if (seeded_chance(probing, kind.probe_rate))
                probe();
        };
    }
    uint64_t kept() const { return p && p->opened == STATUS_OK ? std::max(book.kept, p->h.kept) : book.kept; }
    bool honest() const { return kind.lie_rate == 0; }

    void probe();
    void probe_on(std::unique_ptr<sim_disk> left);
    void note(bool move);
    void look_at_tree();
    void kept_now();
    void begin_field();
    void end_field();
    void work();
    void stretch();
    void go();
    void step();
    void choose_limits();
    void end_process();
    void open();
    void start();
    void lift_faults();
};

/* Everything that must hold if the power goes now. */
void life::probe()
{
    if (testing::Test::HasFatalFailure())
        return;
    SCOPED_TRACE("power cut at call " + std::to_string(disk->calls));
    crash_life_counted.points++;
    if (p)
        look_at_tree();
    probe_on(disk->after_cut(seeded_bits(probing)));
}

void life::probe_on(std::unique_ptr<sim_disk> left)
{
    const uint32_t bricks = kind.bricks + INNER_BRICKS_MORE;
    for (int again = 0; again < 3 && seeded_chance(probing, 0.25); again++) {
        left->ends_at = static_cast<uint64_t>(seeded_int(probing, 1, CUTS_WHILE_OPENING));
        piece cut_short(left->port(), limits, bricks);
        crash_life_counted.points++;
        left = left->after_cut(seeded_bits(probing));
    }
    left->ends_at = 0;
    const std::string text = std::getenv("GLAISE_CRASH_TELL") ? disk_as_text(*left) : "";
    SCOPED_TRACE(text);
    const bool deep = seeded_chance(probing, 0.1);
    if (!honest()) {
        const std::set<uint64_t> claims = kept_claims(*left);
        piece q(left->port(), limits, bricks);
        (void)opened_after_lies(q, claims, book, kept());
        return;
    }
    uint64_t digest, sequence;
    {
        piece q(left->port(), limits, bricks);
        crash_life_book found_in = book;
        ASSERT_NO_FATAL_FAILURE(opened_as_it_was(q, found_in, kept(), kind.fault_rate > 0));
        ASSERT_NO_FATAL_FAILURE(reaches_as_far(q, sure, parents));
        if (deep) {
            ASSERT_NO_FATAL_FAILURE(undo_all(q, found_in, sure));
        }
        ASSERT_NO_FATAL_FAILURE(stroke_and_undo(q, probing));
        ASSERT_EQ(left->misuse, "");
        digest = q.digest();
        sequence = q.h.sequence;
    }
    if (!deep && !seeded_chance(probing, 0.1))
        return;
    left->new_process();
    left = left->after_cut(seeded_bits(probing));
    const std::string found_again = std::getenv("GLAISE_CRASH_TELL") ? disk_as_text(*left) : "";
    SCOPED_TRACE(found_again);
    piece again(left->port(), limits, bricks);
    ASSERT_EQ(again.opened, STATUS_OK) << again.finding.text;
    ASSERT_STREQ(again.finding.text, "");
    ASSERT_EQ(again.h.sequence, sequence);
    ASSERT_EQ(again.digest(), digest);
}

/* After every put and move: what the book must know before the disk is asked for anything. */
void life::note(bool move)
{
    ASSERT_EQ(p->digest(), p->h.digest);
    if (book.states.rbegin()->first < p->h.sequence)
        book.put(p->h.sequence, {p->h.tree.cursor, p->digest(), move});
}

/* What is forgotten is not sure any more, even if it is found again. */
void life::look_at_tree()
{
    parents.clear();
    for (uint32_t n = 0; n < p->h.tree.count; n++)
        parents[p->h.tree.strokes[n].stroke] = p->h.tree.strokes[n].parent;
    for (auto at = sure.begin(); at != sure.end();)
        at = parents.count(*at) ? std::next(at) : sure.erase(at);
}

void life::kept_now()
{
    const status s = history_keep(&p->h);
    if (honest() && kind.fault_rate == 0 && !kind.fills_up && !disk->ended) {
        ASSERT_EQ(s, STATUS_OK);
    }
    if (s == STATUS_OK) {
        ASSERT_EQ(p->h.kept, p->h.sequence);
    }
    book.kept = std::max(book.kept, p->h.kept);
}

void life::begin_field()
{
    frozen = std::make_unique<freeze>();
    ASSERT_EQ(freeze_begin(frozen.get(), &p->c), STATUS_OK);
    if (history_field_begin(&p->h, &frozen->still) != STATUS_OK)
        end_field();
    book.kept = std::max(book.kept, p->h.kept);
}

void life::end_field()
{
    if (frozen)
        freeze_end(frozen.get());
    frozen.reset();
}

void life::work()
{
    (void)!history_work(&p->h);
    if (!p->h.writer)
        end_field();
}

void life::stretch()
{
    const bool large = seeded_chance(chance, kind.large);
    const piece_stroke s = piece_stroke_random(chance, large ? kind.large_corners : kind.corners, large ? 3 : 12);
    const status done = p->stretch(s, seeded_chance(chance, 0.6));
    ASSERT_EQ(done, STATUS_OK);
    ASSERT_NO_FATAL_FAILURE(note(false));
    if (p->h.tree.cursor == p->h.stroke)
        sure.insert(p->h.stroke);
    look_at_tree();
}

void life::go()
{
    const history_way way = static_cast<history_way>(seeded_int(chance, 0, 3));
    const uint64_t to = static_cast<uint64_t>(seeded_int(chance, 0, static_cast<int64_t>(p->h.stroke)));
    route r = {};
    status s = history_fetch(&p->h, way, to, &r);
    if (honest() && s == STATUS_CORRUPT) {
        ASSERT_TRUE(may_be_damaged(*p, sure)) << p->h.trouble.text;
    } else if (honest()) {
        ASSERT_TRUE(s == STATUS_OK || s == STATUS_HISTORY_ENDS || s == STATUS_IO) << s << ": " << p->h.trouble.text;
    }
    if (s == STATUS_OK) {
        s = route_apply(&r, &p->c);
        if (honest()) {
            ASSERT_EQ(s, STATUS_OK);
        } else if (s != STATUS_OK)
            history_refuse(&p->h, &r);
    }
    if (s == STATUS_OK) {
        clay_change_end(&p->c);
        ASSERT_EQ(history_move(&p->h, &r), STATUS_OK);
        if (honest()) {
            ASSERT_EQ(p->digest(), book.digest_of(p->h.tree.cursor, UINT64_MAX));
        }
    }
    route_finish(&r);
    dirt_clear(&p->c.dirty);
    ASSERT_NO_FATAL_FAILURE(note(true));
}

void life::step()
{
    const double die = seeded_real(chance, 0, 1);
    if (die < 0.4 || p->h.in_stroke) {
        if (history_room(&p->h) == STATUS_OK || p->h.in_stroke) {
            ASSERT_NO_FATAL_FAILURE(stretch());
        }
    } else if (die < 0.65) {
        ASSERT_NO_FATAL_FAILURE(go());
    } else if (die < 0.75 && !p->h.writer) {
        ASSERT_NO_FATAL_FAILURE(begin_field());
    }
    if (seeded_chance(chance, kind.keep_rate)) {
        ASSERT_NO_FATAL_FAILURE(kept_now());
    }
    if (p->h.wants_field && !p->h.in_stroke && !p->h.writer && seeded_chance(chance, 0.5)) {
        ASSERT_NO_FATAL_FAILURE(begin_field());
    }
    if (seeded_chance(chance, 0.5))
        work();
}

void life::choose_limits()
{
    limits.strokes = seeded_chance(chance, 0.2) ? uint32_t{HISTORY_STROKES_DEFAULT}
                                                : static_cast<uint32_t>(seeded_int(chance, 1, kind.strokes_most));
    limits.file_bytes = seeded_chance(chance, 0.3) ? 2 * RING_FILE_BYTES_MIN : RING_FILE_BYTES_MIN;
    limits.budget_bytes = limits.file_bytes * (seeded_chance(chance, 0.4)
                                                   ? static_cast<uint64_t>(seeded_int(chance, 2, 6))
                                                   : uint64_t{1000});
}

void life::end_process()
{
    if (p && p->h.writer && p->opened == STATUS_OK) {
        free(p->h.writer); /* it reads the still, which goes first */
        p->h.writer = nullptr;
    }
    end_field();
    p.reset();
}

void life::open()
{
    choose_limits();
    const std::set<uint64_t> claims = honest() ? std::set<uint64_t>() : kept_claims(*disk);
    p = std::make_unique<piece>(disk->port(), limits, kind.bricks);
    if (!honest()) {
        const bool whole = opened_after_lies(*p, claims, book, book.kept);
        over = over || !whole;
        if (whole) {
            book.cut(p->h.sequence);
            book.kept = p->h.kept;
        }
        return;
    }
    ASSERT_NO_FATAL_FAILURE(opened_as_it_was(*p, book, book.kept, kind.fault_rate > 0));
    ASSERT_NO_FATAL_FAILURE(reaches_as_far(*p, sure, parents));
    book.cut(p->h.sequence);
    book.kept = p->h.kept;
}

/* The medium is good again: all that was made is there, and stays. */
void life::lift_faults()
{
    disk->fault_rate = disk->read_fault_rate = 0;
    disk->most_bytes = UINT64_MAX;
    if (disk->ended)
        return;
    ASSERT_NO_FATAL_FAILURE(note(false));
    ASSERT_EQ(history_keep(&p->h), STATUS_OK);
    ASSERT_EQ(p->h.kept, p->h.sequence);
    ASSERT_EQ(p->h.medium, HISTORY_MEDIUM_GOOD);
    book.kept = p->h.kept;
}

/* One start of the program, and its end: a cut in mid-call, a cut between calls, or the program's death alone. */
void life::start()
{
    ASSERT_NO_FATAL_FAILURE(open());
    if (over)
        return;
    if (kind.dense_bricks > 0 && p->h.sequence == 0) {
        piece_stroke dense;
        for (int b = 0; b < kind.dense_bricks; b++)
            for (int n = 0; n < BRICK_CORNERS; n++)
                dense.push_back({{b * 8 + n % 8, n / 8 % 8, n / 64}, 1.0f, 0xff000000u + static_cast<uint32_t>(n)});
        ASSERT_EQ(p->stretch(dense, true), STATUS_OK);
        ASSERT_NO_FATAL_FAILURE(note(false));
    }
    disk->fault_rate = kind.fault_rate;
    disk->read_fault_rate = kind.fault_rate / 4;
    disk->lie_rate = kind.lie_rate;
    if (kind.fills_up)
        disk->most_bytes = disk->held() + static_cast<uint64_t>(seeded_int(chance, 0, 6)) * RING_FILE_BYTES_MIN + 1000;
    const bool dies_in_call = honest() && seeded_chance(chance, 0.3);
    if (dies_in_call)
        disk->ends_at = disk->calls + static_cast<uint64_t>(seeded_int(chance, 1, 150));
    for (int n = 0; n < kind.steps && !disk->ended; n++) {
        SCOPED_TRACE("step " + std::to_string(n));
        ASSERT_NO_FATAL_FAILURE(step());
        ASSERT_EQ(disk->misuse, "");
    }
    disk->ends_at = 0;
    if (!disk->ended && honest() && seeded_chance(chance, 0.5)) {
        ASSERT_NO_FATAL_FAILURE(lift_faults());
    }
    disk->fault_rate = disk->read_fault_rate = disk->lie_rate = 0;
    disk->most_bytes = UINT64_MAX;
    book.kept = std::max(book.kept, p->h.kept);
    look_at_tree();
    end_process();
    if (!disk->ended && seeded_chance(chance, kind.kill_rate)) {
        crash_life_counted.kills++;
        disk->new_process();
        return;
    }
    crash_life_counted.cuts++;
    disk = disk->after_cut(seeded_bits(chance));
    watch();
}

} // namespace

void crash_life_run(uint64_t seed, const crash_life_kind &kind)
{
    SCOPED_TRACE("GLAISE_CRASH_SEED " + std::to_string(seed));
    crash_life_counted.lives++;
    life l(seed, kind);
    for (int n = 0; n < kind.starts && !l.over; n++) {
        SCOPED_TRACE("start " + std::to_string(n));
        ASSERT_NO_FATAL_FAILURE(l.start());
    }
}
