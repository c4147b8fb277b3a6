/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   the ending of a name chooses the format; refusals name what is known and send no byte; the native file comes
 *         back whole, and a damaged one is refused with its offset, leaving the sculpture alone.
 * Method: a small ball of clay goes out through every format and is read back; the native file is cut at every length,
 *         flipped at every byte, and given a later version.
 */
#include "bucket.h"
#include "readback.h"

#include "clay/digest.h"
#include "exchange/exchange.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>

namespace {

constexpr double step_mm = 0.25;
const char *const mesh_endings[] = {".stl", ".ply", ".obj", ".iv"};

struct closer {
    void operator()(sculpture *s) const
    {
        EXPECT_EQ(sculpture_close(s), STATUS_OK);
        delete s;
    }
};
using held_sculpture = std::unique_ptr<sculpture, closer>;

held_sculpture opened(double step = step_mm)
{
    auto s = std::make_unique<sculpture>();
    history_finding finding;
    const status state = sculpture_open(s.get(), nullptr, 512, nullptr, step, &finding);
    if (state != STATUS_OK)
        throw std::runtime_error(status_text(state));
    return held_sculpture(s.release());
}

/* A ball of clay about (1, 0, -2); returns how many corners it stores. */
uint64_t fill_with_ball(sculpture &s, double radius)
{
    uint64_t stored = 0;
    key at;
    for (at.i = -12; at.i <= 12; at.i++)
        for (at.j = -12; at.j <= 12; at.j++)
            for (at.k = -12; at.k <= 12; at.k++) {
                const double x = at.i - 1.0, y = at.j, z = at.k + 2.0;
                const double potential = 1.5 + radius - std::sqrt(x * x + y * y + z * z);
                if (potential <= 0)
                    continue;
                stored++;
                EXPECT_EQ(clay_write(&s.clay, at, static_cast<float>(potential), colour_pack(200, 100, 50, 255)),
                          STATUS_OK);
            }
    surface_counts counts;
    EXPECT_EQ(sculpture_apply_surface(&s, &counts), STATUS_OK);
    return stored;
}

exchange_outcome write_out(sculpture &s, const std::string &name, bucket *b)
{
    still moment;
    EXPECT_EQ(still_begin(&moment, &s), STATUS_OK);
    exchange_outcome outcome = exchange_write(moment, name, bucket_put, b);
    still_end(&moment);
    return outcome;
}

bucket native_file_of(sculpture &s)
{
    bucket b;
    const exchange_outcome outcome = write_out(s, "owl.glaise", &b);
    EXPECT_EQ(outcome.state, STATUS_OK) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    return b;
}

soup read_mesh(const std::string &ending, const std::string &bytes)
{
    if (ending == ".stl")
        return soup_weld(readback_stl(bytes));
    if (ending == ".ply")
        return readback_ply(bytes);
    return ending == ".obj" ? readback_obj(bytes) : readback_inventor(bytes);
}

TEST(exchange, ending_chooses_the_format)
{
    EXPECT_EQ(exchange_format_of("owl.glaise"), EXCHANGE_GLAISE);
    EXPECT_EQ(exchange_format_of("/a.b/c/owl.STL"), EXCHANGE_STL);
    EXPECT_EQ(exchange_format_of(".ply"), EXCHANGE_PLY);
    EXPECT_EQ(exchange_format_of("my.owl.Obj"), EXCHANGE_OBJ);
    EXPECT_EQ(exchange_format_of("owl.iv"), EXCHANGE_INVENTOR);
    for (const char *name : {"", "owl", "owl.", "stl", "owl.st", "owl.stlx", "owl.stl/", "a.stl/owl", "owl.stl "})
        EXPECT_EQ(exchange_format_of(name), EXCHANGE_UNKNOWN) << name;
}

TEST(exchange, unknown_ending_lists_what_is_known)
{
    const held_sculpture s = opened();
    fill_with_ball(*s, 4);
    for (const char *name : {"/tmp/owl.3mf", "/tmp/owl"}) {
        bucket b;
        const exchange_outcome outcome = write_out(*s, name, &b);
        EXPECT_EQ(outcome.state, STATUS_BAD_PARAMETER);
        EXPECT_EQ(outcome.text.find("owl"), 0u) << outcome.text;
        for (const char *ending : {".glaise", ".stl", ".ply", ".obj", ".iv"})
            EXPECT_NE(outcome.text.find(ending), std::string::npos) << outcome.text;
        EXPECT_EQ(b.bytes, "");
    }
    bucket b;
    EXPECT_NE(write_out(*s, "owl.3mf", &b).text.find(".3mf"), std::string::npos);
    EXPECT_NE(write_out(*s, "/a.b/owl", &b).text.find("without an ending"), std::string::npos);
}

TEST(exchange, every_mesh_ending_writes_the_surface)
{
    const held_sculpture s = opened();
    fill_with_ball(*s, 7.3);
    mesh m;
    ASSERT_EQ(mesh_init(&m, &s->surface), STATUS_OK);
    const double volume = mesh_volume(&m) * step_mm * step_mm * step_mm;
    EXPECT_NEAR(volume, 4.18879 * std::pow(7.3 * step_mm, 3), 0.03 * volume);
    for (const std::string ending : mesh_endings) {
        bucket b;
        const exchange_outcome outcome = write_out(*s, "/tmp/owl" + ending, &b);
        EXPECT_EQ(outcome.state, STATUS_OK) << ending << outcome.text;
        EXPECT_EQ(outcome.text, "");
        const soup seen = read_mesh(ending, b.bytes);
        EXPECT_EQ(seen.triangles.size(), m.triangle_count) << ending;
        EXPECT_EQ(seen.at.size(), m.vertex_count) << ending;
        EXPECT_TRUE(soup_is_closed(seen)) << ending;
        EXPECT_NEAR(soup_volume(seen), volume, 1e-5 * volume) << ending;
        EXPECT_EQ(ending == ".stl" || seen.name.find("owl") != std::string::npos, true) << seen.name;
        EXPECT_EQ(seen.name.find("tmp"), std::string::npos);
        EXPECT_EQ(seen.name.find(ending), std::string::npos);
    }
    mesh_finish(&m);
}

TEST(exchange, mesh_taken_earlier_equals_the_sculptures)
{
    const held_sculpture s = opened();
    fill_with_ball(*s, 5);
    mesh m;
    ASSERT_EQ(mesh_init(&m, &s->surface), STATUS_OK);
    for (const std::string ending : mesh_endings) {
        bucket direct, later;
        EXPECT_EQ(write_out(*s, "owl" + ending, &direct).state, STATUS_OK);
        EXPECT_EQ(exchange_write_mesh(m, step_mm, "owl" + ending, bucket_put, &later).state, STATUS_OK);
        EXPECT_EQ(direct.bytes, later.bytes);
    }
    bucket b;
    const exchange_outcome native = exchange_write_mesh(m, step_mm, "owl.glaise", bucket_put, &b);
    EXPECT_EQ(native.state, STATUS_BAD_PARAMETER);
    EXPECT_NE(native.text.find(".glaise"), std::string::npos);
    EXPECT_EQ(exchange_write_mesh(m, step_mm, "owl.png", bucket_put, &b).state, STATUS_BAD_PARAMETER);
    EXPECT_EQ(b.bytes, "");
    mesh_finish(&m);
}

TEST(exchange, empty_surface_is_refused_empty_clay_is_kept)
{
    const held_sculpture s = opened();
    for (const std::string ending : mesh_endings) {
        bucket b;
        const exchange_outcome outcome = write_out(*s, "owl" + ending, &b);
        EXPECT_EQ(outcome.state, STATUS_BAD_PARAMETER) << ending;
        EXPECT_NE(outcome.text.find("empty"), std::string::npos) << outcome.text;
        EXPECT_EQ(b.bytes, "");
    }
    bucket b = native_file_of(*s);
    const held_sculpture other = opened();
    EXPECT_EQ(exchange_read(*other, bucket_get, &b).state, STATUS_OK);
    EXPECT_EQ(sculpture_digest(other.get()), sculpture_digest(s.get()));
}

TEST(exchange, failing_sink_is_told)
{
    const held_sculpture s = opened();
    fill_with_ball(*s, 5);
    for (const std::string ending : {".glaise", ".stl", ".ply", ".obj", ".iv"}) {
        bucket whole;
        ASSERT_EQ(write_out(*s, "owl" + ending, &whole).state, STATUS_OK);
        for (size_t room : {size_t{0}, whole.bytes.size() / 2, whole.bytes.size() - 1}) {
            bucket b;
            b.room = room;
            const exchange_outcome outcome = write_out(*s, "owl" + ending, &b);
            EXPECT_EQ(outcome.state, STATUS_IO) << ending << room;
            EXPECT_EQ(outcome.text, status_text(STATUS_IO));
        }
    }
}

TEST(exchange, native_file_comes_back)
{
    const held_sculpture s = opened();
    fill_with_ball(*s, 6);
    bucket b = native_file_of(*s);
    const held_sculpture other = opened();
    fill_with_ball(*other, 3);
    const exchange_outcome outcome = exchange_read(*other, bucket_get, &b);
    EXPECT_EQ(outcome.state, STATUS_OK) << outcome.text;
    EXPECT_EQ(outcome.text, "");
    EXPECT_EQ(sculpture_digest(other.get()), sculpture_digest(s.get()));
    EXPECT_EQ(surface_digest(&other->surface), surface_digest(&s->surface));
}

/* Refused with an offset inside the file, and nothing changed. */
void expect_refused(sculpture &s, bucket &b, const std::string &what)
{
    const uint64_t before = sculpture_digest(&s);
    const exchange_outcome outcome = exchange_read(s, bucket_get, &b);
    ASSERT_TRUE(outcome.state == STATUS_CORRUPT || outcome.state == STATUS_NEWER) << what << ": " << outcome.text;
    ASSERT_EQ(outcome.text.find("offset "), 0u) << what << ": " << outcome.text;
    const size_t colon = outcome.text.find(": expected ");
    ASSERT_NE(colon, std::string::npos) << what << ": " << outcome.text;
    ASSERT_GT(outcome.text.size(), colon + std::strlen(": expected ")) << what;
    ASSERT_LE(std::stoull(outcome.text.substr(7)), b.bytes.size()) << what << ": " << outcome.text;
    ASSERT_EQ(sculpture_digest(&s), before) << what;
    ASSERT_EQ(exchange_info(bucket_get, &b).text, outcome.text);
}

TEST(exchange, damage_is_refused_with_its_place)
{
    const held_sculpture s = opened();
    ASSERT_EQ(clay_write(&s->clay, {-1, 2, 3}, 2, colour_pack(1, 2, 3, 4)), STATUS_OK);
    ASSERT_EQ(clay_write(&s->clay, {9, 2, 3}, 1, colour_pack(5, 6, 7, 8)), STATUS_OK);
    const bucket whole = native_file_of(*s);
    const held_sculpture other = opened();
    ASSERT_EQ(clay_write(&other->clay, {5, 5, 5}, 2.5f, colour_pack(9, 9, 9, 9)), STATUS_OK);
    for (size_t n = 0; n < whole.bytes.size() && !HasFatalFailure(); n++) {
        bucket cut = whole;
        cut.bytes.resize(n);
        expect_refused(*other, cut, "cut at " + std::to_string(n));
        bucket flipped = whole;
        flipped.bytes[n] = static_cast<char>(flipped.bytes[n] ^ 0x10);
        expect_refused(*other, flipped, "flipped at " + std::to_string(n));
    }
}

TEST(exchange, later_version_is_said_to_be_later)
{
    const held_sculpture s = opened();
    bucket b = native_file_of(*s);
    b.bytes[8] = CHECKPOINT_VERSION + 1;
    constexpr size_t vouched = CHECKPOINT_HEADER_BYTES - 8;
    const uint64_t sum = digest_bytes(b.bytes.data(), vouched, 0);
    std::memcpy(&b.bytes[vouched], &sum, sizeof sum);
    expect_refused(*s, b, "later version");
    const exchange_outcome outcome = exchange_read(*s, bucket_get, &b);
    EXPECT_EQ(outcome.state, STATUS_NEWER);
    EXPECT_NE(outcome.text.find(status_text(STATUS_NEWER)), std::string::npos) << outcome.text;
}

TEST(exchange, failing_source_is_told)
{
    const held_sculpture s = opened();
    bucket b = native_file_of(*s);
    b.failed = true;
    EXPECT_EQ(exchange_read(*s, bucket_get, &b).text, status_text(STATUS_IO));
    EXPECT_EQ(exchange_info(bucket_get, &b).state, STATUS_IO);
}

TEST(exchange, other_step_is_named)
{
    const held_sculpture s = opened(0.5);
    bucket b = native_file_of(*s);
    const held_sculpture other = opened(0.125);
    fill_with_ball(*other, 3);
    const exchange_outcome outcome = exchange_read(*other, bucket_get, &b);
    EXPECT_EQ(outcome.state, STATUS_BAD_PARAMETER);
    EXPECT_NE(outcome.text.find("0.5 mm"), std::string::npos) << outcome.text;
    EXPECT_NE(outcome.text.find("0.125 mm"), std::string::npos) << outcome.text;
}

std::string line_of(const std::string &text, const std::string &word)
{
    const size_t at = text.find("\n" + word + " ");
    return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

TEST(exchange, info_tells_the_facts)
{
    const held_sculpture s = opened();
    const uint64_t stored = fill_with_ball(*s, 6);
    bucket b = native_file_of(*s);
    const exchange_outcome outcome = exchange_info(bucket_get, &b);
    ASSERT_EQ(outcome.state, STATUS_OK) << outcome.text;
    EXPECT_EQ(line_of(outcome.text, "version"), "version 3");
    EXPECT_EQ(line_of(outcome.text, "step"), "step    0.25 mm");
    EXPECT_EQ(line_of(outcome.text, "corners"), "corners " + std::to_string(stored));
    /* Stored where the distance from (1, 0, -2) is under 7.5. */
    EXPECT_EQ(line_of(outcome.text, "box"), "box     -6 -7 -9 to 8 7 5 (3.5 x 3.5 x 3.5 mm)");
    EXPECT_EQ(line_of(outcome.text, "bricks"), "bricks  " + std::to_string(clay_brick_count(&s->clay)));
    char digest[32];
    std::snprintf(digest, sizeof digest, "digest  %016llx", static_cast<unsigned long long>(clay_digest(&s->clay)));
    EXPECT_EQ(line_of(outcome.text, "digest"), digest);
}

TEST(exchange, info_of_an_empty_piece)
{
    const held_sculpture s = opened();
    bucket b = native_file_of(*s);
    const exchange_outcome outcome = exchange_info(bucket_get, &b);
    EXPECT_EQ(outcome.state, STATUS_OK);
    EXPECT_EQ(line_of(outcome.text, "bricks"), "bricks  0");
    EXPECT_EQ(line_of(outcome.text, "box"), "box     empty");
    EXPECT_EQ(line_of(outcome.text, "digest"), "digest  0000000000000000");
}

} // namespace
