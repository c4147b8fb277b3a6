/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Bytes on their way out: numbers and text gathered into blocks and handed to a sink, in order. The first
 *          failure of the sink sticks, so a writer looks at the answer once, at the end.
 * Is not:  A file: whoever owns the sink opens, syncs and renames (platform/storage, joined in wiring).
 * Shape:   the sink is history/checkpoint.h's, so that meshes, pictures and the native file leave by the same door.
 *          Binary numbers are little-endian on every machine; decimals have a point in every locale.
 * Owner:   the caller owns the struct (16 KiB, fine on a stack) and the sink.
 * Errors:  outlet_end answers the sink's first failure. From that failure on the sink is not called again and further
 *          bytes are dropped: what it took before is a beginning of the file.
 * Cost:    one sink call per OUTLET_BLOCK_BYTES.
 */
#ifndef GLAISE_EXCHANGE_OUTLET_H
#define GLAISE_EXCHANGE_OUTLET_H

#include "sculpture/sculpture.h"

#include <array>
#include <string_view>

enum { OUTLET_BLOCK_BYTES = 16384 };

struct outlet {
    checkpoint_sink sink;
    void *self;
    status state;
    size_t used;
    std::array<unsigned char, OUTLET_BLOCK_BYTES> block;
};

void outlet_begin(outlet &o, checkpoint_sink sink, void *self);
/* Hands over what is still held. */
[[nodiscard]] status outlet_end(outlet &o);

void outlet_bytes(outlet &o, const void *bytes, size_t n);
void outlet_text(outlet &o, std::string_view text);
void outlet_u8(outlet &o, unsigned value);
void outlet_u32(outlet &o, uint32_t value);
void outlet_f32(outlet &o, float value);
void outlet_integer(outlet &o, uint64_t value);
/* As printf's %.*g in the C locale. Nine digits bring any float back bit for bit. */
void outlet_decimal(outlet &o, float value, int digits = 9);

#endif
