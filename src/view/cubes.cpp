/* SPDX-License-Identifier: Apache-2.0 */
#include "view/cubes.h"

#include "view/colour_shader.h"
#include "view/cubes_shader.h"
#include "view/program.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace {

const glm::vec3 stored_colour(0.33f, 0.43f, 0.55f); /* cool: space that is kept */
const glm::vec3 crossing_colour(0.62f, 0.33f, 0.17f); /* warm: clay */

/* --- sets of 512 --- */

/* Bit c of the answer: is c's neighbour one up along the axis in the set? above: the next brick's. */
brick_mask upper(int axis, const brick_mask &own, const brick_mask &above)
{
    brick_mask m{};
    for (int s = 0; s < BRICK_EDGE; s++) {
        const uint64_t here = own.slab[s], there = above.slab[s];
        if (axis == 0)
            m.slab[s] = s + 1 < BRICK_EDGE ? own.slab[s + 1] : above.slab[0];
        else if (axis == 1)
            m.slab[s] = here >> 8 | there << 56;
        else
            m.slab[s] = (here & ~BRICK_K_FIRST) >> 1 | (there & BRICK_K_FIRST) << 7;
    }
    return m;
}

brick_mask lower(int axis, const brick_mask &own, const brick_mask &below)
{
    brick_mask m{};
    for (int s = 0; s < BRICK_EDGE; s++) {
        const uint64_t here = own.slab[s], there = below.slab[s];
        if (axis == 0)
            m.slab[s] = s > 0 ? own.slab[s - 1] : below.slab[BRICK_EDGE - 1];
        else if (axis == 1)
            m.slab[s] = here << 8 | there >> 56;
        else
            m.slab[s] = (here & ~BRICK_K_LAST) << 1 | (there & BRICK_K_LAST) >> 7;
    }
    return m;
}

struct block {
    key at; /* brick key */
    brick_mask set;
};

key span_of(key brick_at)
{
    const auto down = [](int32_t n) { return n & ~(CUBES_SPAN_BRICKS - 1); };
    return {down(brick_at.i), down(brick_at.j), down(brick_at.k)};
}

bool by_span(const key &a, const key &b)
{
    const int spans = key_compare(span_of(a), span_of(b));
    return spans != 0 ? spans < 0 : key_compare(a, b) < 0;
}

/* --- cubes that have a corner stored --- */

brick_mask stored_corners(const brick &b)
{
    brick_mask m{};
    for (int n = 0; n < BRICK_CORNERS; n++)
        m.slab[n >> 6] |= uint64_t{b.page->potential[n] > POTENTIAL_MIN} << (n & 63);
    return m;
}

/* By brick id. */
std::vector<brick_mask> all_stored_corners(const clay &c)
{
    std::vector<brick_mask> masks(c.bricks.fresh);
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c.tree, &at, &id); more; more = avl_next(&w, &at, &id))
        masks[id] = stored_corners(*clay_brick(&c, id));
    return masks;
}

/* Bricks of cubes: those stored, and those below them whose cubes reach into one. */
std::vector<key> reached_bricks(const clay &c)
{
    std::vector<key> keys;
    avl_walk w;
    key at;
    uint32_t id;
    for (bool more = avl_first(&w, &c.tree, &at, &id); more; more = avl_next(&w, &at, &id)) {
        for (int d = 0; d < 8; d++) {
            const int n = brick_neighbour_index(-(d >> 2 & 1), -(d >> 1 & 1), -(d & 1));
            if (d == 0 || clay_brick(&c, id)->neighbour[n] == POOL_NONE)
                keys.push_back(brick_neighbour_key(at, n));
        }
    }
    std::sort(keys.begin(), keys.end(), by_span);
    keys.erase(std::unique(keys.begin(), keys.end(), key_equal), keys.end());
    return keys;
}

/* Cube c has corners c and one up along each axis, any way combined: three steps of OR, each halving the bricks. */
brick_mask cubes_of_corners(std::array<brick_mask, 8> corners)
{
    for (int axis = 2, apart = 1; axis >= 0; axis--, apart *= 2) {
        for (size_t n = 0; n < 8; n += 2 * static_cast<size_t>(apart)) {
            const brick_mask up = upper(axis, corners[n], corners[n + static_cast<size_t>(apart)]);
            brick_mask_unite(&corners[n], &up);
        }
    }
    return corners[0];
}

std::vector<block> stored_blocks(const clay &c)
{
    const std::vector<brick_mask> corners = all_stored_corners(c);
    std::vector<block> blocks;
    for (const key &at : reached_bricks(c)) {
        uint32_t ids[BRICK_NEIGHBOURS];
        clay_neighbours(&c, at, ids);
        std::array<brick_mask, 8> near{};
        for (int d = 0; d < 8; d++) {
            const uint32_t id = ids[brick_neighbour_index(d >> 2 & 1, d >> 1 & 1, d & 1)];
            if (id != POOL_NONE)
                near[static_cast<size_t>(d)] = corners[id];
        }
        const brick_mask set = cubes_of_corners(near);
        if (!brick_mask_is_empty(&set))
            blocks.push_back({at, set});
    }
    return blocks;
}

