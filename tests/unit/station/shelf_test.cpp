/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: no power cut and no failing call costs a piece, or leaves one half-made; what was answered as done is found
 *       again; nothing that was not discarded is ever removed; what cannot be understood is shown and left alone.
 * Method: a life of a shelf on folders in memory, run once for every call of it and every way in which that call can
 *         fail or be the last: the shelf that is opened then is the one before the step under way, or the one after it,
 *         as a model has them, file by file. The rules one by one, with planted folders and texts. */
#include "station/shelf.h"

#include "tests/crash/sim_disk.h"
#include "tests/unit/station/shelf_disk.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

struct model_piece {
    about_state state = ABOUT_ON;
    std::map<std::string, std::string> files; /* but for what is said about it */
    bool operator==(const model_piece &) const = default;
};

using model = std::map<std::pair<int, std::string>, model_piece>; /* by number and name */

model_piece &piece_of(model &m, int number)
{
    for (auto &[key, piece] : m)
        if (key.first == number)
            return piece;
    ADD_FAILURE() << "no piece " << number;
    return m[{number, ""}];
}

status keep(void *self, const void *bytes, size_t n)
{
    static_cast<std::string *>(self)->append(static_cast<const char *>(bytes), n);
    return STATUS_OK;
}

/* A piece that is open elsewhere. */
struct open_piece {
    std::unique_ptr<sculpture> piece = std::make_unique<sculpture>();
    std::string field; /* its native file */

    open_piece()
    {
        history_finding finding;
        ellipsoid ball;
        EXPECT_EQ(ellipsoid_init(&ball, ELLIPSOID_WYVILL, 1), STATUS_OK);
        EXPECT_EQ(sculpture_open(piece.get(), nullptr, 1000, nullptr, 1, &finding), STATUS_OK);
        const tool t = {ellipsoid_shape(&ball), ACTION_TOOTHPASTE, 7, deform_default()};
        const sculpture_dab d = {{{1, 0, 0}, {{6, 0, 0}, {0, 6, 0}, {0, 0, 5}}}, 2, 1};
        sculpture_stroke_begin(piece.get());
        EXPECT_EQ(sculpture_apply(piece.get(), &t, &d, nullptr), STATUS_OK);
        EXPECT_EQ(sculpture_stroke_end(piece.get()), STATUS_OK);
        still moment;
        EXPECT_EQ(still_begin(&moment, piece.get()), STATUS_OK);
        EXPECT_EQ(still_write(&moment, keep, &field), STATUS_OK);
        still_end(&moment);
    }
    ~open_piece() { EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK); }
};

const open_piece &at_work()
{
    static const open_piece one;
    return one;
}

std::string duplicate_moment(shelf *s, int number, int *number_out)
{
    still moment;
    EXPECT_EQ(still_begin(&moment, at_work().piece.get()), STATUS_OK);
    std::string text = shelf_duplicate(s, number, &moment, {}, number_out);
    still_end(&moment);
    return text;
}

/* --- the life --- */

struct step {
    std::function<std::string(shelf *)> act;
    std::function<void(model *)> then;
};

const std::string LONG((1 << 20) + 5, 'l'); /* more than a block of copying */

void sculpt(shelf_disk *d, const std::string &folder)
{
    d->put(folder, "field", "clay of " + folder);
    d->put(folder, "undo-0000", LONG);
    d->put(folder, "undo-0001", "");
    d->put(folder, "thumbnail.png", "picture of " + folder);
}

model_piece sculpted(const std::string &folder)
{
    return {ABOUT_ON, {{"field", "clay of " + folder}, {"undo-0000", LONG}, {"undo-0001", ""},
                       {"thumbnail.png", "picture of " + folder}}};
}

