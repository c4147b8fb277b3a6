/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A surface's patches on the graphics device, kept up to date by generation within a number of bytes a frame.
 *          Many patches share a page and are drawn by one call.
 * Is not:  The surface itself (surface.h); a page and how it is written without waiting (page.h); how patches are lit
 *          (clay_shader.h).
 * Shape:   a frame is one upload_update and the draws after it. A device that has done with all frames by the next
 *          update is idle: a patch that changed is then written where it lies, as far as it differs. Otherwise it is
 *          written to a range that no frame under way shows; the frame shows that range instead of the old one, which
 *          is given back when the fence behind the last frame that showed it has passed:
 *
 *              frame        1      2      3      4
 *              shown        A      B      A      B       a patch that changes in every frame goes to and fro
 *              written      A      B      A      B       between two ranges (three, on a device two frames behind)
 *
 *          It returns to the range it left last where it can: what is the same there is not sent again. A patch also
 *          moves when it outgrows its range or fills less than half.
 *          What is over the budget waits, and is drawn as it was last sent: whole, or not at all if it never was. What
 *          is gone goes first, then what has waited for UPLOAD_WAIT_FRAMES, longest first, then what changed last: a
 *          patch waits no longer than that and its turn among those who waited as long.
 * Units:   lattice steps; bytes as they go to the device.
 * Owner:   the caller owns the struct; upload_finish frees the device's memory. The context must be current throughout.
 * Errors:  upload_update false: no memory on the device, or UPLOAD_PAGES_MAX; what was sent stays, what was not will be
 *          tried again next time. Where the device took memory away nothing stays.
 * Cost:    update: nothing when nothing changed, else a look at every slot, and packing and sending the changed
 *          patches. It never waits for the device. draw: one call a page, whatever lies in it.
 *          Sent by unit, not by vertex or patch: of the demonstration's bytes (1 mm, written where they lie) 73 %
 *          differ by units of 32 vertices, 66 % by 8, 60 % by single ones, and 87 % go
 *          when a patch's vertices or triangles go whole. Two frames later it is 81 %: less to gain, so that a patch
 *          is not given three ranges to keep.
 */
#ifndef GLAISE_VIEW_UPLOAD_H
#define GLAISE_VIEW_UPLOAD_H

#include "view/page.h"

#include <deque>
#include <string>
#include <vector>

enum {
    /* 33 million vertices, 0.9 GiB: what a full sculpture's patches would take at 4 units each. */
    UPLOAD_PAGES_MAX = 512,
    UPLOAD_WAIT_FRAMES = 15, /* a quarter of a second at 60 Hz */
};
constexpr size_t UPLOAD_ALL = std::numeric_limits<size_t>::max(); /* a budget: nothing waits */
/* Any budget from here on is kept in every frame: the largest patch with lines and what it cuts off on either side, a
   table of the page that it leaves and one of that it enters. A smaller one is kept too, but for a frame in which not
   even one patch fits: that one goes alone. */
constexpr size_t UPLOAD_BUDGET_LEAST_BYTES =
    PACKED_UNITS_MAX * (PACKED_VERTEX_BYTES + 3 * (PACKED_TRIANGLE_BYTES + PACKED_LINE_BYTES)) +
    2 * (PAGE_TABLE_BYTES + PAGE_TEXEL_BYTES);

struct upload_range {
    uint32_t page = 0;
    int first = 0;
    int units = 0; /* 0: none */
};

struct upload_slot {
    uint64_t generation = 0; /* of what is shown */
    key at{};
    upload_range shown;
    upload_range before;  /* left last; may be anybody's by now */
    uint64_t waiting = 0; /* frame since which the patch is another than what is shown; 0: it is not */
};

struct upload_gone {
    key at{};
    uint64_t generation = 0;
    upload_range shown; /* still: what is gone waits too */
};

struct upload_left {
    uint64_t frame; /* the last that showed it */
    upload_range range;
};

struct upload_fence {
    uint64_t frame; /* passed: the device has done with it */
    GLsync sync;
};

struct upload_counts {
    uint64_t bytes = 0;   /* sent to the device since upload_init */
    uint64_t patches = 0; /* sent, likewise */
    uint32_t held = 0;    /* patches shown now */
    uint32_t waiting = 0; /* patches that are shown as they were, or not yet, or still */
};

struct upload {
    bool with_lines = false;
    std::vector<page> pages;
    std::vector<upload_slot> slots; /* as the surface's */
    std::vector<upload_gone> gone;  /* of no slot any more, by brick */
    std::deque<upload_left> left;   /* by frame */
    std::deque<upload_fence> fences;
    uint64_t frame = 0;       /* the one that began with the last update */
    uint64_t done = 0;        /* the device has done with all frames up to this one */
    uint64_t newest = 0;      /* generation of the surface last looked at */
    uint64_t triangles = 0;   /* and how many it had */
    box bricks = box_empty(); /* of the patches held */
    upload_counts counts;
    packed scratch;
    page_change change; /* likewise scratch */
};

/* Makes nothing on the device yet. with_lines: each side of each triangle can be drawn once. */
void upload_init(upload *u, bool with_lines);
void upload_finish(upload *u);
/* Nothing held any more; the memory stays. For when another surface is to be shown. */
void upload_clear(upload *u);

/* Begins a frame, ends the one before. Sends budget_bytes at most; counts.waiting says whether anything is left. */
[[nodiscard]] bool upload_update(upload *u, const surface *s, size_t budget_bytes, std::string *trouble_out);

/* The program in use must be built on patch_shader.h. Texture unit 0 holds u_bricks. */
void upload_draw_triangles(const upload &u);
void upload_draw_lines(const upload &u);
/* After the draws of a picture: a fence stands here. Without it the next update puts one, which passes later. */
void upload_drawn(upload *u);

#endif
