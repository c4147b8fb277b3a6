/* SPDX-License-Identifier: Apache-2.0 */
#include "history/preamble.h"

#include "clay/digest.h"
#include "history/byte_order.h"

enum { MARK_BYTES = 8, VERSION_AT = 8, HEADER_BYTES_AT = 12 };

void preamble_seal(const preamble *p, uint8_t *header)
{
    memcpy(header, p->mark, MARK_BYTES);
    byte_order_put_u32(header + VERSION_AT, p->version);
    byte_order_put_u32(header + HEADER_BYTES_AT, p->header_bytes);
    size_t vouched = p->header_bytes - PREAMBLE_CHECKSUM_BYTES;
    byte_order_put_u64(header + vouched, digest_bytes(header, vouched, 0));
}

static status refuse(preamble_trouble *trouble, uint64_t offset, const char *expected)
{
    *trouble = (preamble_trouble){offset, expected};
    return STATUS_CORRUPT;
}

status preamble_check(const preamble *p, const uint8_t *bytes, size_t have, preamble_trouble *trouble_out)
{
    if (have < PREAMBLE_BYTES)
        return refuse(trouble_out, have, "a header of 16 bytes at the least");
    if (memcmp(bytes, p->mark, MARK_BYTES) != 0)
        return refuse(trouble_out, 0, "the mark of this kind of file");
    uint32_t version = byte_order_get_u32(bytes + VERSION_AT);
    uint32_t size = byte_order_get_u32(bytes + HEADER_BYTES_AT);
    if (size < PREAMBLE_BYTES + PREAMBLE_CHECKSUM_BYTES || size > PREAMBLE_HEADER_BYTES_MAX)
        return refuse(trouble_out, HEADER_BYTES_AT, "a header size between 24 and 512");
    if (have < size)
        return refuse(trouble_out, have, "the rest of the header");
    size_t vouched = size - PREAMBLE_CHECKSUM_BYTES;
    if (byte_order_get_u64(bytes + vouched) != digest_bytes(bytes, vouched, 0))
        return refuse(trouble_out, vouched, "the checksum of the header");
    if (version > p->version) {
        *trouble_out = (preamble_trouble){VERSION_AT, "a version this program knows"};
        return STATUS_NEWER;
    }
    if (version != p->version || size != p->header_bytes)
        return refuse(trouble_out, VERSION_AT, "a version and the header size that goes with it");
    return STATUS_OK;
}
