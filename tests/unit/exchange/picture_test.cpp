/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal:   a picture comes out as a well-formed PNG with an sRGB chunk and exactly its pixels.
 * Method: chunks are walked and their checksums computed here; pixels are decoded by libpng's simplified reader; the
 *         sink fails at every byte.
 */
#include "bucket.h"

#include "exchange/picture.h"

#include <cstring>
#include <gtest/gtest.h>
#include <png.h>
#include <vector>

namespace {

std::vector<uint8_t> pixels_of(uint32_t width, uint32_t height, int channels)
{
    std::vector<uint8_t> bytes(size_t{width} * height * static_cast<size_t>(channels));
    uint32_t state = 7;
    for (uint8_t &b : bytes) {
        state = state * 1664525u + 1013904223u;
        b = static_cast<uint8_t>(state >> 24);
    }
    return bytes;
}

picture picture_of(const std::vector<uint8_t> &bytes, uint32_t width, uint32_t height, int channels)
{
    return {width, height, channels, bytes.data(), static_cast<ptrdiff_t>(width) * channels};
}

std::string written(const picture &p)
{
    bucket b;
    EXPECT_EQ(picture_write(p, bucket_put, &b), STATUS_OK);
    return b.bytes;
}

std::vector<uint8_t> decoded(const std::string &bytes, int channels)
{
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0) << image.message;
    /* The file's own layout has to be what was asked for: no conversion may hide a missing alpha. */
    EXPECT_EQ(image.format, channels == 4 ? uint32_t{PNG_FORMAT_RGBA} : uint32_t{PNG_FORMAT_RGB});
    std::vector<uint8_t> pixels(PNG_IMAGE_SIZE(image));
    EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0) << image.message;
    return pixels;
}

uint32_t big_endian(const std::string &bytes, size_t at)
{
    uint32_t value = 0;
    for (size_t n = 0; n < 4; n++)
        value = value << 8 | static_cast<unsigned char>(bytes.at(at + n));
    return value;
}

/* The checksum of PNG, bit by bit. */
uint32_t checksum(const std::string &bytes)
{
    uint32_t crc = ~0u;
    for (char c : bytes) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

TEST(picture, pixels_come_back)
{
    for (int channels : {3, 4}) {
        const std::vector<uint8_t> bytes = pixels_of(61, 37, channels);
        EXPECT_EQ(decoded(written(picture_of(bytes, 61, 37, channels)), channels), bytes);
    }
    const std::vector<uint8_t> one = {9, 8, 7};
    EXPECT_EQ(decoded(written(picture_of(one, 1, 1, 3)), 3), one);
}

TEST(picture, rows_may_lie_bottom_first_and_padded)
{
    const std::vector<uint8_t> bytes = pixels_of(5, 4, 4);
    constexpr size_t row = 5 * 4, padded = row + 12;
    std::vector<uint8_t> upside_down(4 * padded, 0xcc);
    for (size_t y = 0; y < 4; y++)
        std::memcpy(&upside_down[(3 - y) * padded], &bytes[y * row], row);
    const picture p = {5, 4, 4, &upside_down[3 * padded], -static_cast<ptrdiff_t>(padded)};
    EXPECT_EQ(decoded(written(p), 4), bytes);
}

TEST(picture, chunks_are_sound_and_say_srgb)
{
    const std::vector<uint8_t> bytes = pixels_of(300, 200, 4);
    const std::string png = written(picture_of(bytes, 300, 200, 4));
    ASSERT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    std::vector<std::string> names;
    for (size_t at = 8; at < png.size();) {
        const size_t n = big_endian(png, at);
        const std::string body = png.substr(at + 4, 4 + n);
        EXPECT_EQ(big_endian(png, at + 8 + n), checksum(body)) << body.substr(0, 4);
        if (names.empty() || names.back() != body.substr(0, 4))
            names.push_back(body.substr(0, 4));
        if (names.back() == "IHDR") {
            EXPECT_EQ(body.substr(4), std::string("\0\0\x01\x2c\0\0\0\xc8\x08\x06\0\0\0", 13));
        }
        if (names.back() == "sRGB") {
            EXPECT_EQ(body.substr(4), std::string(1, '\0'));
        }
        at += 12 + n;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"IHDR", "sRGB", "IDAT", "IEND"}));
}

TEST(picture, same_pixels_same_bytes)
{
    const std::vector<uint8_t> bytes = pixels_of(64, 64, 3);
    EXPECT_EQ(written(picture_of(bytes, 64, 64, 3)), written(picture_of(bytes, 64, 64, 3)));
}

TEST(picture, rows_made_one_by_one_are_the_same_file)
{
    const std::vector<uint8_t> bytes = pixels_of(61, 37, 4);
    std::vector<uint8_t> row(61 * 4);
    uint32_t asked = 0;
    const picture_rows rows = [&](uint32_t y, const uint8_t **row_out) {
        EXPECT_EQ(y, asked++);
        row.assign(bytes.begin() + y * 61 * 4, bytes.begin() + (y + 1) * 61 * 4);
        *row_out = row.data();
        return STATUS_OK;
    };
    bucket b;
    ASSERT_EQ(picture_write_rows(61, 37, 4, rows, bucket_put, &b), STATUS_OK);
    EXPECT_EQ(asked, 37u);
    EXPECT_EQ(b.bytes, written(picture_of(bytes, 61, 37, 4)));
}

TEST(picture, a_row_that_cannot_be_made_ends_it)
{
    const std::vector<uint8_t> row(8 * 3, 1);
    uint32_t last = 0;
    const picture_rows rows = [&](uint32_t y, const uint8_t **row_out) {
        last = y;
        *row_out = row.data();
        return y == 3 ? STATUS_TOO_LARGE : STATUS_OK;
    };
    bucket b;
    EXPECT_EQ(picture_write_rows(8, 8, 3, rows, bucket_put, &b), STATUS_TOO_LARGE);
    EXPECT_EQ(last, 3u);
    EXPECT_EQ(b.bytes.find("IEND"), std::string::npos);
    EXPECT_EQ(picture_write_rows(PICTURE_SIDE_MAX + 1, 8, 3, rows, bucket_put, &b), STATUS_BAD_PARAMETER);
}

TEST(picture, refuses_before_the_first_byte)
{
    const std::vector<uint8_t> bytes = pixels_of(4, 4, 4);
    const picture good = picture_of(bytes, 4, 4, 4);
    std::vector<picture> bad(6, good);
    bad[0].width = 0;
    bad[1].height = 0;
    bad[2].width = PICTURE_SIDE_MAX + 1;
    bad[3].height = PICTURE_SIDE_MAX + 1;
    bad[4].channels = 2;
    bad[5].channels = 5;
    for (const picture &p : bad) {
        bucket b;
        EXPECT_EQ(picture_write(p, bucket_put, &b), STATUS_BAD_PARAMETER);
        EXPECT_EQ(b.bytes, "");
    }
}

TEST(picture, sink_failing_at_every_byte)
{
    const std::vector<uint8_t> bytes = pixels_of(23, 11, 3);
    const picture p = picture_of(bytes, 23, 11, 3);
    const std::string whole = written(p);
    for (size_t room = 0; room < whole.size(); room++) {
        bucket b;
        b.room = room;
        ASSERT_EQ(picture_write(p, bucket_put, &b), STATUS_IO) << room;
        ASSERT_EQ(b.calls_after_failure, 0) << room;
        ASSERT_EQ(b.bytes, whole.substr(0, room));
    }
}

} // namespace