/* The first piece is on the shelf and has been worked on before the life begins. */
std::vector<step> life()
{
    const auto state = [](int number, about_state to) {
        return [=](model *m) { piece_of(*m, number).state = to; };
    };
    const model_piece by_moment = {ABOUT_ON, {{"field", at_work().field}, {"thumbnail.png", "picture of piece-0001"}}};
    static int number;
    return {
        {[](shelf *s) { return shelf_new(s, "two", &number); }, [](model *m) { (*m)[{2, "two"}]; }},
        {[](shelf *s) { return shelf_rename(s, 1, "uno"); },
         [](model *m) {
             auto node = m->extract({1, "one"});
             node.key() = {1, "uno"};
             m->insert(std::move(node));
         }},
        {[](shelf *s) { return shelf_duplicate(s, 1, nullptr, {}, &number); },
         [](model *m) { (*m)[{3, "uno (copy)"}] = sculpted("piece-0001"); }},
        {[](shelf *s) { return shelf_set_aside(s, 3); }, state(3, ABOUT_ASIDE)},
        {[](shelf *s) { return shelf_discard(s, 3); }, state(3, ABOUT_DISCARDED)},
        {[](shelf *s) { return shelf_bring_back(s, 3); }, state(3, ABOUT_ON)},
        {[](shelf *s) { return shelf_set_aside(s, 3); }, state(3, ABOUT_ASIDE)},
        {[](shelf *s) { return shelf_discard(s, 3); }, state(3, ABOUT_DISCARDED)},
        {[](shelf *s) { return duplicate_moment(s, 1, &number); },
         [=](model *m) { (*m)[{4, "uno (copy)"}] = by_moment; }},
        {[](shelf *s) { return shelf_make_room(s, 2 << 20); }, [](model *m) { m->erase({3, "uno (copy)"}); }},
        {[](shelf *s) { return shelf_new(s, "five", &number); }, [](model *m) { (*m)[{5, "five"}]; }},
    };
}

/* A capacity that is enough for all, and leaves two MiB only without the third piece. */
constexpr uint64_t CAPACITY = 7 << 19;

model begin_life(shelf_disk *d)
{
    shelf s;
    int number = 0;
    d->capacity = CAPACITY;
    EXPECT_EQ(shelf_open(&s, d->port()), "");
    EXPECT_EQ(shelf_new(&s, "one", &number), "");
    EXPECT_EQ(number, 1);
    sculpt(d, "piece-0001");
    d->calls = 0;
    return {{{1, "one"}, sculpted("piece-0001")}};
}

/* What a shelf that is opened now shows; every folder is a whole piece. */
model found(shelf_disk *d)
{
    model m;
    shelf s;
    EXPECT_EQ(shelf_open(&s, d->port()), "");
    EXPECT_EQ(s.trouble, "");
    EXPECT_EQ(s.pieces.size(), d->folders.size()) << "something is left that is no piece";
    for (const shelf_piece &p : s.pieces) {
        EXPECT_EQ(p.trouble, "");
        model_piece &piece = m[{p.number, p.facts.name}];
        piece.state = p.facts.state;
        for (const auto &[name, file] : d->folders[shelf_folder(p.number)])
            if (name != "about" && name[0] != '.')
                piece.files[name] = file.now;
    }
    return m;
}

model shown(const shelf &s)
{
    model m;
    for (const shelf_piece &p : s.pieces)
        m[{p.number, p.facts.name}].state = p.facts.state;
    return m;
}

model without_files(model m)
{
    for (auto &[key, piece] : m)
        piece.files.clear();
    return m;
}

struct strike {
    uint64_t at = 0;
    shelf_disk_part done = SHELF_DISK_NOTHING;
    bool cuts = false;
};

/* Lives until a step fails: the model before it and after it. */
std::pair<model, model> live(shelf_disk *d, const strike &how, bool *failed_out)
{
    model m = begin_life(d);
    shelf s;
    d->strike_at = how.at;
    d->done = how.done;
    d->cuts = how.cuts;
    *failed_out = !shelf_open(&s, d->port()).empty() || !s.pieces[0].trouble.empty();
    if (*failed_out)
        return {m, m};
    for (const step &one : life()) {
        model next = m;
        one.then(&next);
        *failed_out = !one.act(&s).empty();
        if (*failed_out) {
            if (!d->dead) {
                EXPECT_EQ(shown(s), without_files(found(d))) << "what is shown is not what the medium holds";
            }
            return {m, next};
        }
        m = next;
        EXPECT_TRUE(d->dead || shown(s) == without_files(m));
    }
    return {m, m};
}

/* How many calls a life takes that nothing happens to. */
uint64_t calls_of_life()
{
    shelf_disk d;
    bool failed = true;
    const auto [before, after] = live(&d, {}, &failed);
    EXPECT_FALSE(failed);
    const uint64_t calls = d.calls;
    EXPECT_EQ(found(&d), after);
    return calls;
}

/* A copy of a moment may come without its thumbnail. */
void expect_one_of(model is, const model &before, const model &after)
{
    for (auto &[key, piece] : is)
        if (key.first == 4)
            piece.files.insert({"thumbnail.png", "picture of piece-0001"});
    EXPECT_TRUE(is == before || is == after) << is.size() << " pieces; before " << before.size() << ", after "
                                             << after.size();
}

