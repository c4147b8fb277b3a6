/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A sculpture's life on a byte store: every stroke as an undo-file in a ring, every step back and forth, and
 *          now and then the whole field beneath them, so that the piece and its history come back after a power cut.
 * Is not:  The byte store (byte_store.h); threads (whoever owns the struct calls it from one thread at a time; keeper.h
 *          says how the sculpture's thread and that one meet); what opening makes of what it finds (recovery.h).
 * Shape:   what a stroke changed goes through four states:
 *
 *              made ----------> put ----------> kept ----------> beneath
 *              in the clay,     a record in     on the medium,   in both checkpoints: its undo-file may be
 *              a delta of it    memory          acknowledged     written anew, oldest first
 *                     history_put    history_keep    history_work
 *
 *          files: undo-0000 ... (ring.h, record.h); "field", the newest checkpoint, and "field.before", the one before
 *          it (checkpoint.h), made as "field.new" and renamed; "reserve", space that is held (reserve.h).
 *
 *          H1  What history_keep has answered STATUS_OK for survives a power cut at any instant, whatever the medium
 *              did with later writes. (history_keep: written, then synced, then counted. tests/crash/crash_test.cpp)
 *          H2  After a cut the clay is in a state that existed: the last kept one, or one put after it; a stroke under
 *              way is there up to its last stretch that is, as one undo step. (recovery_run. crash_test,
 *              truncation_test)
 *          H3  From each of the two checkpoints all records lead to where the clay stands: no undo-file on that way is
 *              written anew. (history_keep.c: may_go. crash_test: small_rings)
 *          H4  A record begins on blocks of its own, and its file is as long as it will ever be: no write of a new
 *              record touches an old one. (ring_write, ring_make. tests/unit/history/ring_test.cpp)
 *          H5  A file whose writing or sync failed gets no further record; what was meant for it is still in memory and
 *              goes to another. (history_keep. history_keep_test; fault_test)
 *          H6  Nothing that cannot be read is removed: it is renamed to "<name>.set-aside". (recovery_run,
 *              history_fetch. recovery_damage_test)
 *          H7  When the medium fills up, undo reaches less far; then history_room refuses new strokes. What was put
 *              stays put, and when there is room again sculpting goes on. (history_keep.c: file_take, field_put,
 *              reserve_work. full_test, fault_test: fill levels; medium_test: real mounts)
 *          What a medium does that is full:
 *
 *              roomy     an undo-file is made when it is needed. The reserve holds what two checkpoints and some
 *                |       undo-files need, since strokes may be forgotten only when they are beneath both
 *                | no space for an undo-file
 *                v
 *              tight     the oldest stroke beneath both is forgotten, and its file taken
 *                |
 *                | none is beneath both
 *                v
 *              spent     the undo-file comes out of the reserve, and two checkpoints are owed. They are written, out
 *                |  \     of the reserve too and then of what forgetting gives; the older one's place is free when the
 *                |   \    first stands. New strokes begin as long as some undo-files are left in the reserve
 *                |    '-> both stand: all is beneath them. tight; the reserve is made whole again, out of forgotten
 *                |        strokes' files if need be, as long as undo has more than it
 *                | nothing left in it
 *                v
 *              full      records are held in memory, no stroke begins. history_keep tries again when it is called;
 *                        once they are kept: spent, with what is owed
 *
 *          A checkpoint that finds no space although all was given is given up, its beginning removed. It is tried
 *          again when it is due by strokes made since, when a full medium has room again, or when the reserve, which
 *          now has to hold what was missing as well, could be made whole. Nothing else starts it: `field_short`.
 *          The hardware must keep what it said it flushed. Where it lies, H1 holds up to the first thing it lost, and
 *          recovery says that acknowledged strokes are missing.
 * Owner:   the caller owns the struct and the store; history owns its memory.
 * Errors:  STATUS_HISTORY_ENDS; STATUS_IO, STATUS_NO_SPACE, STATUS_CORRUPT, STATUS_NEWER, STATUS_POOL_FULL,
 *          STATUS_NO_MEMORY. `trouble` is a sentence for the person where there is more to say.
 * Cost:    history_put: the changed bricks compared, hashed, packed (2 us each). history_keep: a write and a sync for
 *          all that was put. A checkpoint: the whole field, in slices of HISTORY_SLICE_BYTES.
 * Source:  000 section 3.3; 002 section 2.3; facts/devices.md G.
 */
#ifndef GLAISE_HISTORY_HISTORY_H
#define GLAISE_HISTORY_HISTORY_H

#include "clay/delta.h"
#include "history/checkpoint.h"
#include "history/reserve.h"
#include "history/ring.h"
#include "history/route.h"
#include "history/tree.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HISTORY_STROKES_DEFAULT = 200, HISTORY_STROKES_MAX = 9999, HISTORY_SLICE_BYTES = 1024 * 1024 };

#define HISTORY_FILE_BYTES_DEFAULT (UINT64_C(1) << 20)
#define HISTORY_BUDGET_BYTES_DEFAULT (UINT64_C(1) << 30)
/* What is put and cannot be written stays in memory up to here; then new strokes are refused. */
#define HISTORY_HELD_BYTES_DEFAULT (UINT64_C(1) << 28)

/* Undo-files in the reserve, for what is made until there are two new checkpoints. */
#define HISTORY_RESERVE_FILES_DEFAULT 4

#define HISTORY_FIELD_NAME "field"
#define HISTORY_FIELD_BEFORE_NAME "field.before"

typedef struct history_settings {
    uint32_t strokes;      /* that can be undone; more until a checkpoint is there; 1 .. HISTORY_STROKES_MAX */
    uint64_t file_bytes;   /* of an undo-file; a multiple of 4 KiB, RING_FILE_BYTES_MIN at the least */
    uint64_t budget_bytes; /* of all undo-files; more only where no checkpoint could be made in time */
    uint64_t held_bytes;
    uint32_t reserve_files; /* 0: no reserve at all */
} history_settings;

#define HISTORY_SETTINGS_DEFAULT                                                                                       \
    {HISTORY_STROKES_DEFAULT, HISTORY_FILE_BYTES_DEFAULT, HISTORY_BUDGET_BYTES_DEFAULT, HISTORY_HELD_BYTES_DEFAULT,    \
     HISTORY_RESERVE_FILES_DEFAULT}

/* What there is to say to the person: one sentence, "" when all is as it should be. */
typedef struct history_finding {
    char text[200];
} history_finding;

/* A record that is not kept yet. */
typedef struct history_held {
    struct history_held *next;
    record r;
    uint8_t *bytes; /* header, and what follows it on the medium: they lie right behind */
} history_held;

/* A checkpoint on the medium. */
typedef struct history_base {
    bool there;
    uint64_t sequence, cursor;
} history_base;

typedef enum history_medium {
    HISTORY_MEDIUM_GOOD,
    HISTORY_MEDIUM_FULL,
    HISTORY_MEDIUM_FAILS, /* or may only be read */
} history_medium;

typedef struct history {
    byte_store store;
    history_settings settings;
    struct ring ring;
    struct tree tree;
    history_base field, before;
    uint64_t sequence, kept; /* the last record that was put; that is kept */
    uint64_t seal;           /* of the kept one */
    uint64_t kept_cursor, kept_digest; /* of the last whole one that is kept */
    uint64_t stroke;         /* newest number given */
    bool in_stroke;          /* what is put next is part of that stroke */
    uint32_t part;           /* number of its next part */
    uint64_t digest;         /* clay_digest after the last record that was put */
    uint64_t dab;            /* number of the next dab, as last put */
    double step_mm;
    packing *packs;
    history_held *held_first, *held_last;
    uint64_t held_bytes;
    history_medium medium;
    bool wants_field;        /* a checkpoint is due: give one to history_field_begin, between strokes */
    uint64_t put_since, strokes_since; /* bytes, strokes: since the last checkpoint was begun */
    checkpoint_writer *writer; /* NULL: none is being written */
    uint64_t written, unsynced; /* bytes of it */
    checkpoint_facts writing;
    struct reserve reserve;
    uint64_t reserve_aim;    /* bytes that it is growing to; 0: it is not */
    bool reserve_tried;      /* in vain: not again before something has changed */
    uint64_t field_bytes, before_bytes; /* of the two checkpoints */
    uint64_t field_missed;   /* so many bytes of one were written when the medium was full; 0: it was not */
    uint32_t fields_owed;    /* to be written one after the other, since the medium is full */
    bool field_short;        /* the last one found no space */
    bool spent;              /* the reserve has few undo-files left, and a checkpoint is on its way */
    history_finding trouble;   /* what went wrong last; the caller may empty it */
} history;

/* Opens or makes the store; c (initialised, empty) becomes the sculpture, all of it dirty. step_mm is for a new store;
   an old one keeps its own. Whatever the files hold, but for STATUS_NEWER, it opens (recovery.h). After anything but
   STATUS_OK c is empty and there is nothing to close. */
STATUS_CHECKED status history_open(history *h, byte_store store, const history_settings *settings, double step_mm,
                                   clay *c, history_finding *finding_out);
/* Keeps nothing: what is put and not kept is gone. */
void history_close(history *h);

/* --- strokes --- */

/* STATUS_OK when a stroke may begin; else why not. */
STATUS_CHECKED status history_room(const history *h);
/* What the stroke under way changed since it was last put (sorted: delta_sort; nothing: no record); `ends`: it is the
   last of it. dab is the number of the next dab. STATUS_NO_MEMORY: nothing is put. */
STATUS_CHECKED status history_put(history *h, const delta *d, uint64_t dab, bool ends, lanes rows);
/* Writes and syncs all that was put. On failure it stays in memory and is tried again with the next call. */
STATUS_CHECKED status history_keep(history *h);

/* --- back and forth --- */

typedef enum history_way {
    HISTORY_BACK,  /* undo */
    HISTORY_FORTH, /* redo */
    HISTORY_FORK,  /* to the end of the branch that is next older; from the oldest to the newest */
    HISTORY_TO,    /* to a stroke */
} history_way;

/* Reads the way from where the clay stands; route_out is empty and becomes the caller's. STATUS_HISTORY_ENDS: there is
   none. STATUS_CORRUPT: a stroke on it cannot be gone over; its files are set aside, and it is no more.
   Nothing moves. */
STATUS_CHECKED status history_fetch(history *h, history_way way, uint64_t stroke, route *route_out);
/* The clay went that way (route_apply). */
STATUS_CHECKED status history_move(history *h, const route *gone);
/* The clay could not go that way, because the route is not what it should be: its first stroke is no more. */
void history_refuse(history *h, const route *refused);

static inline bool history_can_undo(const history *h) { return tree_undo(&h->tree) != h->tree.cursor; }
static inline bool history_can_redo(const history *h) { return tree_redo(&h->tree) != h->tree.cursor; }

/* --- checkpoints, and what else can wait --- */

/* Begins writing a checkpoint of c, which is the clay as of all that was put, between strokes, and does not change
   until history_work has answered false. Nothing is being written. */
STATUS_CHECKED status history_field_begin(history *h, const clay *c);
/* One slice of what is to be done beside strokes: of a checkpoint, of an undo-file made ahead. Answers whether there is
   more. What fails is told in `trouble` and given up until it is due again. */
bool history_work(history *h);

#ifdef __cplusplus
}
#endif
#endif
