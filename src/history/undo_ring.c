/* SPDX-License-Identifier: Apache-2.0 */
#include "history/undo_ring.h"

#include "history/sentence.h"
#include "history/whole_file.h"

undo_ring_name undo_ring_name_of(uint32_t ring, uint64_t stroke)
{
    undo_ring_name name;
    sentence text = sentence_begin(name.text, sizeof name.text);
    sentence_add(&text, "undo-");
    sentence_add_number(&text, stroke % ring, 4);
    return name;
}

status undo_ring_look(undo_ring_slot *slot_out, const byte_store *store, uint32_t ring, uint64_t stroke)
{
    *slot_out = (undo_ring_slot){.state = UNDO_RING_UNREADABLE};
    uint8_t header[PREAMBLE_HEADER_BYTES_MAX];
    size_t have = 0;
    uint64_t size = 0;
    bool exists = false;
    status s = whole_file_read_head(store, undo_ring_name_of(ring, stroke).text, header, sizeof header, &have, &size,
                                    &exists);
    if (s != STATUS_OK)
        return STATUS_OK;
    if (!exists) {
        slot_out->state = UNDO_RING_ABSENT;
        return STATUS_OK;
    }
    s = undo_file_read_facts(&slot_out->facts, header, have, &slot_out->trouble);
    if (s == STATUS_NEWER)
        return s;
    if (s == STATUS_OK && slot_out->facts.bytes != size) {
        slot_out->trouble = (preamble_trouble){size, "as many bytes as the header says"};
        s = STATUS_CORRUPT;
    }
    slot_out->state = s == STATUS_OK ? UNDO_RING_GOOD : UNDO_RING_DAMAGED;
    return STATUS_OK;
}