/* --- cubes that cross --- */

std::vector<block> crossing_blocks(const surface &s)
{
    std::vector<block> blocks;
    for (uint32_t slot = 0; slot < surface_slots(&s); slot++)
        if (const patch *p = surface_patch(&s, slot))
            blocks.push_back({p->at, p->crossing});
    std::sort(blocks.begin(), blocks.end(), [](const block &a, const block &b) { return by_span(a.at, b.at); });
    return blocks;
}

/* --- faces --- */

const block *find(const std::vector<block> &blocks, key at)
{
    const auto found = std::lower_bound(blocks.begin(), blocks.end(), at,
                                        [](const block &b, const key &k) { return by_span(b.at, k); });
    return found != blocks.end() && key_equal(found->at, at) ? &*found : nullptr;
}

key beside(key at, int axis, int by)
{
    return key_add(at, axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0);
}

void add_face(cubes_faces *out, key at, int side)
{
    const key span = span_of(at);
    if (out->spans.empty() || !key_equal(out->spans.back().at, span))
        out->spans.push_back({span, out->faces.size(), 0});
    out->spans.back().count++;
    out->faces.push_back({{static_cast<uint16_t>(at.i - span.i), static_cast<uint16_t>(at.j - span.j),
                           static_cast<uint16_t>(at.k - span.k)},
                          static_cast<uint16_t>(side)});
}

void add_cube_faces(cubes_faces *out, const std::vector<block> &blocks, const block &b)
{
    const key span = span_of(b.at);
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2, by = side % 2 * 2 - 1;
        const block *other = find(blocks, beside(b.at, axis, by));
        const brick_mask none{}, &others = other ? other->set : none;
        const brick_mask covered = by > 0 ? upper(axis, b.set, others) : lower(axis, b.set, others);
        for (int s = 0; s < BRICK_EDGE; s++) {
            for (uint64_t bare = b.set.slab[s] & ~covered.slab[s]; bare != 0; bare &= bare - 1) {
                const int bit = __builtin_ctzll(bare);
                add_face(out, b.at, side);
                uint16_t *place = out->faces.back().place;
                place[0] = static_cast<uint16_t>((b.at.i - span.i) * BRICK_EDGE + s);
                place[1] = static_cast<uint16_t>((b.at.j - span.j) * BRICK_EDGE + bit / BRICK_EDGE);
                place[2] = static_cast<uint16_t>((b.at.k - span.k) * BRICK_EDGE + bit % BRICK_EDGE);
            }
        }
    }
}

void list_bricks(cubes_faces *out, const std::vector<block> &blocks)
{
    out->faces.clear();
    out->spans.clear();
    out->are_bricks = true;
    for (const block &b : blocks)
        for (int side = 0; side < 6; side++)
            if (!find(blocks, beside(b.at, side / 2, side % 2 * 2 - 1)))
                add_face(out, b.at, side);
}

/* --- the device --- */

bool send(cubes *c, std::string *trouble_out)
{
    while (glGetError() != GL_NO_ERROR) {
    }
    glBindBuffer(GL_ARRAY_BUFFER, c->buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(c->shown.faces.size() * sizeof(cubes_face)),
                 c->shown.faces.data(), GL_DYNAMIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    if (glGetError() == GL_NO_ERROR)
        return true;
    *trouble_out = "the device has no memory for " + std::to_string(c->shown.faces.size()) + " faces of cubes";
    return false;
}

cubes_seen see(const sculpture *s, snapshot_structure structure)
{
    cubes_seen now = {s, structure, s->surface.generation, s->surface.triangles, 0, 0, 0, 0};
    if (structure == SNAPSHOT_STRUCTURE_STORED) {
        now.corners = s->clay.corners;
        now.births = s->clay.births;
        now.dab = s->dab;
        now.strokes = s->strokes;
    }
    return now;
}

void set_lights(const cubes &c, const snapshot &s, const projection &p)
{
    std::array<glm::vec3, SNAPSHOT_LIGHTS> place{}, colour{};
    size_t count = 0;
    for (const snapshot_light &light : s.lights) {
        if (!light.lit)
            continue;
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        place[count] = glm::vec3(light.with_viewer ? at : p.eye_from_world * at);
        colour[count++] = light.strength * glm::vec3(light.colour[0], light.colour[1], light.colour[2]);
    }
    glUniform1i(c.light_count, static_cast<GLint>(count));
    glUniform3fv(c.light_place, SNAPSHOT_LIGHTS, glm::value_ptr(place[0]));
    glUniform3fv(c.light_colour, SNAPSHOT_LIGHTS, glm::value_ptr(colour[0]));
}

} // namespace

