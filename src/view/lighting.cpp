/* SPDX-License-Identifier: Apache-2.0 */
#include "view/lighting.h"

#include "view/program.h"

#include <glm/gtc/type_ptr.hpp>

lighting_lamps lighting_lamps_of(const snapshot &s, const glm::dmat4 &eye_from_world)
{
    lighting_lamps lamps;
    if (s.look == SNAPSHOT_LOOK_RAKING) {
        const glm::dvec3 far_out(LIGHTING_RAKING_DISTANCE * s.camera_distance * LIGHTING_RAKING);
        lamps.count = 1;
        lamps.place[0] = glm::vec3(glm::dvec3(0, 0, -s.camera_distance) + far_out);
        lamps.colour[0] = glm::vec3(LIGHTING_RAKING_STRENGTH);
        return lamps;
    }
    for (const snapshot_light &light : s.lights) {
        if (!light.lit)
            continue;
        const auto n = static_cast<size_t>(lamps.count++);
        const glm::dvec4 at(light.position[0], light.position[1], light.position[2], 1);
        lamps.place[n] = glm::vec3(light.with_viewer ? at : eye_from_world * at);
        lamps.colour[n] = light.strength * glm::vec3(light.colour[0], light.colour[1], light.colour[2]);
    }
    return lamps;
}

lighting_uniforms lighting_find(GLuint program)
{
    lighting_uniforms at;
    at.count = program_uniform(program, "u_light_count");
    at.place = program_uniform(program, "u_light_place[0]");
    at.colour = program_uniform(program, "u_light_colour[0]");
    at.irradiance = program_uniform(program, "u_irradiance[0]");
    at.origin = program_uniform(program, "u_origin");
    at.shadow_taps = program_uniform(program, "u_shadow_taps");
    at.shadow_from_eye = program_uniform(program, "u_shadow_from_eye");
    at.shadow = program_uniform(program, "u_shadow");
    at.hollow_strength = program_uniform(program, "u_hollow_strength");
    at.depth_range = program_uniform(program, "u_depth_range");
    glUseProgram(program);
    glUniform1i(program_uniform(program, "u_shadow_map"), LIGHTING_UNIT_SHADOW);
    glUniform1i(program_uniform(program, "u_shadow_depth"), LIGHTING_UNIT_SHADOW_BARE);
    glUniform1i(program_uniform(program, "u_hollow"), LIGHTING_UNIT_HOLLOW);
    glUseProgram(0);
    return at;
}

void lighting_set(const lighting_uniforms &at, const lighting &light)
{
    glUniform1i(at.count, light.lamps.count);
    glUniform3fv(at.place, SNAPSHOT_LIGHTS, glm::value_ptr(light.lamps.place[0]));
    glUniform3fv(at.colour, SNAPSHOT_LIGHTS, glm::value_ptr(light.lamps.colour[0]));
    glUniform3fv(at.irradiance, SCENERY_COEFFICIENTS, light.scenery->irradiance[0].data());
    glUniform2f(at.origin, light.origin.x, light.origin.y);
    glUniform1i(at.shadow_taps, light.shadow_taps);
    const glm::mat4 shadow_from_eye(light.sight.lamp_from_eye * light.mono_from_eye);
    const double near = light.sight.from_lamp.near_mm, far = light.sight.from_lamp.far_mm;
    glUniformMatrix4fv(at.shadow_from_eye, 1, GL_FALSE, glm::value_ptr(shadow_from_eye));
    glUniform4f(at.shadow, 1 / static_cast<float>(SHADOW_SIDE), static_cast<float>(light.sight.texel_mm),
                static_cast<float>(light.sight.lamp_half_width), static_cast<float>((far - near) / far));
    glUniform1f(at.hollow_strength, light.hollow_strength);
    glUniform2f(at.depth_range, static_cast<float>(light.near_mm), static_cast<float>(light.far_mm));
}

void lighting_bind(const lighting &light)
{
    glActiveTexture(GL_TEXTURE0 + LIGHTING_UNIT_MIRROR);
    glBindTexture(GL_TEXTURE_2D, light.scenery->mirror);
    glActiveTexture(GL_TEXTURE0 + LIGHTING_UNIT_ROUGH);
    glBindTexture(GL_TEXTURE_2D, light.scenery->rough);
    glActiveTexture(GL_TEXTURE0 + LIGHTING_UNIT_SHADOW);
    glBindTexture(GL_TEXTURE_2D, light.shadow->texture);
    glActiveTexture(GL_TEXTURE0 + LIGHTING_UNIT_SHADOW_BARE);
    glBindTexture(GL_TEXTURE_2D, light.shadow->texture);
    glBindSampler(LIGHTING_UNIT_SHADOW_BARE, light.shadow->bare);
    glActiveTexture(GL_TEXTURE0 + LIGHTING_UNIT_HOLLOW);
    glBindTexture(GL_TEXTURE_2D, light.hollow);
    glActiveTexture(GL_TEXTURE0);
}

void lighting_release()
{
    for (GLenum unit = LIGHTING_UNIT_MIRROR; unit < LIGHTING_UNITS; unit++) {
        glActiveTexture(GL_TEXTURE0 + unit);
        glBindTexture(GL_TEXTURE_2D, 0);
    }
    glBindSampler(LIGHTING_UNIT_SHADOW_BARE, 0);
    glActiveTexture(GL_TEXTURE0);
}
