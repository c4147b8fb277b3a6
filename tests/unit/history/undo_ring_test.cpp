/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: a stroke's name is that of its place in the ring, and a look at the place tells its state.
 * Method: a memory store with each state put there by hand. */
#include "history/undo_ring.h"

#include "clay/digest.h"
#include "history/byte_order.h"
#include "tests/unit/history/memory_store.h"
#include "tests/unit/history/piece.h"

#include <gtest/gtest.h>

namespace {

std::string name_of(uint32_t ring, uint64_t stroke) { return undo_ring_name_of(ring, stroke).text; }

TEST(undo_ring, names_go_round)
{
    EXPECT_EQ(name_of(200, 1), "undo-0001");
    EXPECT_EQ(name_of(200, 200), "undo-0000");
    EXPECT_EQ(name_of(200, 401), "undo-0001");
    EXPECT_EQ(name_of(9999, 9998), "undo-9998");
    EXPECT_EQ(name_of(1, 12345), "undo-0000");
}

std::vector<uint8_t> stroke_bytes(uint64_t number)
{
    piece_clay p;
    byte_buffer b = {};
    undo_file_facts f = {.stroke = number, .digest_before = 0, .digest_after = 5, .dab = 0, .ring = 10, .bricks = 0,
                         .corners = 0, .bytes = 0};
    clay_change_begin(&p.c);
    EXPECT_EQ(piece_write(&p.c, piece_stroke_numbered(1)), STATUS_OK);
    EXPECT_EQ(undo_file_encode(&p.c, &f, &b), STATUS_OK);
    std::vector<uint8_t> bytes(b.bytes, b.bytes + b.size);
    byte_buffer_finish(&b);
    return bytes;
}

TEST(undo_ring, looking_tells_the_state)
{
    memory_store m;
    const byte_store store = m.port();
    undo_ring_slot slot;
    ASSERT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_OK);
    EXPECT_EQ(slot.state, UNDO_RING_ABSENT);

    const std::vector<uint8_t> good = stroke_bytes(13);
    m.files["undo-0003"] = good;
    ASSERT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_OK);
    EXPECT_EQ(slot.state, UNDO_RING_GOOD);
    EXPECT_EQ(slot.facts.stroke, 13u);

    m.unreadable = "undo-0003";
    ASSERT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_OK);
    EXPECT_EQ(slot.state, UNDO_RING_UNREADABLE);
    m.unreadable.clear();

    m.files["undo-0003"].pop_back();
    ASSERT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_OK);
    EXPECT_EQ(slot.state, UNDO_RING_DAMAGED);
    EXPECT_EQ(slot.trouble.offset, good.size() - 1);

    m.files["undo-0003"] = good;
    m.files["undo-0003"][20] ^= 1;
    ASSERT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_OK);
    EXPECT_EQ(slot.state, UNDO_RING_DAMAGED);

    m.files["undo-0003"] = good;
    byte_order_put_u32(&m.files["undo-0003"][8], 2);
    byte_order_put_u64(&m.files["undo-0003"][80], digest_bytes(m.files["undo-0003"].data(), 80, 0));
    EXPECT_EQ(undo_ring_look(&slot, &store, 10, 13), STATUS_NEWER);
}

} // namespace
