/* SPDX-License-Identifier: Apache-2.0 */
#include "view/upload.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>
#include <cstddef>

namespace {

constexpr float place_per_step = 4096;
constexpr size_t unit_vertex_bytes = sizeof(upload_vertex) * UPLOAD_UNIT_VERTICES;
constexpr size_t unit_triangle_bytes = sizeof(uint16_t) * 3 * UPLOAD_UNIT_TRIANGLES;
constexpr size_t unit_line_bytes = sizeof(uint16_t) * 2 * UPLOAD_UNIT_LINES;

/* --- units of a page --- */

bool is_taken(const upload_page &p, int unit) { return p.taken[static_cast<size_t>(unit / 64)] >> (unit % 64) & 1; }

void mark(upload_page *p, int first, int units, bool taken)
{
    for (int n = first; n < first + units; n++) {
        const uint64_t bit = uint64_t{1} << (n % 64);
        uint64_t &word = p->taken[static_cast<size_t>(n / 64)];
        assert(((word & bit) != 0) != taken);
        word ^= bit;
    }
    if (taken) {
        p->top = std::max(p->top, first + units);
        return;
    }
    p->longest = UPLOAD_UNITS;
    while (p->top > 0 && !is_taken(*p, p->top - 1))
        p->top--;
}

/* First run of free units that is long enough, -1 when there is none. */
int free_run(upload_page *p, int units)
{
    if (units > p->longest)
        return -1;
    for (int n = 0, run = 0; n < UPLOAD_UNITS; n++) {
        run = is_taken(*p, n) ? 0 : run + 1;
        if (run == units)
            return n + 1 - units;
    }
    p->longest = units - 1;
    return -1;
}

/* --- pages --- */

void send(upload *u, GLuint buffer, size_t at, size_t bytes, const void *from)
{
    glBindBuffer(GL_COPY_WRITE_BUFFER, buffer);
    glBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(bytes), from);
    u->counts.bytes += bytes;
}

GLuint make_buffer(size_t bytes, const void *from)
{
    GLuint name = 0;
    glGenBuffers(1, &name);
    glBindBuffer(GL_COPY_WRITE_BUFFER, name);
    glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(bytes), from, GL_DYNAMIC_DRAW);
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
    glVertexAttribIPointer(0, 4, GL_UNSIGNED_SHORT, sizeof(upload_vertex), at_byte(offsetof(upload_vertex, place)));
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 2, GL_SHORT, GL_TRUE, sizeof(upload_vertex), at_byte(offsetof(upload_vertex, normal)));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(upload_vertex),
                          at_byte(offsetof(upload_vertex, rgba)));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    return name;
}

void close_page(upload_page *p)
{
    glDeleteVertexArrays(1, &p->array);
    glDeleteVertexArrays(1, &p->line_array);
    const GLuint buffers[3] = {p->vertices, p->triangles, p->lines};
    glDeleteBuffers(3, buffers);
    glDeleteTextures(1, &p->bricks);
}

bool open_page(upload *u, std::string *trouble_out)
{
    if (u->pages.size() >= UPLOAD_PAGES_MAX) {
        *trouble_out = "the piece has more surface than can be shown: " + std::to_string(UPLOAD_PAGES_MAX) + " pages";
        return false;
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    const std::vector<uint16_t> nothing(UPLOAD_UNITS * size_t{3} * UPLOAD_UNIT_TRIANGLES, 0);
    upload_page p;
    p.vertices = make_buffer(UPLOAD_UNITS * unit_vertex_bytes, nullptr);
    p.triangles = make_buffer(UPLOAD_UNITS * unit_triangle_bytes, nothing.data());
    p.array = make_array(p.vertices, p.triangles);
    if (u->with_lines) {
        static_assert(unit_line_bytes <= unit_triangle_bytes);
        p.lines = make_buffer(UPLOAD_UNITS * unit_line_bytes, nothing.data());
        p.line_array = make_array(p.vertices, p.lines);
    }
    glGenTextures(1, &p.bricks);
    glBindTexture(GL_TEXTURE_2D, p.bricks);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32I, UPLOAD_UNITS, 1);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    if (glGetError() != GL_NO_ERROR) {
        close_page(&p);
        *trouble_out = "the device has no memory for more surface";
        return false;
    }
    u->pages.push_back(p);
    return true;
}

/* --- patches --- */

int16_t packed_signed(float x) { return static_cast<int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f)); }

