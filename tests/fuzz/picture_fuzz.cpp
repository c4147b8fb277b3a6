/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No bytes make the reader of PNG files read outside them, take more memory than its limit, or answer a picture
 *         that is not whole; what it refuses it refuses with a sentence; what it accepts can be written and read again.
 * Method  The input is the file, handed out in exact copies; then the same with the checksums of its chunks put right, so
 *         that what lies behind them is reached.
 */
#include "exchange/picture.h"
#include "exchange/picture_source.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <zlib.h>

namespace {

constexpr size_t BYTES_MAX = 1 << 20, SIGNATURE_BYTES = 8, FRAME_BYTES = 12;

using byte_string = std::vector<uint8_t>;

void require(bool truth)
{
    if (!truth)
        std::abort();
}

status give(void *self, uint64_t offset, void *bytes, size_t n, size_t *got)
{
    const byte_string &in = *static_cast<const byte_string *>(self);
    *got = offset < in.size() ? std::min(n, in.size() - static_cast<size_t>(offset)) : 0;
    if (*got > 0)
        std::memcpy(bytes, in.data() + offset, *got);
    return STATUS_OK;
}

status keep(void *self, const void *bytes, size_t n)
{
    byte_string &out = *static_cast<byte_string *>(self);
    const uint8_t *b = static_cast<const uint8_t *>(bytes);
    out.insert(out.end(), b, b + n);
    return STATUS_OK;
}

uint32_t word_at(const byte_string &b, size_t at)
{
    return uint32_t{b[at]} << 24 | uint32_t{b[at + 1]} << 16 | uint32_t{b[at + 2]} << 8 | b[at + 3];
}

void put_checksums_right(byte_string &b)
{
    for (size_t at = SIGNATURE_BYTES; at + FRAME_BYTES <= b.size();) {
        const size_t body = word_at(b, at);
        if (body > b.size() - at - FRAME_BYTES)
            return;
        const auto crc = static_cast<uint32_t>(crc32(0, &b[at + 4], static_cast<uInt>(body + 4)));
        for (size_t n = 0; n < 4; n++)
            b[at + 8 + body + n] = static_cast<uint8_t>(crc >> (24 - 8 * n));
        at += FRAME_BYTES + body;
    }
}

void check(byte_string &file)
{
    picture_source p;
    const exchange_outcome o = picture_source_read(give, &file, &p, BYTES_MAX);
    if (o.state != STATUS_OK) {
        require(o.state == STATUS_CORRUPT || o.state == STATUS_TOO_LARGE);
        require(o.text.starts_with("offset ") && o.text.find(": expected ") != std::string::npos);
        require(p.rgba.empty() && p.width == 0 && p.height == 0);
        return;
    }
    require(o.text.empty() && p.width > 0 && p.height > 0 && p.rgba.size() <= BYTES_MAX);
    require(p.rgba.size() == size_t{p.width} * p.height * 4);
    byte_string again;
    picture_source back;
    require(picture_write({p.width, p.height, 4, p.rgba.data(), static_cast<ptrdiff_t>(p.width) * 4}, keep, &again) ==
            STATUS_OK);
    require(picture_source_read(give, &again, &back, BYTES_MAX).state == STATUS_OK && back.rgba == p.rgba);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    byte_string file(data, data + size);
    check(file);
    put_checksums_right(file);
    check(file);
    return 0;
}
