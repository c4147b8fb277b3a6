/* SPDX-License-Identifier: Apache-2.0 */
#include "view/canvas.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace {

int integer(GLenum what)
{
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

/* As many samples as the colour format has on this machine, CANVAS_SAMPLES at most. */
int samples_here()
{
    GLint most = 0;
    glGetInternalformativ(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, GL_SAMPLES, 1, &most); /* given in falling order */
    return std::clamp(std::min(most, integer(GL_MAX_SAMPLES)), 0, static_cast<int>(CANVAS_SAMPLES));
}

bool fits(int width, int height, std::string *trouble_out)
{
    GLint viewport[2] = {0, 0};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    int side = std::min({static_cast<int>(CANVAS_SIDE_MAX), integer(GL_MAX_RENDERBUFFER_SIZE),
                         integer(GL_MAX_TEXTURE_SIZE), viewport[0], viewport[1]});
    std::string size = std::to_string(width) + " x " + std::to_string(height);
    if (width < 1 || height < 1 || width > side || height > side) {
        *trouble_out =
            "a picture of " + size + " pixels cannot be drawn: each side must be 1 to " + std::to_string(side);
        return false;
    }
    if (int64_t{width} * height > CANVAS_PIXELS_MAX) {
        *trouble_out = "a picture of " + size + " pixels cannot be drawn: at most " +
                       std::to_string(CANVAS_PIXELS_MAX) + " pixels";
        return false;
    }
    return true;
}

void make_drawn(canvas *c)
{
    glGenRenderbuffers(1, &c->colour);
    glBindRenderbuffer(GL_RENDERBUFFER, c->colour);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, c->samples, GL_SRGB8_ALPHA8, c->width, c->height);
    glGenRenderbuffers(1, &c->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, c->depth);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, c->samples, GL_DEPTH_COMPONENT24, c->width, c->height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glGenFramebuffers(1, &c->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, c->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, c->colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, c->depth);
}

void make_resolved(canvas *c)
{
    glGenTextures(1, &c->texture);
    glBindTexture(GL_TEXTURE_2D, c->texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, c->width, c->height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &c->resolve_framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, c->resolve_framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, c->texture, 0);
}

/* Of the framebuffer that is bound now. */
bool is_complete() { return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE; }

} // namespace

bool canvas_size(canvas *c, int width, int height, std::string *trouble_out)
{
    if (c->framebuffer != 0 && c->width == width && c->height == height)
        return true;
    canvas_close(c);
    if (!fits(width, height, trouble_out))
        return false;
    while (glGetError() != GL_NO_ERROR) {
    }
    c->width = width;
    c->height = height;
    c->samples = samples_here();
    make_drawn(c);
    bool complete = is_complete();
    make_resolved(c);
    complete = is_complete() && complete;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    GLenum error = glGetError();
    if (complete && error == GL_NO_ERROR)
        return true;
    *trouble_out = "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels cannot be drawn: " +
                   (error == GL_OUT_OF_MEMORY ? "the device has no memory for it" : "the device refuses its format");
    canvas_close(c);
    return false;
}

void canvas_close(canvas *c)
{
    if (c->framebuffer != 0) {
        glDeleteFramebuffers(1, &c->framebuffer);
        glDeleteFramebuffers(1, &c->resolve_framebuffer);
        glDeleteRenderbuffers(1, &c->colour);
        glDeleteRenderbuffers(1, &c->depth);
        glDeleteTextures(1, &c->texture);
    }
    *c = canvas{};
}

void canvas_begin(canvas *c)
{
    assert(c->framebuffer != 0);
    glBindFramebuffer(GL_FRAMEBUFFER, c->framebuffer);
    glViewport(0, 0, c->width, c->height);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glClearDepthf(1.0f);
    /* The backdrop covers every pixel; but a tiler that is not told the colour is new reads the old one back. */
    const GLenum old = GL_COLOR_ATTACHMENT0;
    glInvalidateFramebuffer(GL_FRAMEBUFFER, 1, &old);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void canvas_end(canvas *c)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, c->framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, c->resolve_framebuffer);
    glBlitFramebuffer(0, 0, c->width, c->height, 0, 0, c->width, c->height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    const GLenum done[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    glInvalidateFramebuffer(GL_READ_FRAMEBUFFER, 2, done);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    c->resolved = true;
}

bool canvas_read(const canvas *c, std::vector<uint8_t> *rgba_out, std::string *trouble_out)
{
    if (!c->resolved) {
        *trouble_out = "there is no picture to read: nothing was drawn";
        return false;
    }
    const size_t row = static_cast<size_t>(c->width) * 4;
    const size_t rows = static_cast<size_t>(c->height);
    rgba_out->resize(row * rows);
    while (glGetError() != GL_NO_ERROR) {
    }
    glBindFramebuffer(GL_FRAMEBUFFER, c->resolve_framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, c->width, c->height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_out->data());
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (glGetError() != GL_NO_ERROR) {
        *trouble_out = "the picture cannot be read back from the device";
        return false;
    }
    for (size_t low = 0, high = rows - 1; low < high; low++, high--) /* OpenGL has the bottom row first */
        std::swap_ranges(rgba_out->begin() + static_cast<ptrdiff_t>(low * row),
                         rgba_out->begin() + static_cast<ptrdiff_t>((low + 1) * row),
                         rgba_out->begin() + static_cast<ptrdiff_t>(high * row));
    return true;
}