void pack_normal(const float n[3], int16_t out[2])
{
    const float sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    if (!(sum > 0)) {
        out[0] = out[1] = 0;
        return;
    }
    float x = n[0] / sum, y = n[1] / sum;
    if (n[2] < 0) {
        const float folded = (1 - std::abs(y)) * (x >= 0 ? 1.0f : -1.0f);
        y = (1 - std::abs(x)) * (y >= 0 ? 1.0f : -1.0f);
        x = folded;
    }
    out[0] = packed_signed(x);
    out[1] = packed_signed(y);
}

void pack_vertices(upload *u, const patch &p, int unit)
{
    u->packed.resize(p.vertex_count);
    for (uint32_t n = 0; n < p.vertex_count; n++) {
        const patch_vertex &from = p.vertices[n];
        upload_vertex &to = u->packed[n];
        for (int c = 0; c < 3; c++)
            to.place[c] = static_cast<uint16_t>(
                std::lround(std::clamp(from.position[c], 0.0f, float{BRICK_EDGE}) * place_per_step));
        to.unit = static_cast<uint16_t>(unit);
        pack_normal(from.normal, to.normal);
        to.rgba = from.rgba;
    }
}

void pack_triangles(upload *u, const patch &p, int units, size_t base)
{
    u->indices.assign(static_cast<size_t>(units) * 3 * UPLOAD_UNIT_TRIANGLES, static_cast<uint16_t>(base));
    for (size_t t = 0; t < p.triangle_count; t++)
        for (size_t c = 0; c < 3; c++)
            u->indices[3 * t + c] = static_cast<uint16_t>(base + p.triangles[t][c]);
}

/* Where a vertex lies on the whole lattice: the same number in every patch that has it, so that of a side's two
   directions all patches choose the same one to draw. */
struct edge_name {
    int64_t i, j, k;
    int axis;
    auto operator<=>(const edge_name &) const = default;
};

edge_name name_of(const patch &p, uint16_t vertex)
{
    const uint32_t edge = p.vertices[vertex].edge;
    const int64_t corner = edge / 3;
    return {p.at.i * int64_t{BRICK_EDGE} + corner / (PATCH_SIDE * PATCH_SIDE),
            p.at.j * int64_t{BRICK_EDGE} + corner / PATCH_SIDE % PATCH_SIDE,
            p.at.k * int64_t{BRICK_EDGE} + corner % PATCH_SIDE, static_cast<int>(edge % 3)};
}

/* A closed surface has each side once in either direction; the rising one is drawn. */
void pack_lines(upload *u, const patch &p, int units, size_t base)
{
    u->indices.clear();
    for (size_t t = 0; t < p.triangle_count; t++) {
        for (size_t c = 0; c < 3; c++) {
            const uint16_t from = p.triangles[t][c], to = p.triangles[t][(c + 1) % 3];
            if (name_of(p, from) < name_of(p, to)) {
                u->indices.push_back(static_cast<uint16_t>(base + from));
                u->indices.push_back(static_cast<uint16_t>(base + to));
            }
        }
    }
    assert(u->indices.size() <= static_cast<size_t>(units) * 2 * UPLOAD_UNIT_LINES);
    u->indices.resize(static_cast<size_t>(units) * 2 * UPLOAD_UNIT_LINES, static_cast<uint16_t>(base));
}

/* Rising sides, as pack_lines counts them: between one and two a triangle. */
size_t line_count(const patch &p)
{
    size_t count = 0;
    for (size_t t = 0; t < p.triangle_count; t++)
        for (size_t c = 0; c < 3; c++)
            count += name_of(p, p.triangles[t][c]) < name_of(p, p.triangles[t][(c + 1) % 3]);
    return count;
}

size_t parts(size_t n, size_t each) { return (n + each - 1) / each; }

int units_for(const upload &u, const patch &p)
{
    size_t units =
        std::max(parts(p.vertex_count, UPLOAD_UNIT_VERTICES), parts(p.triangle_count, UPLOAD_UNIT_TRIANGLES));
    if (u.with_lines)
        units = std::max(units, parts(line_count(p), UPLOAD_UNIT_LINES));
    return static_cast<int>(units);
}

void drop(upload *u, upload_slot *s)
{
    if (s->units == 0)
        return;
    upload_page &page = u->pages[s->page];
    const size_t first = static_cast<size_t>(s->first);
    u->indices.assign(static_cast<size_t>(s->units) * 3 * UPLOAD_UNIT_TRIANGLES, 0);
    send(u, page.triangles, first * unit_triangle_bytes, static_cast<size_t>(s->units) * unit_triangle_bytes,
         u->indices.data());
    if (u->with_lines)
        send(u, page.lines, first * unit_line_bytes, static_cast<size_t>(s->units) * unit_line_bytes,
             u->indices.data());
    mark(&page, s->first, s->units, false);
    *s = upload_slot{};
    u->counts.held--;
}

