/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The undo-files on the store: which name a stroke has, what stands in each place of the ring.
 * Is not:  The bytes of an undo-file (undo_file.h); where history stands in it (history.h).
 * Shape:   stroke n of a ring of r files is "undo-" and n mod r in four digits: its slot.
 * Errors:  STATUS_NEWER when a file is of a later version. Damage, absence and a file the store cannot read are states
 *          of a slot.
 * Cost:    looking at a slot reads its header.
 */
#ifndef GLAISE_HISTORY_UNDO_RING_H
#define GLAISE_HISTORY_UNDO_RING_H

#include "history/byte_store.h"
#include "history/undo_file.h"

#ifdef __cplusplus
extern "C" {
#endif

#define UNDO_RING_TEMPORARY "undo.new"

enum { UNDO_RING_NAME_BYTES = 10 };

typedef struct undo_ring_name {
    char text[UNDO_RING_NAME_BYTES];
} undo_ring_name;

undo_ring_name undo_ring_name_of(uint32_t ring, uint64_t stroke);

typedef enum undo_ring_state {
    UNDO_RING_ABSENT,
    UNDO_RING_GOOD,       /* its header is sound, and it is as long as that says */
    UNDO_RING_DAMAGED,    /* see trouble */
    UNDO_RING_UNREADABLE, /* the store fails on it */
} undo_ring_state;

typedef struct undo_ring_slot {
    undo_ring_state state;
    undo_file_facts facts;    /* when good */
    preamble_trouble trouble; /* when damaged */
} undo_ring_slot;

/* A good slot may still be of another ring, or a stroke of another place: facts tell. */
STATUS_CHECKED status undo_ring_look(undo_ring_slot *slot_out, const byte_store *store, uint32_t ring, uint64_t stroke);

#ifdef __cplusplus
}
#endif
#endif
