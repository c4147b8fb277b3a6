/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/picture_source.h"

#include "exchange/picture.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <png.h>
#include <tuple>

namespace {

constexpr size_t SIGNATURE_BYTES = 8, WIDTH_OFFSET = 16, HEIGHT_OFFSET = 20;
constexpr size_t CHANNELS = 4;

struct reading {
    checkpoint_source source;
    void *self;
    picture_source *out;
    size_t bytes_max;
    uint64_t offset = 0; /* what was read so far */
    status state = STATUS_OK;
    char text[200] = "";
};

void refuse(reading *r, status state, uint64_t offset, const char *expected)
{
    if (r->state != STATUS_OK)
        return;
    r->state = state;
    std::snprintf(r->text, sizeof r->text, "offset %llu: expected %s", static_cast<unsigned long long>(offset),
                  expected);
}

void fetch(png_structp png, png_bytep bytes, size_t n)
{
    reading &r = *static_cast<reading *>(png_get_io_ptr(png));
    size_t got = 0;
    const status s = r.source(r.self, r.offset, bytes, n, &got);
    if (s != STATUS_OK) {
        r.state = s;
        std::snprintf(r.text, sizeof r.text, "%s", status_text(s));
    } else if (got < n) {
        refuse(&r, STATUS_CORRUPT, r.offset + got, "more of the picture: the file ends here");
    }
    r.offset += got;
    if (r.state != STATUS_OK)
        png_error(png, "source");
}

[[noreturn]] void fail(png_structp png, png_const_charp why)
{
    reading &r = *static_cast<reading *>(png_get_error_ptr(png));
    char expected[160];
    std::snprintf(expected, sizeof expected, "a sound PNG before this place (%.80s)", why);
    const bool memory = std::strstr(why, "memory") != nullptr;
    refuse(&r, memory ? STATUS_NO_MEMORY : STATUS_CORRUPT, r.offset, expected);
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

bool signature_is_good(reading *r)
{
    png_byte bytes[SIGNATURE_BYTES] = {};
    size_t got = 0;
    const status s = r->source(r->self, 0, bytes, sizeof bytes, &got);
    if (s != STATUS_OK) {
        r->state = s;
        std::snprintf(r->text, sizeof r->text, "%s", status_text(s));
    } else if (got < sizeof bytes || png_sig_cmp(bytes, 0, sizeof bytes) != 0) {
        refuse(r, STATUS_CORRUPT, 0, "the eight bytes that a PNG file begins with");
    }
    return r->state == STATUS_OK;
}

/* What libpng has found in the header is looked at before anything of that size is asked for. */
bool size_is_good(reading *r, png_uint_32 width, png_uint_32 height)
{
    char expected[120];
    for (const auto &[side, offset, what] :
         {std::tuple(width, WIDTH_OFFSET, "width"), std::tuple(height, HEIGHT_OFFSET, "height")})
        if (side > PICTURE_SIDE_MAX) {
            std::snprintf(expected, sizeof expected, "a %s of 1 to %d pixels, not %lu", what, +PICTURE_SIDE_MAX,
                          static_cast<unsigned long>(side));
            refuse(r, STATUS_TOO_LARGE, offset, expected);
            return false;
        }
    if (uint64_t{width} * height > r->bytes_max / CHANNELS) {
        std::snprintf(expected, sizeof expected, "at most %zu pixels, not %lu x %lu", r->bytes_max / CHANNELS,
                      static_cast<unsigned long>(width), static_cast<unsigned long>(height));
        refuse(r, STATUS_TOO_LARGE, WIDTH_OFFSET, expected);
        return false;
    }
    return true;
}

/* From here on this is in memory, and nothing below takes any that libpng does not give back. */
bool room_is_made(reading *r, png_uint_32 width, png_uint_32 height)
{
    try {
        r->out->rgba.resize(size_t{width} * height * CHANNELS);
    } catch (const std::bad_alloc &) {
        r->state = STATUS_NO_MEMORY;
        std::snprintf(r->text, sizeof r->text, "%s", status_text(STATUS_NO_MEMORY));
        return false;
    }
    r->out->width = width;
    r->out->height = height;
    return true;
}

/* Nothing in here may own anything: a failure leaves it by longjmp. */
void read_all(png_structp png, png_infop info, reading *r)
{
    png_read_info(png, info);
    const png_uint_32 width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    if (!size_is_good(r, width, height))
        return;
    png_set_expand(png); /* palettes, fewer than 8 bits, a transparent colour */
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const size_t row_bytes = size_t{width} * CHANNELS;
    if (png_get_rowbytes(png, info) != row_bytes)
        png_error(png, "rows of an unknown kind");
    if (!room_is_made(r, width, height))
        return;
    for (int pass = 0; pass < passes; pass++)
        for (png_uint_32 y = 0; y < height; y++)
            png_read_row(png, r->out->rgba.data() + y * row_bytes, nullptr);
    png_read_end(png, nullptr);
}

void read_with(png_structp png, png_infop info, reading *r)
{
    png_set_read_fn(png, r, fetch);
    png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX); /* size_is_good knows ours, and says them */
    png_set_chunk_malloc_max(png, 0); /* what is passed over may have any length: no memory is taken for it */
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    if (setjmp(png_jmpbuf(png)) == 0)
        read_all(png, info, r);
}

} // namespace

exchange_outcome picture_source_read(checkpoint_source source, void *self, picture_source *out, size_t bytes_max)
{
    *out = {};
    reading r = {source, self, out, bytes_max};
    if (signature_is_good(&r)) {
        png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, fail, ignore);
        png_infop info = png ? png_create_info_struct(png) : nullptr;
        if (info)
            read_with(png, info, &r);
        else
            r = {source, self, out, bytes_max, 0, STATUS_NO_MEMORY, "out of memory"};
        png_destroy_read_struct(&png, &info, nullptr);
    }
    if (r.state != STATUS_OK)
        *out = {};
    return {r.state, r.text};
}