void expect_works(shelf_disk *d)
{
    shelf s;
    int number = 0;
    ASSERT_EQ(shelf_open(&s, d->port()), "");
    ASSERT_EQ(shelf_new(&s, "last", &number), "");
    EXPECT_EQ(found(d).count({number, "last"}), 1u);
}

constexpr std::array<shelf_disk_part, 3> PARTS = {SHELF_DISK_NOTHING, SHELF_DISK_HALF, SHELF_DISK_ALL};

TEST(shelf_life, survives_every_call_that_fails)
{
    const uint64_t calls = calls_of_life();
    EXPECT_GT(calls, 50u);
    int told = 0;
    for (uint64_t at = 1; at <= calls; at++)
        for (const shelf_disk_part done : PARTS) {
            SCOPED_TRACE("call " + std::to_string(at) + ", part " + std::to_string(done));
            shelf_disk d;
            bool failed = false;
            const auto [before, after] = live(&d, {at, done, false}, &failed);
            told += failed;
            expect_one_of(found(&d), before, after);
            expect_works(&d);
        }
    EXPECT_GT(told, 100);
}

TEST(shelf_life, survives_a_power_cut_at_every_call)
{
    const uint64_t calls = calls_of_life();
    for (uint64_t at = 1; at <= calls; at += SIM_DISK_THIN)
        for (const shelf_disk_part done : PARTS)
            for (const shelf_disk_part unsynced : PARTS)
                for (const bool removed_comes_back : {false, true}) {
                    SCOPED_TRACE("call " + std::to_string(at) + ", part " + std::to_string(done) + ", unsynced " +
                                 std::to_string(unsynced) + (removed_comes_back ? ", removed comes back" : ""));
                    shelf_disk d;
                    bool failed = false;
                    const auto [before, after] = live(&d, {at, done, true}, &failed);
                    d.after_cut(unsynced, removed_comes_back);
                    expect_one_of(found(&d), before, after);
                    expect_works(&d);
                }
}

/* --- the rules, one by one --- */

class shelf_in_memory : public testing::Test {
protected:
    void SetUp() override { ASSERT_EQ(shelf_open(&s, disk.port()), ""); }
    int made(const std::string &name)
    {
        int number = 0;
        EXPECT_EQ(shelf_new(&s, name, &number), "");
        sculpt(&disk, shelf_folder(number));
        return number;
    }
    void discard(int number)
    {
        ASSERT_EQ(shelf_set_aside(&s, number), "");
        ASSERT_EQ(shelf_discard(&s, number), "");
    }
    about_state state(int number) { return shelf_find(&s, number)->facts.state; }
    void plant(const std::string &folder, const std::string &text) { disk.put(folder, "about", text); }
    shelf_disk disk;
    shelf s;
};

TEST_F(shelf_in_memory, discards_only_with_a_second_act)
{
    const int n = made("one");
    EXPECT_NE(shelf_discard(&s, n), "");
    EXPECT_EQ(state(n), ABOUT_ON);
    ASSERT_EQ(shelf_set_aside(&s, n), "");
    ASSERT_EQ(shelf_discard(&s, n), "");
    EXPECT_EQ(state(n), ABOUT_DISCARDED);
    EXPECT_NE(shelf_set_aside(&s, n), "") << "that is brought back first";
    ASSERT_EQ(shelf_bring_back(&s, n), "");
    EXPECT_EQ(state(n), ABOUT_ON);
}

TEST_F(shelf_in_memory, makes_room_of_what_was_discarded_longest_ago)
{
    const int a = made("a"), b = made("b"), c = made("c"), kept = made("kept"), aside = made("aside");
    for (const int n : {b, c, a})
        discard(n);
    ASSERT_EQ(shelf_set_aside(&s, aside), "");
    disk.capacity = disk.held();
    ASSERT_EQ(shelf_make_room(&s, 0), "");
    EXPECT_EQ(s.pieces.size(), 5u);
    ASSERT_EQ(shelf_make_room(&s, 3 << 19), "");
    EXPECT_EQ(shelf_find(&s, b), nullptr);
    EXPECT_EQ(shelf_find(&s, c), nullptr);
    EXPECT_NE(shelf_find(&s, a), nullptr) << "there was room enough without it";
    EXPECT_NE(shelf_make_room(&s, 1 << 30), "");
    EXPECT_EQ(shelf_find(&s, a), nullptr);
    EXPECT_NE(shelf_find(&s, kept), nullptr);
    EXPECT_NE(shelf_find(&s, aside), nullptr);
    EXPECT_EQ(disk.folders.size(), 2u);
}

