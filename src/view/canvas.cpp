/* SPDX-License-Identifier: Apache-2.0 */
#include "view/canvas.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

namespace {

int integer(GLenum what)
{
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

void make_drawn(canvas *c)
{
    glGenRenderbuffers(1, &c->colour);
    glBindRenderbuffer(GL_RENDERBUFFER, c->colour);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, c->samples, GL_SRGB8_ALPHA8, c->width, c->height);
    glGenRenderbuffers(1, &c->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, c->depth);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, c->samples, GL_DEPTH24_STENCIL8, c->width, c->height);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glGenFramebuffers(1, &c->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, c->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, c->colour);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, c->depth);
}

void make_target(canvas_target *t)
{
    glGenTextures(1, &t->texture);
    glBindTexture(GL_TEXTURE_2D, t->texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_SRGB8_ALPHA8, t->width, t->height);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
    glGenFramebuffers(1, &t->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, t->framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t->texture, 0);
}

/* Of the framebuffer that is bound now; unbinds it. */
bool is_complete(int width, int height, std::string *trouble_out)
{
    const bool complete = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    const GLenum error = glGetError();
    if (complete && error == GL_NO_ERROR)
        return true;
    *trouble_out = "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels cannot be drawn: " +
                   (error == GL_OUT_OF_MEMORY ? "the device has no memory for it" : "the device refuses its format");
    return false;
}

void errors_drop()
{
    while (glGetError() != GL_NO_ERROR) {
    }
}

} // namespace

bool canvas_fits(int width, int height, std::string *trouble_out)
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

int canvas_samples_here(int wanted)
{
    std::array<GLint, 16> counts{}; /* in falling order, then zeros */
    glGetInternalformativ(GL_RENDERBUFFER, GL_SRGB8_ALPHA8, GL_SAMPLES, counts.size(), counts.data());
    const int most = std::min(wanted, static_cast<int>(CANVAS_SAMPLES));
    return *std::find_if(counts.begin(), counts.end() - 1, [most](GLint n) { return n <= most; });
}

bool canvas_size(canvas *c, int width, int height, int samples, std::string *trouble_out)
{
    if (c->framebuffer != 0 && c->width == width && c->height == height && c->wanted == samples)
        return true;
    canvas_close(c);
    if (!canvas_fits(width, height, trouble_out))
        return false;
    errors_drop();
    *c = {width, height, canvas_samples_here(samples), samples, 0, 0, 0};
    make_drawn(c);
    if (is_complete(width, height, trouble_out))
        return true;
    canvas_close(c);
    return false;
}

void canvas_close(canvas *c)
{
    if (c->framebuffer != 0) {
        glDeleteFramebuffers(1, &c->framebuffer);
        glDeleteRenderbuffers(1, &c->colour);
        glDeleteRenderbuffers(1, &c->depth);
    }
    *c = canvas{};
}

bool canvas_target_size(canvas_target *t, int width, int height, std::string *trouble_out)
{
    if (t->framebuffer != 0 && t->width == width && t->height == height)
        return true;
    canvas_target_close(t);
    if (!canvas_fits(width, height, trouble_out))
        return false;
    errors_drop();
    *t = {width, height, 0, 0};
    make_target(t);
    if (is_complete(width, height, trouble_out))
        return true;
    canvas_target_close(t);
    return false;
}

void canvas_target_close(canvas_target *t)
{
    if (t->framebuffer != 0) {
        glDeleteFramebuffers(1, &t->framebuffer);
        glDeleteTextures(1, &t->texture);
    }
    *t = canvas_target{};
}

void canvas_begin(const canvas &c)
{
    assert(c.framebuffer != 0);
    glBindFramebuffer(GL_FRAMEBUFFER, c.framebuffer);
    glViewport(0, 0, c.width, c.height);
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glClearDepthf(1.0f);
    /* The backdrop covers every pixel; but a tiler that is not told the colour is new reads the old one back. */
    const GLenum old = GL_COLOR_ATTACHMENT0;
    glInvalidateFramebuffer(GL_FRAMEBUFFER, 1, &old);
    glClearStencil(0);
    glStencilMask(0xff);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void canvas_end(const canvas &c, const canvas_target &into)
{
    assert(into.width == c.width && into.height == c.height);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, c.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, into.framebuffer);
    glBlitFramebuffer(0, 0, c.width, c.height, 0, 0, c.width, c.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    const GLenum done[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT};
    glInvalidateFramebuffer(GL_READ_FRAMEBUFFER, 2, done);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void canvas_copy(const canvas_target &from, const canvas_target &into)
{
    glBindFramebuffer(GL_READ_FRAMEBUFFER, from.framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, into.framebuffer);
    glBlitFramebuffer(0, 0, from.width, from.height, 0, 0, into.width, into.height, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

bool canvas_read(const canvas_target &t, std::vector<uint8_t> *rgba_out, std::string *trouble_out)
{
    if (t.framebuffer == 0) {
        *trouble_out = "there is no picture to read: nothing was drawn";
        return false;
    }
    const size_t row = static_cast<size_t>(t.width) * 4;
    const size_t rows = static_cast<size_t>(t.height);
    rgba_out->resize(row * rows);
    errors_drop();
    glBindFramebuffer(GL_FRAMEBUFFER, t.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, t.width, t.height, GL_RGBA, GL_UNSIGNED_BYTE, rgba_out->data());
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
