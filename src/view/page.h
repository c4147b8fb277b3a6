/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A page of the device's memory with many patches in it, drawn by one call. It is written while the device
 *          still draws what it was: nothing waits.
 * Is not:  Which patch lies where, and when a range is free again (upload.h); the bytes of a patch (packed.h).
 * Shape:   units as berth.h counts them, 65,536 vertices: what 16 bits can name.
 *
 *              vertices    1 MiB     triangles  768 KiB     lines, where wanted  768 KiB
 *              table       2,048 x 1 texels: at the first unit of a range that is shown, its patch's brick key;
 *                          anywhere else PAGE_NOWHERE, so far out that all vertices fall on one point: nothing is
 *                          drawn
 *
 *          A range is written by unsynchronised maps, which is safe while no table that the device may still read
 *          shows it. Then one texel hides a patch's old range and another shows the new one: vertices and triangles
 *          change together or not at all. There are as many tables as frames under way: of those that the device has
 *          done with, one is brought up to date and drawn with from now on.
 *
 *          A range that was left keeps its triangles; they are harmless, as its vertices name a unit that is hidden.
 *          They must go when a part of it is taken for another patch: what then remains of it beside that patch is
 *          filled with triangles of one vertex.
 *
 *          What was written last is known by a hash of 64 bits per unit and kind: a unit that has the same bytes is
 *          not sent again. Hashes take 24 bytes a unit where a copy would take 1,280.
 * Units:   lattice steps; frames as the caller counts them.
 * Owner:   the caller owns the struct; page_close frees the device's memory. The context must be current throughout.
 * Errors:  page_open false: no memory on the device, the page is closed. page_write false: the device took a map away
 *          or gave none; the page's bytes are then unknown and it must be closed.
 * Cost:    draw: one call, whatever is shown or left. write: a map for each run of units that differ.
 * Source:  we differ from a ring of staging buffers that is copied from: V3D's driver (Mesa 24) does such a copy on the
 *          processor and waits for the device first, likewise glBufferSubData and any map that is not unsynchronised.
 */
#ifndef GLAISE_VIEW_PAGE_H
#define GLAISE_VIEW_PAGE_H

#include "view/berth.h"
#include "view/packed.h"

#include <GLES3/gl31.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/* 2^30 less the 2^28 that a middle may be away, times 8 steps: floats there are 512 steps apart or more. */
constexpr key PAGE_NOWHERE = {-(1 << 30), -(1 << 30), -(1 << 30)};
constexpr size_t PAGE_TABLE_BYTES = size_t{BERTH_UNITS} * 16;
/* Of a table, for one texel that changed: those between two that lie near are sent with them, which costs less than
   another call. */
constexpr int PAGE_TEXELS_NEAR = 8;
constexpr size_t PAGE_TEXEL_BYTES = size_t{PAGE_TEXELS_NEAR} * 16;
constexpr uint16_t PAGE_NOBODY = std::numeric_limits<uint16_t>::max();
constexpr size_t PAGE_KINDS = 3; /* vertices, triangles, lines */

struct page_table {
    GLuint texture = 0;
    uint64_t used = 0;             /* the last frame that it was drawn in */
    std::vector<uint16_t> pending; /* texels that changed since it was written */
};

struct page_unit {
    std::array<uint64_t, PAGE_KINDS> hash{}; /* of what was written last; 0: not known */
    uint16_t left_by = PAGE_NOBODY;          /* first unit of the left range whose triangles still lie here */
};

/* What writing a patch into a range amounts to. */
struct page_change {
    std::array<std::vector<uint64_t>, PAGE_KINDS> hashes;
    int clean_from = 0, clean_to = 0; /* the range and what remains beside it of ranges that it cuts */
    size_t bytes = 0;                 /* that page_write will send */
};

struct page {
    GLuint array = 0, line_array = 0;
    std::array<GLuint, PAGE_KINDS> buffers{};
    berth units;
    std::vector<page_unit> unit; /* BERTH_UNITS */
    std::vector<key> shown;      /* likewise: what the table says */
    std::vector<page_table> tables;
    int table = -1;     /* drawn with; -1: none yet */
    int next_table = -1; /* between page_begin and page_end: being brought up to date */
    int drawn = 0;      /* units that are drawn: those below */
};

[[nodiscard]] bool page_open(page *p, bool with_lines, std::string *trouble_out);
void page_close(page *p);

/* A range that was taken in p->units and not yet shown. */
void page_plan(const page &p, const packed &from, int first, int units, page_change *out);
[[nodiscard]] bool page_write(page *p, const packed &from, int first, int units, const page_change &plan);
/* When no frame under way can show the range any more: gives it back. */
void page_leave(page *p, int first, int units);
/* Takes the leaving back, when nothing was written there since. */
void page_return(page *p, int first, int units);

/* Finds a table that frames after `done` do not use. Answers the bytes that page_end will at most send for what
   changed before; page_show and page_hide add PAGE_TEXEL_BYTES each. */
size_t page_backlog(const page &p, uint64_t done);
void page_begin(page *p, uint64_t done);
/* Only between page_begin and page_end does a change become visible. */
void page_show(page *p, int first, key at);
void page_hide(page *p, int first);
/* Bytes sent. From here on the page is drawn as it was shown and hidden. Without a begin nothing changes. */
size_t page_end(page *p, uint64_t this_frame);
/* Draws nothing until the next page_begin and page_end. */
void page_blank(page *p);

/* As upload_draw_*. */
void page_draw(const page &p, GLenum kind);

#endif
