/* SPDX-License-Identifier: Apache-2.0 */
#include "view/shadow.h"

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace {

constexpr double same = 2e-6; /* of a matrix's largest number: lamps are floats; a two-hundredth of a texel */

} // namespace

bool shadow_open(shadow *s, std::string *trouble_out)
{
    *s = {};
    while (glGetError() != GL_NO_ERROR) {
    }
    glGenTextures(1, &s->texture);
    glBindTexture(GL_TEXTURE_2D, s->texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT24, SHADOW_SIDE, SHADOW_SIDE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenSamplers(1, &s->bare);
    glSamplerParameteri(s->bare, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(s->bare, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glSamplerParameteri(s->bare, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(s->bare, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glGenFramebuffers(1, &s->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, s->texture, 0);
    const GLenum none = GL_NONE;
    glDrawBuffers(1, &none);
    const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (complete && glGetError() == GL_NO_ERROR)
        return true;
    *trouble_out = "the device has no memory, or no format, for shadows";
    shadow_close(s);
    return false;
}

void shadow_close(shadow *s)
{
    if (s->texture != 0) {
        glDeleteFramebuffers(1, &s->framebuffer);
        glDeleteTextures(1, &s->texture);
        glDeleteSamplers(1, &s->bare);
    }
    *s = {};
}

shadow_sight shadow_look(const projection &p, const projection_ball &ball, const glm::dvec3 &lamp_eye)
{
    glm::dvec3 toward = lamp_eye - ball.middle_eye;
    const double radius = std::max(ball.radius, 1e-6);
    if (!(glm::length(toward) > 1e-9 * radius))
        toward = glm::dvec3(0, 0, 1);
    const double distance = std::max(glm::length(toward), SHADOW_NEAREST * radius);
    const glm::dvec3 lamp = ball.middle_eye + distance * glm::normalize(toward);
    /* By the world's axes: a lamp that turns with the piece then sees it as before. */
    const glm::dvec3 y(p.eye_from_world[1]), x(p.eye_from_world[0]);
    const glm::dvec3 up = std::abs(glm::dot(glm::normalize(toward), y)) < 0.9 ? y : x;
    const glm::dmat4 lamp_from_eye = glm::lookAtRH(lamp, ball.middle_eye, up);
    const double angle = 2 * std::asin(radius / distance) * 1.02;
    shadow_sight s;
    s.from_lamp.near_mm = distance - radius;
    s.from_lamp.far_mm = distance + radius;
    s.from_lamp.eye_from_world = lamp_from_eye * p.eye_from_world;
    s.from_lamp.clip_from_eye = glm::perspectiveRH_NO(angle, 1.0, s.from_lamp.near_mm, s.from_lamp.far_mm);
    s.lamp_from_eye = s.from_lamp.clip_from_eye * lamp_from_eye;
    s.texel_mm = 2 * std::tan(angle / 2) / double{SHADOW_SIDE};
    s.lamp_half_width = SHADOW_LAMP_WIDTH * distance;
    return s;
}

bool shadow_is_stale(const shadow &s, const shadow_sight &sight, uint64_t generation)
{
    const glm::dmat4 now = sight.from_lamp.clip_from_eye * sight.from_lamp.eye_from_world;
    double off = 0, largest = 0;
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            off = std::max(off, std::abs(now[column][row] - s.drawn[column][row]));
            largest = std::max(largest, std::abs(now[column][row]));
        }
    return s.generation != generation || !(off <= same * largest);
}

void shadow_begin(const shadow &s)
{
    glBindFramebuffer(GL_FRAMEBUFFER, s.framebuffer);
    glViewport(0, 0, SHADOW_SIDE, SHADOW_SIDE);
    glDisable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClearDepthf(1);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2);
}

void shadow_end(shadow *s, const shadow_sight &sight, uint64_t generation)
{
    glDisable(GL_POLYGON_OFFSET_FILL);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    s->generation = generation;
    s->drawn = sight.from_lamp.clip_from_eye * sight.from_lamp.eye_from_world;
}
