/* SPDX-License-Identifier: Apache-2.0 */
#include "view/page.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstring>

namespace {

enum : size_t { VERTICES, TRIANGLES, LINES };
constexpr std::array<size_t, PAGE_KINDS> unit_bytes = {PACKED_VERTEX_BYTES, PACKED_TRIANGLE_BYTES, PACKED_LINE_BYTES};
static_assert(BERTH_UNITS * int{PACKED_UNIT_VERTICES} == 1 << 16);
static_assert(sizeof(GLint[4]) * BERTH_UNITS == PAGE_TABLE_BYTES);

/* --- making and ending --- */

GLuint make_buffer(size_t bytes)
{
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(GL_COPY_WRITE_BUFFER, name);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
    return name;
}

const void *at_byte(size_t byte) { return reinterpret_cast<const void *>(byte); }

GLuint make_array(GLuint vertices, GLuint indices)
{
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    glBindVertexArray(name);
    glBindBuffer(GL_ARRAY_BUFFER, vertices);
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 4, GL_UNSIGNED_SHORT, sizeof(packed_vertex), at_byte(offsetof(packed_vertex, place)));
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 2, GL_SHORT, GL_TRUE, sizeof(packed_vertex), at_byte(offsetof(packed_vertex, normal)));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(packed_vertex),
                          at_byte(offsetof(packed_vertex, rgba)));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    return name;
}

GLuint make_texture()
{
    GLuint name = 0;
    glGenTextures(1, &name);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, name);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32I, BERTH_UNITS, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return name;
}

/* --- what differs --- */

/* Eight bytes at a time: whatever is asked for is a multiple of that. */
uint64_t hash_of(const unsigned char *bytes, size_t n)
{
    uint64_t h = 0x9E3779B97F4A7C15u ^ n;
    for (size_t at = 0; at < n; at += sizeof(uint64_t)) {
        uint64_t word;
        std::memcpy(&word, bytes + at, sizeof word);
        h = std::rotl((h ^ word) * 0xD6E8FEB86659FD93u, 29) * 0xA0761D6478BD642Fu;
        h ^= h >> 32;
    }
    return h ? h : 1;
}

struct bytes_of_kind {
    const unsigned char *from;
    size_t count;
};

std::array<bytes_of_kind, PAGE_KINDS> kinds_of(const packed &p)
{
    auto as_bytes = [](const void *from) { return static_cast<const unsigned char *>(from); };
    return {{{as_bytes(p.vertices.data()), p.vertices.size() * sizeof(packed_vertex)},
             {as_bytes(p.triangles.data()), p.triangles.size() * sizeof(uint16_t)},
             {as_bytes(p.lines.data()), p.lines.size() * sizeof(uint16_t)}}};
}

/* Unsynchronised: the caller knows that the device reads nothing that matters there. */
bool send(GLuint buffer, size_t at, const void *from, size_t bytes)
{
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
    void *to = glMapBufferRange(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes),
                                GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_RANGE_BIT | GL_MAP_UNSYNCHRONIZED_BIT);
    if (!to)
        return false;
    std::memcpy(to, from, bytes);
    return glUnmapBuffer(GL_COPY_WRITE_BUFFER) == GL_TRUE;
}

bool send_units(page *p, size_t kind, const bytes_of_kind &b, size_t first, const std::vector<uint64_t> &hashes)
{
    for (size_t n = 0, end; n < hashes.size(); n = end) {
        for (end = n; end < hashes.size() && hashes[end] != p->unit[first + end].hash[kind]; end++)
            p->unit[first + end].hash[kind] = hashes[end];
        const size_t from = n * unit_bytes[kind], to = std::min(end * unit_bytes[kind], b.count);
        if (end > n && !send(p->buffers[kind], first * unit_bytes[kind] + from, b.from + from, to - from))
            return false;
        end += end == n;
    }
    return true;
}

/* Triangles (and lines) of one vertex each. The vertex is the unit's own: a device that reads old and new indices mixed
   still draws nothing. */
