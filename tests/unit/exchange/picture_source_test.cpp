/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   every kind of PNG becomes the pixels it stands for; what is none, is cut, is damaged or is too large is refused
 *         with the place and what was expected, before memory is taken for it.
 * Method: files are put together here chunk by chunk, from samples, with zlib and nothing else, and what has to come out
 *         is computed from the same samples by the format's own words. A source hands out exact copies and can fail.
 */
#include "bucket.h"

#include "exchange/picture.h"
#include "exchange/picture_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <zlib.h>

namespace {

enum kind { GREY = 0, COLOUR = 2, PALETTE = 3, GREY_ALPHA = 4, COLOUR_ALPHA = 6 };

size_t channels_of(int kind)
{
    return kind == COLOUR ? 3 : kind == COLOUR_ALPHA ? 4 : kind == GREY_ALPHA ? 2 : 1;
}

struct sheet {
    uint32_t width = 7, height = 5;
    int depth = 8, kind = COLOUR_ALPHA;
    bool interlaced = false;
    std::string palette, transparent; /* PLTE, tRNS */

    uint32_t sample(uint32_t x, uint32_t y, size_t channel) const
    {
        const uint32_t most = (1u << depth) - 1;
        const uint32_t v = (x * 2657 + y * 7919 + static_cast<uint32_t>(channel) * 104729 + x * y * 31) * 2654435761u;
        return (v >> 12) & (kind == PALETTE ? std::min(most, 3u) : most);
    }
};

std::string word_of(uint32_t v)
{
    std::string out;
    for (int shift : {24, 16, 8, 0})
        out += static_cast<char>(v >> shift);
    return out;
}

std::string chunk(const std::string &name, const std::string &body)
{
    const std::string sum = name + body;
    const uLong crc = crc32(0, reinterpret_cast<const Bytef *>(sum.data()), static_cast<uInt>(sum.size()));
    return word_of(static_cast<uint32_t>(body.size())) + sum + word_of(static_cast<uint32_t>(crc));
}

std::string squeezed(const std::string &bytes)
{
    std::string out(compressBound(bytes.size()), '\0');
    uLongf n = out.size();
    EXPECT_EQ(compress(reinterpret_cast<Bytef *>(out.data()), &n, reinterpret_cast<const Bytef *>(bytes.data()),
                       bytes.size()), Z_OK);
    out.resize(n);
    return out;
}

/* Rows of the pixels x0, x0 + dx, ... of the rows y0, y0 + dy, ..., unfiltered. */
std::string rows_of(const sheet &s, uint32_t x0, uint32_t y0, uint32_t dx, uint32_t dy)
{
    std::string out;
    for (uint32_t y = y0; y < s.height && x0 < s.width; y += dy) {
        out += '\0';
        uint32_t bits = 0;
        int held = 0;
        for (uint32_t x = x0; x < s.width; x += dx)
            for (size_t c = 0; c < channels_of(s.kind); c++) {
                bits = bits << s.depth | s.sample(x, y, c);
                for (held += s.depth; held >= 8; held -= 8)
                    out += static_cast<char>(bits >> (held - 8));
            }
        if (held > 0)
            out += static_cast<char>(bits << (8 - held));
    }
    return out;
}

std::string pixels_of(const sheet &s)
{
    if (!s.interlaced)
        return rows_of(s, 0, 0, 1, 1);
    std::string out;
    for (const auto &[x0, y0, dx, dy] : std::array<std::array<uint32_t, 4>, 7>{
             {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}})
        out += rows_of(s, x0, y0, dx, dy);
    return out;
}

std::string head_of(const sheet &s)
{
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", word_of(s.width) + word_of(s.height) + static_cast<char>(s.depth) +
                                                   static_cast<char>(s.kind) + std::string(2, '\0') +
                                                   static_cast<char>(s.interlaced));
}

std::string file_of(const sheet &s, const std::string &more = "")
{
    return head_of(s) + more + (s.palette.empty() ? "" : chunk("PLTE", s.palette)) +
           (s.transparent.empty() ? "" : chunk("tRNS", s.transparent)) + chunk("IDAT", squeezed(pixels_of(s))) +
           chunk("IEND", "");
}

/* To 8 bits, rounded to the nearest. */
uint8_t scaled(uint32_t sample, int depth)
{
    const uint32_t most = (1u << depth) - 1;
    return static_cast<uint8_t>((sample * 255 * 2 + most) / (2 * most));
}

