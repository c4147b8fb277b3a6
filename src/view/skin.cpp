/* SPDX-License-Identifier: Apache-2.0 */
#include "view/skin.h"

#include "view/clay_shader.h"
#include "view/colour_shader.h"
#include "view/hollow_shader.h"
#include "view/layer_shader.h"
#include "view/lighting_shader.h"
#include "view/marker.h"
#include "view/patch_shader.h"
#include "view/plain_shader.h"
#include "view/program.h"
#include "view/shadow_shader.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>

namespace {

constexpr double brick_steps = BRICK_EDGE;

bool open_program(skin_program *p, const char *name, const program_text &fragment, std::string *trouble_out)
{
    if (!program_open(name, {colour_shader_text, patch_shader_vertex}, fragment, &p->program, trouble_out))
        return false;
    p->middle = program_uniform(p->program, "u_middle");
    p->eye_from_steps = program_uniform(p->program, "u_eye_from_steps");
    p->eye_normal = glGetUniformLocation(p->program, "u_eye_normal"); /* not in a program of depths alone */
    p->clip_from_eye = program_uniform(p->program, "u_clip_from_eye");
    glUseProgram(p->program);
    glUniform1i(program_uniform(p->program, "u_bricks"), 0);
    glUseProgram(0);
    return true;
}

skin_layer find_layer(GLuint p)
{
    glUseProgram(p);
    glUniform1i(program_uniform(p, "u_mirror"), LIGHTING_UNIT_MIRROR);
    glUseProgram(0);
    return {program_uniform(p, "u_environment"), program_uniform(p, "u_environment_strength"),
            program_uniform(p, "u_tool_from_eye"), program_uniform(p, "u_ring")};
}

bool open_plain(skin *k, std::string *trouble_out)
{
    if (!open_program(&k->plain, "plain clay", {colour_shader_text, layer_shader_text, plain_shader_fragment},
                      trouble_out))
        return false;
    k->plain_layer = find_layer(k->plain.program);
    k->plain_count = program_uniform(k->plain.program, "u_light_count");
    k->plain_place = program_uniform(k->plain.program, "u_light_place[0]");
    k->plain_colour = program_uniform(k->plain.program, "u_light_colour[0]");
    k->plain_material = program_uniform(k->plain.program, "u_material");
    return true;
}

/* Each for itself: one that does not compile takes no other along. */
void open_clay(skin *k, std::string *trouble_out)
{
    static_assert(SCENERY_ROUGHEST == 6, "clay_shader.h says so too");
    std::string trouble;
    if (open_program(&k->clay, "clay",
                     {colour_shader_text, layer_shader_text, lighting_shader_text, clay_shader_fragment}, &trouble)) {
        k->clay_layer = find_layer(k->clay.program);
        k->clay_light = lighting_find(k->clay.program);
        glUseProgram(k->clay.program);
        glUniform1i(program_uniform(k->clay.program, "u_rough"), LIGHTING_UNIT_ROUGH);
        glUseProgram(0);
        k->clay_look = program_uniform(k->clay.program, "u_look");
        k->clay_material = program_uniform(k->clay.program, "u_material");
    }
    if (open_program(&k->relief, "clay's relief", {hollow_shader_relief}, &trouble))
        k->relief_range = program_uniform(k->relief.program, "u_depth_range");
    if (!open_program(&k->depth, "clay's depth", {shadow_shader_fragment}, &trouble))
        k->depth = {};
    if (!trouble.empty())
        *trouble_out = trouble;
}

/* The brick under the point the camera looks at: from there offsets are small where precision is wanted. */
key middle_brick(const snapshot &s, const glm::dmat4 &eye_from_world)
{
    const glm::dvec3 target(glm::inverse(eye_from_world) * glm::dvec4(0, 0, -s.camera_distance, 1));
    const glm::dvec3 brick = glm::clamp(glm::floor(target / (s.step_mm * brick_steps)), glm::dvec3(KEY_MIN / 8),
                                        glm::dvec3(KEY_MAX / 8));
    return {static_cast<int32_t>(brick.x), static_cast<int32_t>(brick.y), static_cast<int32_t>(brick.z)};
}

void set_place(const skin_program &at, const snapshot &s, const projection &p)
{
    const key middle = middle_brick(s, p.eye_from_world);
    const glm::dvec3 from = s.step_mm * brick_steps * glm::dvec3(middle.i, middle.j, middle.k);
    const glm::mat4 eye(glm::scale(glm::translate(p.eye_from_world, from), glm::dvec3(s.step_mm)));
    const glm::mat3 normal{glm::dmat3(p.eye_from_world)};
    const glm::mat4 clip(p.clip_from_eye);
    glUniform3i(at.middle, middle.i, middle.j, middle.k);
    glUniformMatrix4fv(at.eye_from_steps, 1, GL_FALSE, glm::value_ptr(eye));
    glUniformMatrix3fv(at.eye_normal, 1, GL_FALSE, glm::value_ptr(normal));
    glUniformMatrix4fv(at.clip_from_eye, 1, GL_FALSE, glm::value_ptr(clip));
}

void set_layer(const skin_layer &at, const snapshot &s, const projection &p)
{
    glm::mat4 tool_from_eye(1);
    glm::vec4 ring(0);
    glm::dmat4 eye_from_tool;
    if (s.tool_style != SNAPSHOT_TOOL_HIDDEN && !s.tool_surface && marker_eye_from_tool(s, p, &eye_from_tool)) {
        tool_from_eye = glm::mat4(glm::inverse(eye_from_tool));
        ring = glm::vec4(marker_tool_colour(s), s.tool_working ? 1.0f : 0.7f);
    }
    glUniform1i(at.environment, s.environment);
    glUniform1f(at.strength, std::clamp(s.environment_strength, 0.0f, 1.0f));
    glUniformMatrix4fv(at.tool_from_eye, 1, GL_FALSE, glm::value_ptr(tool_from_eye));
    glUniform4fv(at.ring, 1, glm::value_ptr(ring));
}

void draw_front(const upload &patches, const projection &p)
{
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(projection_is_mirrored(p) ? GL_CW : GL_CCW);
    upload_draw_triangles(patches);
    glFrontFace(GL_CCW);
    glDisable(GL_CULL_FACE);
}

} // namespace

