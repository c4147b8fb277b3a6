/* SPDX-License-Identifier: Apache-2.0 */
#include "history/cursor_file.h"

#include "history/byte_order.h"
#include "history/history.h"
#include "history/undo_file.h"
#include "history/whole_file.h"

#include <math.h>

enum {
    OLDEST_AT = 16,
    CURSOR_AT = 24,
    NEWEST_AT = 32,
    DAB_AT = 40,
    STEP_AT = 48,
    RING_AT = 56,
    ZERO_AT = 60,
};

static const preamble header_preamble = {"glcurs\r\n", CURSOR_FILE_VERSION, CURSOR_FILE_BYTES};

status cursor_file_write(const cursor_file *f, const byte_store *store)
{
    uint8_t h[CURSOR_FILE_BYTES];
    byte_order_put_u64(h + OLDEST_AT, f->oldest);
    byte_order_put_u64(h + CURSOR_AT, f->cursor);
    byte_order_put_u64(h + NEWEST_AT, f->newest);
    byte_order_put_u64(h + DAB_AT, f->dab);
    byte_order_put_double(h + STEP_AT, f->step_mm);
    byte_order_put_u32(h + RING_AT, f->ring);
    byte_order_put_u32(h + ZERO_AT, 0);
    preamble_seal(&header_preamble, h);
    return whole_file_replace(store, CURSOR_FILE_NAME ".new", CURSOR_FILE_NAME, h, sizeof h);
}

static status refuse(preamble_trouble *trouble, uint64_t offset, const char *expected)
{
    *trouble = (preamble_trouble){offset, expected};
    return STATUS_CORRUPT;
}

static status validate(const cursor_file *f, preamble_trouble *trouble)
{
    if (f->ring < 1 || f->ring > HISTORY_RING_MAX)
        return refuse(trouble, RING_AT, "a ring of 1 to 9999 files");
    /* Half of what an undo-file may say, so that counting on never reaches that. */
    if (f->newest > UNDO_FILE_STROKE_MAX / 2 || f->oldest < 1 || f->oldest > f->cursor + 1 || f->cursor > f->newest ||
        f->newest >= f->oldest + f->ring)
        return refuse(trouble, OLDEST_AT, "stroke numbers in order, within one ring");
    if (!isfinite(f->step_mm) || f->step_mm <= 0)
        return refuse(trouble, STEP_AT, "a finite step above zero");
    return STATUS_OK;
}

status cursor_file_read(cursor_file *f_out, const byte_store *store, bool *exists_out, preamble_trouble *trouble_out)
{
    uint8_t h[PREAMBLE_HEADER_BYTES_MAX];
    size_t have = 0;
    uint64_t size = 0;
    status s = whole_file_read_head(store, CURSOR_FILE_NAME, h, sizeof h, &have, &size, exists_out);
    if (s != STATUS_OK || !*exists_out)
        return s;
    s = preamble_check(&header_preamble, h, have, trouble_out);
    if (s != STATUS_OK)
        return s;
    if (size != CURSOR_FILE_BYTES || byte_order_get_u32(h + ZERO_AT) != 0)
        return refuse(trouble_out, CURSOR_FILE_BYTES, "the end of the file");
    cursor_file f = {
        .oldest = byte_order_get_u64(h + OLDEST_AT),
        .cursor = byte_order_get_u64(h + CURSOR_AT),
        .newest = byte_order_get_u64(h + NEWEST_AT),
        .dab = byte_order_get_u64(h + DAB_AT),
        .step_mm = byte_order_get_double(h + STEP_AT),
        .ring = byte_order_get_u32(h + RING_AT),
    };
    s = validate(&f, trouble_out);
    if (s == STATUS_OK)
        *f_out = f;
    return s;
}