bool clean(page *p, int from, int to)
{
    std::array<uint16_t, 3 * PACKED_UNIT_TRIANGLES> nothing;
    static_assert(sizeof nothing >= PACKED_LINE_BYTES);
    for (int n = from; n < to; n++) {
        page_unit &u = p->unit[static_cast<size_t>(n)];
        nothing.fill(static_cast<uint16_t>(n * PACKED_UNIT_VERTICES));
        for (size_t kind : {TRIANGLES, LINES}) {
            if (p->buffers[kind] == 0)
                continue;
            if (!send(p->buffers[kind], static_cast<size_t>(n) * unit_bytes[kind], nothing.data(), unit_bytes[kind]))
                return false;
            u.hash[kind] = 0;
        }
        u.left_by = PAGE_NOBODY;
    }
    return true;
}

/* --- tables --- */

/* The one with the least to write; as many as there are when all are in use. */
size_t free_table(const page &p, uint64_t done)
{
    size_t best = p.tables.size();
    for (size_t n = 0; n < p.tables.size(); n++)
        if (p.tables[n].used <= done &&
            (best == p.tables.size() || p.tables[n].pending.size() < p.tables[best].pending.size()))
            best = n;
    return best;
}

void note(page *p, int unit)
{
    constexpr size_t whole = PAGE_TABLE_BYTES / PAGE_TEXEL_BYTES;
    for (page_table &t : p->tables)
        if (t.pending.size() <= whole) /* one more than that: all of it is to be written */
            t.pending.push_back(static_cast<uint16_t>(unit));
}

size_t pending_bytes(const page_table &t) { return std::min(t.pending.size() * PAGE_TEXEL_BYTES, PAGE_TABLE_BYTES); }

size_t send_texels(const page &p, size_t from, size_t to)
{
    std::vector<GLint> texels;
    for (size_t n = from; n < to; n++)
        texels.insert(texels.end(), {p.shown[n].i, p.shown[n].j, p.shown[n].k, 0});
    glTexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(from), 0, static_cast<GLsizei>(to - from), 1, GL_RGBA_INTEGER,
                    GL_INT, texels.data());
    return texels.size() * sizeof(GLint);
}

size_t write_table(const page &p, page_table *t)
{
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, t->texture);
    size_t bytes = 0;
    std::vector<uint16_t> &list = t->pending;
    std::sort(list.begin(), list.end());
    if (pending_bytes(*t) >= PAGE_TABLE_BYTES) {
        bytes = send_texels(p, 0, BERTH_UNITS);
    } else {
        for (size_t n = 0, end; n < list.size(); n = end) {
            for (end = n + 1; end < list.size() && list[end] - list[end - 1] <= PAGE_TEXELS_NEAR;)
                end++;
            bytes += send_texels(p, list[n], size_t{list[end - 1]} + 1);
        }
    }
    list.clear();
    return bytes;
}

void say(page *p, int first, key at)
{
    key &now = p->shown[static_cast<size_t>(first)];
    if (key_equal(now, at))
        return;
    now = at;
    note(p, first);
}

} // namespace

bool page_open(page *p, bool with_lines, std::string *trouble_out)
{
    while (glGetError() != GL_NO_ERROR) {
    }
    *p = page{};
    p->unit.resize(BERTH_UNITS);
    p->shown.assign(BERTH_UNITS, PAGE_NOWHERE);
    for (size_t kind = 0; kind < (with_lines ? PAGE_KINDS : size_t{LINES}); kind++)
        p->buffers[kind] = make_buffer(BERTH_UNITS * unit_bytes[kind]);
    p->array = make_array(p->buffers[VERTICES], p->buffers[TRIANGLES]);
    if (with_lines)
        p->line_array = make_array(p->buffers[VERTICES], p->buffers[LINES]);
    if (glGetError() == GL_NO_ERROR)
        return true;
    page_close(p);
    *trouble_out = "the device has no memory for more surface";
    return false;
}

void page_close(page *p)
{
    glDeleteVertexArrays(1, &p->array);
    glDeleteVertexArrays(1, &p->line_array);
    glDeleteBuffers(PAGE_KINDS, p->buffers.data());
    for (const page_table &t : p->tables)
        glDeleteTextures(1, &t.texture);
    *p = page{};
}

