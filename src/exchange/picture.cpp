/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/picture.h"

#include <csetjmp>
#include <png.h>

namespace {

struct delivery {
    checkpoint_sink sink;
    void *self;
    status state;
};

void deliver(png_structp png, png_bytep bytes, size_t n)
{
    delivery &d = *static_cast<delivery *>(png_get_io_ptr(png));
    d.state = d.sink(d.self, bytes, n);
    if (d.state != STATUS_OK)
        png_error(png, "sink");
}

/* libpng would flush a FILE here; the sink's owner decides about syncing. */
void deliver_nothing(png_structp)
{
}

[[noreturn]] void fail(png_structp png, png_const_charp)
{
    delivery &d = *static_cast<delivery *>(png_get_error_ptr(png));
    /* The parameters were checked and no file is read, so what libpng itself complains of is memory. */
    if (d.state == STATUS_OK)
        d.state = STATUS_NO_MEMORY;
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp)
{
}

struct sheet {
    uint32_t width, height;
    int channels;
    const picture_rows &rows;
};

/* Nothing in here may own anything: a failure leaves it by longjmp. No longjmp comes out of rows(): libpng is not at
   work then. */
void write_all(png_structp png, png_infop info, const sheet &s, delivery *d)
{
    png_set_IHDR(png, info, s.width, s.height, 8, s.channels == 4 ? PNG_COLOR_TYPE_RGBA : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (uint32_t y = 0; y < s.height; y++) {
        const uint8_t *row = nullptr;
        d->state = s.rows(y, &row);
        if (d->state != STATUS_OK)
            return;
        png_write_row(png, row);
    }
    png_write_end(png, nullptr);
}

} // namespace

status picture_write_rows(uint32_t width, uint32_t height, int channels, const picture_rows &rows,
                          checkpoint_sink sink, void *self)
{
    assert(sink != nullptr && rows != nullptr);
    if (width == 0 || width > PICTURE_SIDE_MAX || height == 0 || height > PICTURE_SIDE_MAX)
        return STATUS_BAD_PARAMETER;
    if (channels != 3 && channels != 4)
        return STATUS_BAD_PARAMETER;
    delivery d = {sink, self, STATUS_OK};
    const sheet s = {width, height, channels, rows};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &d, fail, ignore);
    if (png == nullptr)
        return STATUS_NO_MEMORY;
    png_infop info = png_create_info_struct(png);
    if (info == nullptr) {
        png_destroy_write_struct(&png, nullptr);
        return STATUS_NO_MEMORY;
    }
    png_set_write_fn(png, &d, deliver, deliver_nothing);
    if (setjmp(png_jmpbuf(png)) == 0)
        write_all(png, info, s, &d);
    png_destroy_write_struct(&png, &info);
    return d.state;
}

status picture_write(const picture &p, checkpoint_sink sink, void *self)
{
    const picture_rows rows = [&p](uint32_t y, const uint8_t **row_out) {
        assert(p.top != nullptr);
        *row_out = p.top + static_cast<ptrdiff_t>(y) * p.row_bytes;
        return STATUS_OK;
    };
    return picture_write_rows(p.width, p.height, p.channels, rows, sink, self);
}
