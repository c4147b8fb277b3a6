/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   what all four mesh writers promise together: the same floats, the same refusals before the first byte, a
 *         failing sink reported wherever it fails, the same bytes in a country that writes 1,5, and names that break
 *         nothing.
 * Method: every writer runs over the same hand-made pieces.
 */
#include "bucket.h"
#include "handmade.h"
#include "readback.h"

#include "exchange/inventor.h"
#include "exchange/obj.h"
#include "exchange/outlet.h"
#include "exchange/ply.h"
#include "exchange/stl.h"

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <locale>
#include <unistd.h>

namespace {

struct writer {
    const char *name;
    status (*write)(const mesh_file &f, checkpoint_sink sink, void *self);
    soup (*read)(std::string_view bytes);
};

soup read_inventor(std::string_view bytes)
{
    return readback_inventor(bytes);
}

const writer writers[] = {{"stl", stl_write, readback_stl},
                          {"ply", ply_write, readback_ply},
                          {"obj", obj_write, readback_obj},
                          {"inventor", inventor_write, read_inventor}};

std::string written_by(const writer &w, handmade &piece, double step_mm, std::string_view name)
{
    const mesh m = piece.as_mesh();
    bucket b;
    EXPECT_EQ(w.write({&m, step_mm, name}, bucket_put, &b), STATUS_OK);
    return b.bytes;
}

class mesh_file_each : public testing::TestWithParam<writer> {
protected:
    std::string written(handmade &piece, double step_mm = 1, std::string_view name = "owl")
    {
        return written_by(GetParam(), piece, step_mm, name);
    }
    void expect_refused(const mesh &m, double step_mm, status expected)
    {
        bucket b;
        EXPECT_EQ(GetParam().write({&m, step_mm, "owl"}, bucket_put, &b), expected) << step_mm;
        EXPECT_EQ(b.bytes, "");
    }
};

TEST_P(mesh_file_each, same_floats_in_every_format)
{
    handmade ball = handmade_ball({101.7, -55.5, 3.1}, 17.9, 3);
    const soup mine = soup_weld(GetParam().read(written(ball, 0.123)));
    const mesh m = ball.as_mesh();
    bucket b;
    ASSERT_EQ(ply_write({&m, 0.123, ""}, bucket_put, &b), STATUS_OK);
    const soup ply = soup_weld(readback_ply(b.bytes));
    EXPECT_EQ(mine.at, ply.at);
    EXPECT_EQ(mine.triangles, ply.triangles);
}

TEST_P(mesh_file_each, sink_failing_at_every_byte)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    const mesh m = tetrahedron.as_mesh();
    const std::string whole = written(tetrahedron);
    for (size_t room = 0; room < whole.size(); room++) {
        bucket b;
        b.room = room;
        ASSERT_EQ(GetParam().write({&m, 1, "owl"}, bucket_put, &b), STATUS_IO) << room;
        ASSERT_EQ(b.calls_after_failure, 0) << room;
        ASSERT_EQ(b.bytes, whole.substr(0, room));
    }
    bucket enough;
    enough.room = whole.size();
    EXPECT_EQ(GetParam().write({&m, 1, "owl"}, bucket_put, &enough), STATUS_OK);
}

TEST_P(mesh_file_each, sink_failing_in_a_later_block)
{
    handmade ball = handmade_ball({0, 0, 0}, 11, 4);
    const mesh m = ball.as_mesh();
    const std::string whole = written(ball);
    ASSERT_GT(whole.size(), 3u * OUTLET_BLOCK_BYTES);
    for (size_t room = 0; room < whole.size(); room += OUTLET_BLOCK_BYTES / 3 + 1) {
        bucket b;
        b.room = room;
        ASSERT_EQ(GetParam().write({&m, 1, "owl"}, bucket_put, &b), STATUS_IO) << room;
        ASSERT_EQ(b.calls_after_failure, 0) << room;
        ASSERT_EQ(b.bytes, whole.substr(0, room));
    }
}

TEST_P(mesh_file_each, refuses_before_the_first_byte)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    mesh m = tetrahedron.as_mesh();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (double step_mm : {0.0, -1.0, nan, SCULPTURE_STEP_MM_MIN / 2, SCULPTURE_STEP_MM_MAX * 2})
        expect_refused(m, step_mm, STATUS_BAD_PARAMETER);
    m.vertex_count = MESH_FILE_COUNT_MAX + 1;
    expect_refused(m, 1, STATUS_TOO_LARGE);
    m = tetrahedron.as_mesh();
    m.triangle_count = MESH_FILE_COUNT_MAX + 1;
    expect_refused(m, 1, STATUS_TOO_LARGE);
    m = {};
    expect_refused(m, 1, STATUS_BAD_PARAMETER);
}

using mesh_file_each_death = mesh_file_each;

TEST_P(mesh_file_each_death, index_out_of_range_is_our_bug)
{
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    handmade tetrahedron = handmade_tetrahedron(8);
    tetrahedron.triangles[2][1] = 4;
    const mesh m = tetrahedron.as_mesh();
    bucket b;
    EXPECT_DEATH((void)GetParam().write({&m, 1, "owl"}, bucket_put, &b), "vertex_count");
}

