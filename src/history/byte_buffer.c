/* SPDX-License-Identifier: Apache-2.0 */
#include "history/byte_buffer.h"

#include <stdlib.h>

enum { ROOM_FIRST_BYTES = 65536 };

status byte_buffer_reserve(byte_buffer *b, size_t room)
{
    if (room <= b->room)
        return STATUS_OK;
    if (room > PTRDIFF_MAX) /* no object is larger */
        return STATUS_NO_MEMORY;
    size_t grown = b->room < ROOM_FIRST_BYTES ? ROOM_FIRST_BYTES : b->room;
    while (grown < room)
        grown = grown > PTRDIFF_MAX / 2 ? room : grown * 2;
    uint8_t *bytes = (uint8_t *)realloc(b->bytes, grown);
    if (!bytes)
        return STATUS_NO_MEMORY;
    b->bytes = bytes;
    b->room = grown;
    return STATUS_OK;
}

void byte_buffer_finish(byte_buffer *b)
{
    free(b->bytes);
    *b = (byte_buffer){NULL, 0, 0};
}