TEST_F(shelf_in_memory, goes_on_to_the_next_when_one_is_open)
{
    const int a = made("a"), b = made("b");
    discard(a);
    discard(b);
    disk.capacity = disk.held();
    byte_store store;
    ASSERT_EQ(s.port.open(shelf_folder(a), &store), "");
    ASSERT_EQ(shelf_make_room(&s, 1 << 20), "");
    EXPECT_NE(shelf_find(&s, a), nullptr);
    EXPECT_EQ(shelf_find(&s, b), nullptr);
    EXPECT_NE(shelf_make_room(&s, 1 << 30).find("is open"), std::string::npos);
    s.port.close(store);
}

TEST_F(shelf_in_memory, copying_a_discarded_piece_does_not_make_room_of_it)
{
    const int a = made("a"), b = made("b");
    int copy = 0;
    discard(a);
    discard(b);
    disk.capacity = disk.held();
    ASSERT_EQ(shelf_duplicate(&s, a, nullptr, {}, &copy), "");
    EXPECT_NE(shelf_find(&s, a), nullptr);
    for (const shelf_piece &p : s.pieces)
        EXPECT_NE(p.facts.name, "b") << "room was needed";
    EXPECT_EQ(state(copy), ABOUT_ON);
    EXPECT_EQ(disk.folders[shelf_folder(copy)]["undo-0000"].durable, LONG);
}

TEST_F(shelf_in_memory, a_copy_has_none_of_the_space_that_is_only_held)
{
    const int a = made("a");
    int copy = 0;
    auto &files = disk.folders[shelf_folder(a)];
    files[RESERVE_NAME] = files["undo-0000"];
    ASSERT_EQ(shelf_duplicate(&s, a, nullptr, {}, &copy), "");
    EXPECT_EQ(disk.folders[shelf_folder(copy)].count(RESERVE_NAME), 0u);
    EXPECT_EQ(disk.folders[shelf_folder(copy)].count("undo-0000"), 1u);
}

TEST_F(shelf_in_memory, a_piece_that_is_open_is_not_copied_by_its_files)
{
    const int a = made("a");
    int copy = 0;
    byte_store store;
    ASSERT_EQ(s.port.open(shelf_folder(a), &store), "");
    EXPECT_NE(shelf_duplicate(&s, a, nullptr, {}, &copy), "");
    ASSERT_EQ(duplicate_moment(&s, a, &copy), "");
    s.port.close(store);
    EXPECT_EQ(disk.folders[shelf_folder(copy)]["field"].durable, at_work().field);
    EXPECT_EQ(disk.folders.size(), 2u);
}

TEST_F(shelf_in_memory, a_copy_of_a_moment_opens_as_that_piece)
{
    int copy = 0;
    ASSERT_EQ(duplicate_moment(&s, made("a"), &copy), "");
    byte_store store;
    history_finding finding;
    auto piece = std::make_unique<sculpture>();
    ASSERT_EQ(s.port.open(shelf_folder(copy), &store), "");
    ASSERT_EQ(sculpture_open(piece.get(), &store, 1000, nullptr, 5, &finding), STATUS_OK);
    EXPECT_STREQ(finding.text, "");
    EXPECT_EQ(sculpture_digest(piece.get()), sculpture_digest(at_work().piece.get()));
    EXPECT_EQ(sculpture_close(piece.get()), STATUS_OK);
    s.port.close(store);
}

TEST_F(shelf_in_memory, copying_tells_how_far_it_is)
{
    std::vector<double> parts;
    int copy = 0;
    ASSERT_EQ(shelf_duplicate(&s, made("a"), nullptr, [&](double p) { parts.push_back(p); }, &copy), "");
    EXPECT_GE(parts.size(), 4u);
    EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
    EXPECT_GT(parts.front(), 0);
    EXPECT_NEAR(parts.back(), 1, 0.001) << "what is said about it is not copied";
}

TEST_F(shelf_in_memory, names_that_are_none_are_refused_before_anything_is_made)
{
    int number = 0;
    const uint64_t calls = disk.calls;
    for (const std::string &bad : {std::string(""), std::string(101, 'x'), std::string("a\nstate discarded")})
        EXPECT_NE(shelf_new(&s, bad, &number), "");
    EXPECT_EQ(disk.calls, calls);
    const int n = made("good");
    EXPECT_NE(shelf_rename(&s, n, "\x1b[2J"), "");
    EXPECT_EQ(shelf_find(&s, n)->facts.name, "good");
    EXPECT_NE(shelf_rename(&s, n + 1, "none"), "");
    EXPECT_NE(shelf_duplicate(&s, n + 1, nullptr, {}, &number), "");
}