TEST_P(mesh_file_each, names_break_nothing)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    const soup plain = GetParam().read(written(tetrahedron));
    for (std::string_view name : {"", "solid", "two\nlines", "a \"quote\" }", "ends in \\", "end_header\nf 9 9 9\n",
                                  "\xc3\xa9l\xc3\xa9phant", "#Inventor", "\r\n\t\x7f"}) {
        const soup s = GetParam().read(written(tetrahedron, 1, name));
        EXPECT_EQ(s.at, plain.at) << name;
        EXPECT_EQ(s.triangles, plain.triangles) << name;
    }
}

/* What streams and to_string-like formatting would consult. */
struct comma_punctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/* What printf and strtod would consult: an installed locale, or one compiled into a folder of the test's own. */
class comma_country {
public:
    comma_country()
    {
        for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "fr_FR.utf8"})
            if (std::setlocale(LC_ALL, name) && comma_is_set())
                return;
        folder_ = testing::TempDir() + "glaise_locale_" + std::to_string(getpid());
        std::filesystem::create_directories(folder_);
        const std::string command = "localedef -i de_DE -f UTF-8 '" + folder_ + "/de_DE.UTF-8' 2>/dev/null";
        if (std::system(command.c_str()) != 0)
            return;
        setenv("LOCPATH", folder_.c_str(), 1);
        std::setlocale(LC_ALL, "de_DE.UTF-8");
    }
    ~comma_country()
    {
        std::setlocale(LC_ALL, "C");
        unsetenv("LOCPATH");
        if (!folder_.empty())
            std::filesystem::remove_all(folder_);
    }
    comma_country(const comma_country &) = delete;
    comma_country &operator=(const comma_country &) = delete;

    static bool comma_is_set() { return std::string_view(std::localeconv()->decimal_point) == ","; }

private:
    std::string folder_;
};

TEST_P(mesh_file_each, decimal_comma_of_streams_changes_nothing)
{
    handmade ball = handmade_ball({1.25, -2.5, 3000.1}, 11.3, 3);
    const std::string expected = written(ball, 0.37);
    const std::locale before = std::locale::global(std::locale(std::locale(), new comma_punctuation));
    const std::string in_comma_country = written(ball, 0.37);
    std::locale::global(before);
    EXPECT_EQ(in_comma_country, expected);
}

/* One test for all writers: making a locale takes seconds. */
TEST(mesh_file, decimal_comma_of_printf_changes_nothing)
{
    handmade ball = handmade_ball({1.25, -2.5, 3000.1}, 11.3, 3);
    std::vector<std::string> expected, in_comma_country;
    for (const writer &w : writers)
        expected.push_back(written_by(w, ball, 0.37, "owl"));
    const comma_country abroad;
    if (!comma_country::comma_is_set())
        GTEST_SKIP() << "no locale with a decimal comma is installed, and localedef cannot make one";
    for (const writer &w : writers)
        in_comma_country.push_back(written_by(w, ball, 0.37, "owl"));
    EXPECT_EQ(in_comma_country, expected);
}

std::string name_of_writer(const testing::TestParamInfo<writer> &info)
{
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(formats, mesh_file_each, testing::ValuesIn(writers), name_of_writer);
INSTANTIATE_TEST_SUITE_P(formats, mesh_file_each_death, testing::ValuesIn(writers), name_of_writer);

std::string cleaned(std::string_view name)
{
    return mesh_file_name({nullptr, 1, name});
}

TEST(mesh_file, names_become_one_plain_line)
{
    EXPECT_EQ(cleaned("owl"), "owl");
    EXPECT_EQ(cleaned("a\nb\tc\x7f"), "a b c ");
    EXPECT_EQ(cleaned("say \"hoo\" \\"), "say 'hoo' /");
    EXPECT_EQ(cleaned(""), "piece");
    EXPECT_EQ(cleaned(" \n "), "piece");
    EXPECT_EQ(cleaned(std::string(60, 'x')), std::string(60, 'x'));
    EXPECT_EQ(cleaned(std::string(61, 'x')), std::string(60, 'x'));
    /* A two-byte character across the limit is left out whole, one that ends on it stays. */
    EXPECT_EQ(cleaned(std::string(59, 'x') + "\xc3\xa9"), std::string(59, 'x'));
    EXPECT_EQ(cleaned(std::string(58, 'x') + "\xc3\xa9y"), std::string(58, 'x') + "\xc3\xa9");
}

TEST(mesh_file, positions_are_rounded_once)
{
    handmade tetrahedron = handmade_tetrahedron(8);
    tetrahedron.vertices[1].brick = {12345, -7, 3};
    tetrahedron.vertices[1].offset[0] = 0.333333343f;
    const mesh m = tetrahedron.as_mesh();
    float p[3];
    mesh_file_position({&m, 0.1, ""}, 1, p);
    EXPECT_EQ(p[0], static_cast<float>((8.0 * 12345 + static_cast<double>(0.333333343f)) * 0.1));
    EXPECT_EQ(p[1], -5.6f);
    EXPECT_EQ(p[2], 2.4f);
}

} // namespace
