/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/outlet.h"

#include <bit>
#include <charconv>
#include <cstring>

namespace {

void flush(outlet &o)
{
    if (o.state == STATUS_OK && o.used > 0)
        o.state = o.sink(o.self, o.block.data(), o.used);
    o.used = 0;
}

} // namespace

void outlet_begin(outlet &o, checkpoint_sink sink, void *self)
{
    assert(sink != nullptr);
    o.sink = sink;
    o.self = self;
    o.state = STATUS_OK;
    o.used = 0;
}

status outlet_end(outlet &o)
{
    flush(o);
    return o.state;
}

void outlet_bytes(outlet &o, const void *bytes, size_t n)
{
    const unsigned char *from = static_cast<const unsigned char *>(bytes);
    while (n > 0) {
        if (o.used == o.block.size())
            flush(o);
        const size_t room = o.block.size() - o.used;
        const size_t part = n < room ? n : room;
        std::memcpy(o.block.data() + o.used, from, part);
        o.used += part;
        from += part;
        n -= part;
    }
}

void outlet_text(outlet &o, std::string_view text)
{
    outlet_bytes(o, text.data(), text.size());
}

void outlet_u8(outlet &o, unsigned value)
{
    const unsigned char byte = static_cast<unsigned char>(value);
    outlet_bytes(o, &byte, 1);
}

void outlet_u32(outlet &o, uint32_t value)
{
    const unsigned char bytes[4] = {
        static_cast<unsigned char>(value), static_cast<unsigned char>(value >> 8),
        static_cast<unsigned char>(value >> 16), static_cast<unsigned char>(value >> 24)};
    outlet_bytes(o, bytes, sizeof bytes);
}

void outlet_f32(outlet &o, float value)
{
    outlet_u32(o, std::bit_cast<uint32_t>(value));
}

void outlet_integer(outlet &o, uint64_t value)
{
    char text[20]; /* 2^64 - 1 has twenty digits */
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, value);
    outlet_bytes(o, text, static_cast<size_t>(end.ptr - text));
}

void outlet_decimal(outlet &o, float value, int digits)
{
    assert(digits >= 1 && digits <= 9);
    char text[32]; /* sign, nine digits, point, e-45: sixteen at most */
    const std::to_chars_result end =
        std::to_chars(text, text + sizeof text, static_cast<double>(value), std::chars_format::general, digits);
    outlet_bytes(o, text, static_cast<size_t>(end.ptr - text));
}