TEST_F(shelf_in_memory, what_cannot_be_understood_is_shown_and_left_alone)
{
    const std::string newer = "glaise piece 2\nname a\nstate discarded\nturn 1\n";
    plant("piece-0001", newer);
    plant("piece-0002", "glaise piece 1\nname a\nstate disc");
    plant("piece-0003", std::string(1 << 20, 'x'));
    disk.put("piece-0004", "field", "clay alone");
    for (int n = 1; n <= 3; n++)
        sculpt(&disk, shelf_folder(n));
    const auto before = disk.held();
    ASSERT_EQ(shelf_open(&s, disk.port()), "");
    ASSERT_EQ(s.pieces.size(), 4u);
    disk.capacity = 0;
    EXPECT_NE(shelf_make_room(&s, 1 << 20), "");
    for (int n = 1; n <= 4; n++) {
        const shelf_piece *p = shelf_find(&s, n);
        ASSERT_NE(p, nullptr);
        EXPECT_EQ(p->facts.name, shelf_folder(n));
        EXPECT_EQ(p->facts.state, ABOUT_ON);
        EXPECT_EQ(p->trouble.find(shelf_folder(n) + "/about"), 0u) << p->trouble;
        EXPECT_NE(shelf_rename(&s, n, "new"), "");
        EXPECT_NE(shelf_set_aside(&s, n), "");
        EXPECT_NE(shelf_discard(&s, n), "");
    }
    EXPECT_NE(shelf_find(&s, 1)->trouble.find(":1: expected"), std::string::npos);
    EXPECT_NE(shelf_find(&s, 2)->trouble.find(":3: expected"), std::string::npos);
    EXPECT_EQ(disk.held(), before);
    EXPECT_EQ(disk.folders["piece-0001"]["about"].now, newer);
    int copy = 0;
    ASSERT_EQ(shelf_duplicate(&s, 1, nullptr, {}, &copy), "");
    EXPECT_EQ(shelf_find(&s, copy)->facts.name, "piece-0001 (copy)");
}

TEST_F(shelf_in_memory, other_folders_are_none_of_its_business)
{
    for (const char *folder :
         {"piece-0000", "piece-1", "piece-00001", "piece-000x", "pieces", "piece-0001.bak", "lost"})
        plant(folder, about_text({"x", ABOUT_DISCARDED, 1}));
    disk.capacity = 0;
    ASSERT_EQ(shelf_open(&s, disk.port()), "");
    EXPECT_TRUE(s.pieces.empty());
    EXPECT_NE(shelf_make_room(&s, 1), "");
    EXPECT_EQ(disk.folders.size(), 7u);
}

TEST_F(shelf_in_memory, numbers_are_given_after_the_last_then_where_there_are_gaps)
{
    plant("piece-9998", about_text({"late", ABOUT_ON, 1}));
    plant("piece-0001", about_text({"early", ABOUT_ON, ABOUT_TURN_MAX}));
    ASSERT_EQ(shelf_open(&s, disk.port()), "");
    EXPECT_EQ(made("a"), 9999);
    EXPECT_EQ(made("b"), 2);
    EXPECT_EQ(made("c"), 3);
    EXPECT_EQ(shelf_find(&s, 3)->facts.turn, ABOUT_TURN_MAX) << "turns end there";
    for (size_t n = 1; n < s.pieces.size(); n++)
        EXPECT_LT(s.pieces[n - 1].number, s.pieces[n].number);
}

TEST_F(shelf_in_memory, what_cannot_be_cleared_away_stops_nothing)
{
    plant("making-0003", "half");
    plant("removed-0007", "half");
    byte_store store;
    const shelf_port port = disk.port();
    ASSERT_EQ(port.open("removed-0007", &store), "");
    ASSERT_EQ(shelf_open(&s, port), "");
    EXPECT_NE(s.trouble.find("removed-0007"), std::string::npos);
    EXPECT_EQ(disk.folders.count("making-0003"), 0u);
    EXPECT_EQ(made("a"), 8) << "a number that a folder has is not given again";
    port.close(store);
    ASSERT_EQ(shelf_open(&s, port), "");
    EXPECT_EQ(disk.folders.count("removed-0007"), 0u);
}

} // namespace