bool skin_open(skin *k, std::string *trouble_out)
{
    *k = {};
    if (!open_plain(k, trouble_out))
        return false;
    open_clay(k, trouble_out);
    return true;
}

void skin_close(skin *k)
{
    for (const skin_program &p : {k->plain, k->clay, k->relief, k->depth})
        program_close(p.program);
    *k = {};
}

snapshot_look skin_look(const skin &k, snapshot_look wanted)
{
    return k.clay.program == 0 ? SNAPSHOT_LOOK_PLAIN : wanted;
}

void skin_draw(const skin &k, const upload &patches, const snapshot &s, const projection &p, const lighting &light)
{
    const bool plain = skin_look(k, s.look) == SNAPSHOT_LOOK_PLAIN;
    const skin_program &program = plain ? k.plain : k.clay;
    glUseProgram(program.program);
    set_place(program, s, p);
    set_layer(plain ? k.plain_layer : k.clay_layer, s, p);
    glUniform3f(plain ? k.plain_material : k.clay_material, s.material.specular, std::max(s.material.shininess, 1.0f),
                s.material.ambient);
    if (plain) {
        glUniform1i(k.plain_count, light.lamps.count);
        glUniform3fv(k.plain_place, SNAPSHOT_LIGHTS, glm::value_ptr(light.lamps.place[0]));
        glUniform3fv(k.plain_colour, SNAPSHOT_LIGHTS, glm::value_ptr(light.lamps.colour[0]));
    } else {
        lighting_set(k.clay_light, light);
        glUniform1i(k.clay_look, s.look);
    }
    draw_front(patches, p);
}

void skin_draw_relief(const skin &k, const upload &patches, const snapshot &s, const projection &p)
{
    glUseProgram(k.relief.program);
    set_place(k.relief, s, p);
    glUniform2f(k.relief_range, static_cast<float>(p.near_mm), static_cast<float>(p.far_mm));
    draw_front(patches, p);
}

void skin_draw_depth(const skin &k, const upload &patches, const snapshot &s, const projection &p)
{
    glUseProgram(k.depth.program);
    set_place(k.depth, s, p);
    upload_draw_triangles(patches);
}
