/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Integers and floats to and from little-endian bytes, whatever the machine's own order.
 * Is not:  A bounds check: the caller has made sure of 4 or 8 bytes.
 * Cost:    One move on a little-endian machine.
 */
#ifndef GLAISE_HISTORY_BYTE_ORDER_H
#define GLAISE_HISTORY_BYTE_ORDER_H

#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

static inline void byte_order_put_u32(uint8_t *to, uint32_t v)
{
    for (int n = 0; n < 4; n++)
        to[n] = (uint8_t)(v >> (8 * n));
}

static inline void byte_order_put_u64(uint8_t *to, uint64_t v)
{
    for (int n = 0; n < 8; n++)
        to[n] = (uint8_t)(v >> (8 * n));
}

static inline uint32_t byte_order_get_u32(const uint8_t *from)
{
    return (uint32_t)from[0] | (uint32_t)from[1] << 8 | (uint32_t)from[2] << 16 | (uint32_t)from[3] << 24;
}

static inline uint64_t byte_order_get_u64(const uint8_t *from)
{
    return (uint64_t)byte_order_get_u32(from) | (uint64_t)byte_order_get_u32(from + 4) << 32;
}

static inline void byte_order_put_float(uint8_t *to, float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    byte_order_put_u32(to, bits);
}

static inline float byte_order_get_float(const uint8_t *from)
{
    uint32_t bits = byte_order_get_u32(from);
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static inline void byte_order_put_double(uint8_t *to, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    byte_order_put_u64(to, bits);
}

static inline double byte_order_get_double(const uint8_t *from)
{
    uint64_t bits = byte_order_get_u64(from);
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

#ifdef __cplusplus
}
#endif
#endif