bool place(upload *u, upload_slot *s, int units, std::string *trouble_out)
{
    for (uint32_t page = 0;; page++) {
        if (page == u->pages.size() && !open_page(u, trouble_out))
            return false;
        const int first = free_run(&u->pages[page], units);
        if (first < 0)
            continue;
        mark(&u->pages[page], first, units, true);
        s->page = page;
        s->first = first;
        s->units = units;
        u->counts.held++;
        return true;
    }
}

bool put(upload *u, upload_slot *s, const patch &p, std::string *trouble_out)
{
    const int units = units_for(*u, p);
    assert(units <= UPLOAD_UNITS);
    bool moved = !key_equal(s->at, p.at);
    if (units > s->units || units * 2 < s->units) {
        drop(u, s);
        if (!place(u, s, units, trouble_out))
            return false;
        moved = true;
    }
    const upload_page &page = u->pages[s->page];
    const size_t first = static_cast<size_t>(s->first), base = first * UPLOAD_UNIT_VERTICES;
    pack_vertices(u, p, s->first);
    send(u, page.vertices, first * unit_vertex_bytes, u->packed.size() * sizeof(upload_vertex), u->packed.data());
    pack_triangles(u, p, s->units, base);
    send(u, page.triangles, first * unit_triangle_bytes, u->indices.size() * sizeof(uint16_t), u->indices.data());
    if (u->with_lines) {
        pack_lines(u, p, s->units, base);
        send(u, page.lines, first * unit_line_bytes, u->indices.size() * sizeof(uint16_t), u->indices.data());
    }
    if (moved) {
        const GLint texel[4] = {p.at.i, p.at.j, p.at.k, 0};
        glBindTexture(GL_TEXTURE_2D, page.bricks);
        glTexSubImage2D(GL_TEXTURE_2D, 0, s->first, 0, 1, 1, GL_RGBA_INTEGER, GL_INT, texel);
        u->counts.bytes += sizeof texel;
    }
    s->at = p.at;
    s->generation = p.generation;
    u->counts.patches++;
    return true;
}

void draw(const upload &u, GLenum kind, GLuint upload_page::*array, size_t indices_each)
{
    glActiveTexture(GL_TEXTURE0);
    for (const upload_page &p : u.pages) {
        if (p.top == 0)
            continue;
        glBindTexture(GL_TEXTURE_2D, p.bricks);
        glBindVertexArray(p.*array);
        glDrawElements(kind, static_cast<GLsizei>(static_cast<size_t>(p.top) * indices_each), GL_UNSIGNED_SHORT,
                       nullptr);
    }
    glBindVertexArray(0);
}

} // namespace

void upload_init(upload *u, bool with_lines)
{
    *u = upload{};
    u->with_lines = with_lines;
}

void upload_finish(upload *u)
{
    for (upload_page &p : u->pages)
        close_page(&p);
    *u = upload{};
}

void upload_clear(upload *u)
{
    for (upload_slot &s : u->slots)
        drop(u, &s);
    u->slots.clear();
    u->newest = 0;
    u->bricks = box_empty();
}

bool upload_update(upload *u, const surface *s, std::string *trouble_out)
{
    /* A surface's generations only grow: a smaller one is another surface, whose numbers mean nothing here. */
    if (s->generation < u->newest)
        upload_clear(u);
    u->newest = s->generation;
    if (u->slots.size() < surface_slots(s))
        u->slots.resize(surface_slots(s));
    box bricks = box_empty();
    for (uint32_t n = 0; n < u->slots.size(); n++) {
        const patch *p = n < surface_slots(s) ? surface_patch(s, n) : nullptr;
        upload_slot &slot = u->slots[n];
        if (!p || p->triangle_count == 0) {
            drop(u, &slot);
            continue;
        }
        bricks = box_include(bricks, p->at);
        if ((slot.units == 0 || slot.generation != p->generation) && !put(u, &slot, *p, trouble_out))
            return false;
    }
    u->bricks = bricks;
    return true;
}

void upload_draw_triangles(const upload &u) { draw(u, GL_TRIANGLES, &upload_page::array, 3 * UPLOAD_UNIT_TRIANGLES); }

void upload_draw_lines(const upload &u)
{
    if (u.with_lines)
        draw(u, GL_LINES, &upload_page::line_array, 2 * UPLOAD_UNIT_LINES);
}
