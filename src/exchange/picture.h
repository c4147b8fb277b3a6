/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Pixels as a PNG, delivered to a sink: snapshots, and the pictures tests compare.
 * Is not:  A renderer (view); a reader of PNG files (picture_source.h).
 * Shape:   8 bits a channel, RGB or RGBA (straight alpha), with an sRGB chunk: the bytes are display values. No time
 *          and no text chunks: same pixels, same bytes. Rows may lie bottom first, as OpenGL hands them over; or be made
 *          one after the other, from the top, for a picture that is not to lie in memory whole: the same bytes again.
 * Owner:   the pixels stay the caller's.
 * Errors:  STATUS_BAD_PARAMETER for a side of 0 or above PICTURE_SIDE_MAX or channels other than 3 and 4;
 *          STATUS_NO_MEMORY; the sink's; that of whoever makes the rows. No byte leaves before the parameters are
 *          found good.
 * Cost:    zlib's: 0.15 s of one core for a million pixels as measured. Not for the frame path.
 * Source:  000 section 2 ("save a screen snapshot").
 */
#ifndef GLAISE_EXCHANGE_PICTURE_H
#define GLAISE_EXCHANGE_PICTURE_H

#include "sculpture/sculpture.h"

#include <functional>

enum { PICTURE_SIDE_MAX = 65536 };

struct picture {
    uint32_t width, height;
    int channels;        /* 3 or 4 */
    const uint8_t *top;  /* first byte of the row shown uppermost */
    ptrdiff_t row_bytes; /* from one row to the one shown below it; negative where rows lie bottom first */
};

/* Answers the row y, which holds until the next is asked for; y = 0, 1, 2, ... */
using picture_rows = std::function<status(uint32_t y, const uint8_t **row_out)>;

[[nodiscard]] status picture_write(const picture &p, checkpoint_sink sink, void *self);
[[nodiscard]] status picture_write_rows(uint32_t width, uint32_t height, int channels, const picture_rows &rows,
                                        checkpoint_sink sink, void *self);

#endif