std::vector<uint8_t> meant(const sheet &s)
{
    std::vector<uint8_t> out;
    for (uint32_t y = 0; y < s.height; y++)
        for (uint32_t x = 0; x < s.width; x++) {
            const auto v = [&](size_t c) { return scaled(s.sample(x, y, c), s.depth); };
            const size_t index = 3 * s.sample(x, y, 0);
            std::array<uint8_t, 4> p{};
            switch (s.kind) {
            case GREY: p = {v(0), v(0), v(0), 255}; break;
            case GREY_ALPHA: p = {v(0), v(0), v(0), v(1)}; break;
            case COLOUR: p = {v(0), v(1), v(2), 255}; break;
            case COLOUR_ALPHA: p = {v(0), v(1), v(2), v(3)}; break;
            default:
                for (size_t c = 0; c < 3; c++)
                    p[c] = static_cast<uint8_t>(s.palette.at(index + c));
                p[3] = index / 3 < s.transparent.size() ? static_cast<uint8_t>(s.transparent[index / 3]) : 255;
            }
            out.insert(out.end(), p.begin(), p.end());
        }
    return out;
}

struct answer {
    exchange_outcome outcome;
    picture_source picture;
};

answer read(const std::string &bytes, size_t bytes_max = PICTURE_SOURCE_BYTES_MAX)
{
    bucket b;
    b.bytes = bytes;
    answer a;
    a.picture.width = 99; /* what was there before must go */
    a.outcome = picture_source_read(bucket_get, &b, &a.picture, bytes_max);
    return a;
}

void expect_refused(const answer &a, status state, const std::string &text)
{
    EXPECT_EQ(a.outcome.state, state) << a.outcome.text;
    EXPECT_NE(a.outcome.text.find(text), std::string::npos) << a.outcome.text << ", and not: " << text;
    EXPECT_TRUE(a.picture.rgba.empty() && a.picture.width == 0 && a.picture.height == 0);
}

} // namespace

TEST(picture_source, reads_every_kind_and_depth_interlaced_or_not)
{
    const std::vector<std::pair<int, std::vector<int>>> kinds = {{GREY, {1, 2, 4, 8, 16}},
                                                                 {COLOUR, {8, 16}},
                                                                 {PALETTE, {2, 4, 8}},
                                                                 {GREY_ALPHA, {8, 16}},
                                                                 {COLOUR_ALPHA, {8, 16}}};
    for (const auto &[kind, depths] : kinds)
        for (const int depth : depths)
            for (const bool interlaced : {false, true})
                for (const uint32_t side : {1u, 7u, 19u}) {
                    sheet s;
                    s.kind = kind;
                    s.depth = depth;
                    s.interlaced = interlaced;
                    s.width = side;
                    s.height = side + 4;
                    if (kind == PALETTE)
                        s.palette = "\x10\x20\x30\xff\x01\x02\x7f\x80\x81\xfe\xfd\xfc";
                    const answer a = read(file_of(s));
                    ASSERT_EQ(a.outcome.state, STATUS_OK) << kind << " " << depth << ": " << a.outcome.text;
                    EXPECT_EQ(a.outcome.text, "");
                    EXPECT_EQ(a.picture.width, s.width);
                    EXPECT_EQ(a.picture.height, s.height);
                    EXPECT_EQ(a.picture.rgba, meant(s)) << kind << " " << depth << " " << interlaced;
                }
}

TEST(picture_source, a_transparent_colour_becomes_alpha)
{
    sheet s;
    s.kind = PALETTE;
    s.depth = 4;
    s.palette = "\x10\x20\x30\xff\x01\x02\x7f\x80\x81\xfe\xfd\xfc";
    s.transparent = "\x80\x40"; /* fewer than colours */
    EXPECT_EQ(read(file_of(s)).picture.rgba, meant(s));
    sheet grey;
    grey.kind = GREY;
    grey.transparent = std::string(1, '\0') + static_cast<char>(grey.sample(3, 2, 0));
    const answer a = read(file_of(grey));
    ASSERT_EQ(a.outcome.state, STATUS_OK) << a.outcome.text;
    EXPECT_EQ(a.picture.rgba[(2 * grey.width + 3) * 4 + 3], 0);
    EXPECT_EQ(std::count(a.picture.rgba.begin(), a.picture.rgba.end(), 0) > 0, true);
}