void page_plan(const page &p, const packed &from, int first, int units, page_change *out)
{
    out->bytes = 0;
    const std::array<bytes_of_kind, PAGE_KINDS> kinds = kinds_of(from);
    for (size_t kind = 0; kind < PAGE_KINDS; kind++) {
        out->hashes[kind].clear();
        for (size_t at = 0, n = 0; at < kinds[kind].count; at += unit_bytes[kind], n++) {
            const size_t bytes = std::min(unit_bytes[kind], kinds[kind].count - at);
            out->hashes[kind].push_back(hash_of(kinds[kind].from + at, bytes));
            if (out->hashes[kind].back() != p.unit[static_cast<size_t>(first) + n].hash[kind])
                out->bytes += bytes;
        }
    }
    auto left_by = [&p](int n) { return p.unit[static_cast<size_t>(n)].left_by; };
    out->clean_from = first;
    out->clean_to = first + units;
    const uint16_t low = left_by(first), high = left_by(first + units - 1);
    while (low != PAGE_NOBODY && out->clean_from > 0 && left_by(out->clean_from - 1) == low)
        out->clean_from--;
    while (high != PAGE_NOBODY && out->clean_to < BERTH_UNITS && left_by(out->clean_to) == high)
        out->clean_to++;
    const size_t each = PACKED_TRIANGLE_BYTES + (p.buffers[LINES] ? PACKED_LINE_BYTES : 0);
    out->bytes += static_cast<size_t>(out->clean_to - out->clean_from - units) * each;
}

bool page_write(page *p, const packed &from, int first, int units, const page_change &plan)
{
    if (!clean(p, plan.clean_from, first) || !clean(p, first + units, plan.clean_to))
        return false;
    for (int n = first; n < first + units; n++)
        p->unit[static_cast<size_t>(n)].left_by = PAGE_NOBODY;
    const std::array<bytes_of_kind, PAGE_KINDS> kinds = kinds_of(from);
    for (size_t kind = 0; kind < PAGE_KINDS; kind++)
        if (!send_units(p, kind, kinds[kind], static_cast<size_t>(first), plan.hashes[kind]))
            return false;
    return true;
}

void page_leave(page *p, int first, int units)
{
    berth_give(&p->units, first, units);
    for (int n = first; n < first + units; n++)
        p->unit[static_cast<size_t>(n)].left_by = static_cast<uint16_t>(first);
}

void page_return(page *p, int first, int units)
{
    const bool free = berth_take_at(&p->units, first, units);
    assert(free);
    (void)free;
    for (int n = first; n < first + units; n++)
        p->unit[static_cast<size_t>(n)].left_by = PAGE_NOBODY;
}

size_t page_backlog(const page &p, uint64_t done)
{
    if (p.next_table >= 0)
        return 0;
    const size_t free = free_table(p, done);
    return free == p.tables.size() ? PAGE_TABLE_BYTES : pending_bytes(p.tables[free]);
}

void page_begin(page *p, uint64_t done)
{
    if (p->next_table >= 0)
        return;
    const size_t free = free_table(*p, done);
    if (free == p->tables.size()) {
        page_table fresh;
        fresh.texture = make_texture();
        fresh.pending.assign(PAGE_TABLE_BYTES / PAGE_TEXEL_BYTES, 0); /* that many: all of it */
        p->tables.push_back(fresh);
    }
    p->next_table = static_cast<int>(free);
}

void page_show(page *p, int first, key at) { say(p, first, at); }

void page_hide(page *p, int first) { say(p, first, PAGE_NOWHERE); }

size_t page_end(page *p, uint64_t this_frame)
{
    size_t bytes = 0;
    if (p->next_table >= 0) {
        p->table = p->next_table;
        p->next_table = -1;
        bytes = write_table(*p, &p->tables[static_cast<size_t>(p->table)]);
        p->drawn = p->units.top;
    }
    p->drawn = std::min(p->drawn, p->units.top);
    if (p->drawn > 0)
        p->tables[static_cast<size_t>(p->table)].used = this_frame;
    return bytes;
}

void page_blank(page *p) { p->drawn = 0; }

void page_draw(const page &p, GLenum kind)
{
    if (p.drawn == 0)
        return;
    const int each = kind == GL_LINES ? 2 * PACKED_UNIT_LINES : 3 * PACKED_UNIT_TRIANGLES;
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, p.tables[static_cast<size_t>(p.table)].texture);
    glBindVertexArray(kind == GL_LINES ? p.line_array : p.array);
    glDrawElements(kind, p.drawn * each, GL_UNSIGNED_SHORT, nullptr);
}