void cubes_list(const sculpture *s, snapshot_structure structure, size_t faces_max, cubes_faces *out)
{
    assert(structure == SNAPSHOT_STRUCTURE_STORED || structure == SNAPSHOT_STRUCTURE_CROSSING);
    *out = cubes_faces{};
    const std::vector<block> blocks =
        structure == SNAPSHOT_STRUCTURE_STORED ? stored_blocks(s->clay) : crossing_blocks(s->surface);
    for (const block &b : blocks) {
        out->cubes += brick_mask_count(&b.set);
        out->within = box_include(out->within, b.at);
    }
    out->bricks = blocks.size();
    for (const block &b : blocks) {
        add_cube_faces(out, blocks, b);
        if (out->faces.size() > faces_max) {
            list_bricks(out, blocks);
            return;
        }
    }
}

bool cubes_open(cubes *c, std::string *trouble_out)
{
    *c = cubes{};
    if (!program_open("cubes", {cubes_shader_vertex}, {colour_shader_text, cubes_shader_fragment}, &c->program,
                      trouble_out))
        return false;
    c->eye_from_units = program_uniform(c->program, "u_eye_from_units");
    c->eye_normal = program_uniform(c->program, "u_eye_normal");
    c->clip_from_eye = program_uniform(c->program, "u_clip_from_eye");
    c->colour = program_uniform(c->program, "u_colour");
    c->light_count = program_uniform(c->program, "u_light_count");
    c->light_place = program_uniform(c->program, "u_light_place[0]");
    c->light_colour = program_uniform(c->program, "u_light_colour[0]");
    glGenBuffers(1, &c->buffer);
    glGenVertexArrays(1, &c->array);
    glBindVertexArray(c->array);
    glEnableVertexAttribArray(0);
    glVertexAttribIFormat(0, 4, GL_UNSIGNED_SHORT, 0);
    glVertexAttribBinding(0, 0);
    glVertexBindingDivisor(0, 1);
    glBindVertexArray(0);
    return true;
}

void cubes_close(cubes *c)
{
    program_close(c->program);
    if (c->array != 0) {
        glDeleteVertexArrays(1, &c->array);
        glDeleteBuffers(1, &c->buffer);
    }
    *c = cubes{};
}

void cubes_clear(cubes *c)
{
    if (c->seen == cubes_seen{})
        return;
    c->shown = cubes_faces{};
    c->seen = cubes_seen{};
    glBindBuffer(GL_ARRAY_BUFFER, c->buffer);
    glBufferData(GL_ARRAY_BUFFER, 0, nullptr, GL_DYNAMIC_DRAW);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
}

bool cubes_update(cubes *c, const sculpture *s, snapshot_structure structure, std::string *trouble_out)
{
    const cubes_seen now = see(s, structure);
    if (c->seen == now)
        return true;
    cubes_list(s, structure, CUBES_FACES_MAX, &c->shown);
    if (!send(c, trouble_out)) {
        cubes_clear(c);
        c->shown = cubes_faces{};
        return false;
    }
    c->seen = now;
    c->shown.faces = {}; /* the device has them */
    return true;
}

void cubes_draw(const cubes &c, const snapshot &s, const projection &p)
{
    const glm::mat4 clip(p.clip_from_eye);
    const glm::mat3 normal{glm::dmat3(p.eye_from_world)};
    const glm::vec3 &colour =
        c.seen.structure == SNAPSHOT_STRUCTURE_CROSSING ? crossing_colour : stored_colour;
    const double unit_mm = s.step_mm * (c.shown.are_bricks ? BRICK_EDGE : 1);
    glUseProgram(c.program);
    glUniformMatrix4fv(c.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
    glUniformMatrix3fv(c.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniform3fv(c.colour, 1, glm::value_ptr(colour));
    set_lights(c, s, p);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(projection_is_mirrored(p) ? GL_CW : GL_CCW);
    glBindVertexArray(c.array);
    for (const cubes_span &span : c.shown.spans) {
        const glm::dvec3 from = s.step_mm * double{BRICK_EDGE} * glm::dvec3(span.at.i, span.at.j, span.at.k);
        const glm::mat4 eye(glm::scale(glm::translate(p.eye_from_world, from), glm::dvec3(unit_mm)));
        glUniformMatrix4fv(c.eye_from_units, 1, GL_FALSE, glm::value_ptr(eye));
        glBindVertexBuffer(0, c.buffer, static_cast<GLintptr>(span.first * sizeof(cubes_face)), sizeof(cubes_face));
        glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(span.count));
    }
    glBindVertexArray(0);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}