TEST(picture_source, reads_what_the_writer_wrote)
{
    std::vector<uint8_t> bytes(33 * 9 * 4);
    for (size_t n = 0; n < bytes.size(); n++)
        bytes[n] = static_cast<uint8_t>(n * 37 + n / 100);
    bucket b;
    ASSERT_EQ(picture_write({33, 9, 4, bytes.data(), 33 * 4}, bucket_put, &b), STATUS_OK);
    EXPECT_EQ(read(b.bytes).picture.rgba, bytes);
}

TEST(picture_source, what_else_a_file_says_is_passed_over_however_long)
{
    sheet s;
    const std::string much(9000000, 'x');
    const std::string more = chunk("gAMA", word_of(100000)) + chunk("iCCP", "wrong") + chunk("tEXt", much) +
                             chunk("eXIf", much) + chunk("zzZz", "unknown");
    const answer a = read(file_of(s, more));
    ASSERT_EQ(a.outcome.state, STATUS_OK) << a.outcome.text;
    EXPECT_EQ(a.picture.rgba, meant(s));
}

TEST(picture_source, what_is_no_png_is_told_at_its_beginning)
{
    for (const std::string &bytes :
         {std::string(), std::string("\x89PNG"), std::string("glaise tape 1\n"), std::string("\xff\xd8\xff\xe0JFIF....")})
        expect_refused(read(bytes), STATUS_CORRUPT, "offset 0: expected the eight bytes that a PNG file begins with");
}

TEST(picture_source, a_file_cut_anywhere_is_told_with_the_place)
{
    for (const bool interlaced : {false, true}) {
        sheet s;
        s.interlaced = interlaced;
        const std::string whole = file_of(s);
        for (size_t size = 8; size < whole.size(); size++) {
            const answer a = read(whole.substr(0, size));
            expect_refused(a, STATUS_CORRUPT, "offset " + std::to_string(size) + ": expected more of the picture");
            if (testing::Test::HasFailure())
                break;
        }
    }
}

TEST(picture_source, damage_is_told_and_never_taken)
{
    const std::string whole = file_of(sheet{});
    for (size_t at = 8; at < whole.size(); at++) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x20);
        const answer a = read(damaged);
        EXPECT_NE(a.outcome.state, STATUS_OK) << at; /* every byte is under a checksum */
        EXPECT_TRUE(a.outcome.text.starts_with("offset ")) << a.outcome.text;
        EXPECT_TRUE(a.picture.rgba.empty());
    }
}

TEST(picture_source, pixels_that_are_missing_are_told)
{
    sheet s;
    const std::string few = pixels_of(s).substr(0, 60);
    const std::string file = head_of(s) + chunk("IDAT", squeezed(few)) + chunk("IEND", "");
    expect_refused(read(file), STATUS_CORRUPT, "expected a sound PNG before this place");
    expect_refused(read(head_of(s) + chunk("IEND", "")), STATUS_CORRUPT, "expected a sound PNG before this place");
}

TEST(picture_source, sizes_are_looked_at_before_anything_is_made)
{
    sheet s;
    s.width = 0;
    expect_refused(read(file_of(s)), STATUS_CORRUPT, "expected a sound PNG before this place (Invalid IHDR");
    s.width = PICTURE_SIDE_MAX + 1;
    s.height = 1;
    expect_refused(read(file_of(s)), STATUS_TOO_LARGE, "offset 16: expected a width of 1 to 65536 pixels, not 65537");
    std::swap(s.width, s.height);
    expect_refused(read(file_of(s)), STATUS_TOO_LARGE, "offset 20: expected a height of 1 to 65536 pixels, not 65537");
    /* 16 GiB of pixels in less than a hundred bytes */
    s.width = s.height = PICTURE_SIDE_MAX;
    const std::string bomb = head_of(s) + chunk("IDAT", squeezed("\0")) + chunk("IEND", "");
    expect_refused(read(bomb), STATUS_TOO_LARGE, "offset 16: expected at most 33554432 pixels, not 65536 x 65536");
    sheet exact;
    EXPECT_EQ(read(file_of(exact), 7 * 5 * 4).outcome.state, STATUS_OK);
    expect_refused(read(file_of(exact), 7 * 5 * 4 - 1), STATUS_TOO_LARGE, "at most 34 pixels, not 7 x 5");
}

TEST(picture_source, what_the_source_answers_comes_back)
{
    bucket b;
    b.bytes = file_of(sheet{});
    b.failed = true;
    picture_source p;
    const exchange_outcome o = picture_source_read(bucket_get, &b, &p);
    EXPECT_EQ(o.state, STATUS_IO);
    EXPECT_EQ(o.text, status_text(STATUS_IO));
}
