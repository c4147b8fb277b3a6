/* SPDX-License-Identifier: Apache-2.0 */
#include "view/hollow.h"

#include "view/hollow_shader.h"
#include "view/program.h"
#include "view/screen_shader.h"

namespace {

bool buffer_make(hollow_buffer *b, GLenum format, int width, int height)
{
    glGenTextures(1, &b->texture);
    glBindTexture(GL_TEXTURE_2D, b->texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &b->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, b->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, b->texture, 0);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void buffer_close(hollow_buffer *b)
{
    if (b->framebuffer != 0) {
        glDeleteFramebuffers(1, &b->framebuffer);
        glDeleteTextures(1, &b->texture);
    }
    *b = {};
}

void buffers_close(hollow *h)
{
    buffer_close(&h->relief);
    buffer_close(&h->hidden);
    buffer_close(&h->smoothed);
    if (h->depth != 0)
        glDeleteRenderbuffers(1, &h->depth);
    h->depth = 0;
    h->width = h->height = 0;
}

} // namespace

bool hollow_open(hollow *h, std::string *trouble_out)
{
    *h = {};
    if (!program_open("hollow", {screen_shader_vertex}, {hollow_shader_hidden}, &h->hidden_program, trouble_out) ||
        !program_open("hollow's mean", {screen_shader_vertex}, {hollow_shader_smoothed}, &h->smoothed_program,
                      trouble_out)) {
        hollow_close(h);
        return false;
    }
    h->depth_range = program_uniform(h->hidden_program, "u_depth_range");
    h->clip = program_uniform(h->hidden_program, "u_clip");
    h->reach = program_uniform(h->hidden_program, "u_reach");
    h->origin = program_uniform(h->hidden_program, "u_origin");
    h->taps = program_uniform(h->hidden_program, "u_taps");
    glGenVertexArrays(1, &h->empty_array);
    return true;
}

void hollow_close(hollow *h)
{
    buffers_close(h);
    program_close(h->hidden_program);
    program_close(h->smoothed_program);
    if (h->empty_array != 0)
        glDeleteVertexArrays(1, &h->empty_array);
    *h = {};
}

bool hollow_size(hollow *h, int picture_width, int picture_height, std::string *trouble_out)
{
    const int width = (picture_width + 1) / 2, height = (picture_height + 1) / 2;
    if (h->width == width && h->height == height)
        return true;
    buffers_close(h);
    while (glGetError() != GL_NO_ERROR) {
    }
    bool complete = buffer_make(&h->hidden, GL_RGBA8, width, height);
    complete = buffer_make(&h->smoothed, GL_RGBA8, width, height) && complete;
    glGenRenderbuffers(1, &h->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, h->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    complete = buffer_make(&h->relief, GL_RGBA16UI, width, height) && complete;
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, h->depth);
    complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && complete;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (complete && glGetError() == GL_NO_ERROR) {
        h->width = width;
        h->height = height;
        return true;
    }
    *trouble_out = "the device has no memory, or no format, for the picture of hollows";
    buffers_close(h);
    return false;
}

void hollow_begin(const hollow &h)
{
    constexpr GLuint nothing[4] = {0, 0, 65535, 0};
    glBindFramebuffer(GL_FRAMEBUFFER, h.relief.framebuffer);
    glViewport(0, 0, h.width, h.height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glClearBufferuiv(GL_COLOR, 0, nothing);
    glClearDepthf(1);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void hollow_end(const hollow &h, const projection &p, double reach_mm, double widest_pixels, int taps,
                const glm::vec2 &origin)
{
    const GLenum depth = GL_DEPTH_ATTACHMENT;
    glInvalidateFramebuffer(GL_FRAMEBUFFER, 1, &depth);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(h.empty_array);
    glActiveTexture(GL_TEXTURE0);
    const glm::dmat4 &c = p.clip_from_eye;
    glBindFramebuffer(GL_FRAMEBUFFER, h.hidden.framebuffer);
    glUseProgram(h.hidden_program);
    glUniform2f(h.depth_range, static_cast<float>(p.near_mm), static_cast<float>(p.far_mm));
    glUniform4f(h.clip, static_cast<float>(c[0][0]), static_cast<float>(c[1][1]), static_cast<float>(c[2][0]),
                static_cast<float>(c[2][1]));
    glUniform2f(h.reach, static_cast<float>(reach_mm), static_cast<float>(widest_pixels / 2));
    glUniform1i(h.taps, taps);
    glUniform2i(h.origin, static_cast<GLint>(origin.x) / 2, static_cast<GLint>(origin.y) / 2);
    glBindTexture(GL_TEXTURE_2D, h.relief.texture);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindFramebuffer(GL_FRAMEBUFFER, h.smoothed.framebuffer);
    glUseProgram(h.smoothed_program);
    glBindTexture(GL_TEXTURE_2D, h.hidden.texture);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindTexture(GL_TEXTURE_2D, 0);
    glBindVertexArray(0);
    glEnable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}
