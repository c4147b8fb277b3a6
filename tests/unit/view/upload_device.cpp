/* SPDX-License-Identifier: Apache-2.0 */
#include "upload_device.h"

#include <EGL/egl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

upload_device_conduct upload_device;

/* --- the calls that pass by here: the linker finds these before the library's --- */

namespace {

std::vector<GLsync> &fences()
{
    static std::vector<GLsync> made; /* oldest first */
    return made;
}

template <typename F> F theirs(const char *name) { return reinterpret_cast<F>(eglGetProcAddress(name)); }

} // namespace

extern "C" {

GLsync glFenceSync(GLenum condition, GLbitfield flags)
{
    static const auto next = theirs<GLsync (*)(GLenum, GLbitfield)>("glFenceSync");
    fences().push_back(next(condition, flags));
    return fences().back();
}

void glDeleteSync(GLsync sync)
{
    static const auto next = theirs<void (*)(GLsync)>("glDeleteSync");
    fences().erase(std::remove(fences().begin(), fences().end(), sync), fences().end());
    next(sync);
}

/* A device that is not behind has done with everything: that makes the tests the same on all machines. */
GLenum glClientWaitSync(GLsync sync, GLbitfield flags, GLuint64 timeout)
{
    static const auto next = theirs<GLenum (*)(GLsync, GLbitfield, GLuint64)>("glClientWaitSync");
    upload_device.waits += timeout > 0;
    const auto at = std::find(fences().begin(), fences().end(), sync);
    if (static_cast<size_t>(fences().end() - at) <= upload_device.frames_behind)
        return GL_TIMEOUT_EXPIRED;
    return next(sync, flags, ~GLuint64{0});
}

void *glMapBufferRange(GLenum target, GLintptr at, GLsizeiptr bytes, GLbitfield access)
{
    static const auto next = theirs<void *(*)(GLenum, GLintptr, GLsizeiptr, GLbitfield)>("glMapBufferRange");
    if (access & GL_MAP_WRITE_BIT) {
        upload_device.waits += !(access & GL_MAP_UNSYNCHRONIZED_BIT);
        if (upload_device.refuses_maps)
            return nullptr;
    }
    return next(target, at, bytes, access);
}

void glBufferSubData(GLenum target, GLintptr at, GLsizeiptr bytes, const void *from)
{
    static const auto next = theirs<void (*)(GLenum, GLintptr, GLsizeiptr, const void *)>("glBufferSubData");
    upload_device.waits++;
    next(target, at, bytes, from);
}

void glCopyBufferSubData(GLenum from, GLenum to, GLintptr from_at, GLintptr to_at, GLsizeiptr bytes)
{
    static const auto next =
        theirs<void (*)(GLenum, GLenum, GLintptr, GLintptr, GLsizeiptr)>("glCopyBufferSubData");
    upload_device.waits++;
    next(from, to, from_at, to_at, bytes);
}

void glFinish()
{
    static const auto next = theirs<void (*)()>("glFinish");
    upload_device.waits++;
    next();
}

} // extern "C"

/* --- what is drawn --- */

namespace {

template <typename T> std::vector<T> read_buffer(GLuint name, size_t count)
{
    std::vector<T> out(count);
    glBindBuffer(GL_COPY_READ_BUFFER, name);
    const void *from =
        glMapBufferRange(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(T)), GL_MAP_READ_BIT);
    EXPECT_NE(from, nullptr);
    if (from)
        std::memcpy(out.data(), from, count * sizeof(T));
    glUnmapBuffer(GL_COPY_READ_BUFFER);
    return out;
}

std::vector<std::array<GLint, 4>> read_table(GLuint name)
{
    std::vector<std::array<GLint, 4>> out(BERTH_UNITS);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, name, 0);
    glReadPixels(0, 0, BERTH_UNITS, 1, GL_RGBA_INTEGER, GL_INT, out.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glDeleteFramebuffers(1, &framebuffer);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return out;
}

upload_device_corner corner_of(const packed_vertex &v)
{
    return {{v.place[0], v.place[1], v.place[2]}, {v.normal[0], v.normal[1]}, v.rgba};
}

void draw_call(const upload_device_call &call, upload_device_drawing *out)
{
    const auto vertices = read_buffer<packed_vertex>(call.vertices, size_t{BERTH_UNITS} * PACKED_UNIT_VERTICES);
    const auto indices = read_buffer<std::array<uint16_t, 3>>(call.triangles,
                                                              static_cast<size_t>(call.units) * PACKED_UNIT_TRIANGLES);
    const auto table = read_table(call.table);
    for (const std::array<uint16_t, 3> &t : indices) {
        if (t[0] == t[1] || t[1] == t[2])
            continue;
        ASSERT_LT(vertices[t[0]].unit, BERTH_UNITS);
        const auto brick = table[vertices[t[0]].unit];
        for (const uint16_t v : t)
            ASSERT_EQ(vertices[v].unit, vertices[t[0]].unit) << "a triangle across two patches";
        if (brick[0] == PAGE_NOWHERE.i && brick[1] == PAGE_NOWHERE.j && brick[2] == PAGE_NOWHERE.k)
            continue;
        (*out)[{brick[0], brick[1], brick[2]}].push_back(
            {corner_of(vertices[t[0]]), corner_of(vertices[t[1]]), corner_of(vertices[t[2]])});
    }
}

} // namespace

std::vector<upload_device_call> upload_device_calls(const upload &u)
{
    std::vector<upload_device_call> calls;
    for (const page &p : u.pages)
        if (p.drawn > 0)
            calls.push_back({p.buffers[0], p.buffers[1], p.tables[static_cast<size_t>(p.table)].texture, p.drawn});
    return calls;
}

upload_device_drawing upload_device_draw(const std::vector<upload_device_call> &calls)
{
    upload_device_drawing out;
    for (const upload_device_call &call : calls)
        draw_call(call, &out);
    return out;
}

std::vector<upload_device_triangle> upload_device_triangles(const patch &p)
{
    packed made;
    packed_make(&made, p, 0, packed_units(p, false), false);
    std::vector<upload_device_triangle> out;
    for (uint32_t t = 0; t < p.triangle_count; t++)
        out.push_back({corner_of(made.vertices[p.triangles[t][0]]), corner_of(made.vertices[p.triangles[t][1]]),
                       corner_of(made.vertices[p.triangles[t][2]])});
    return out;
}

upload_device_drawing upload_device_expected(const surface &s)
{
    upload_device_drawing out;
    for (uint32_t n = 0; n < surface_slots(&s); n++) {
        const patch *p = surface_patch(&s, n);
        if (p && p->triangle_count > 0)
            out[upload_device_at(*p)] = upload_device_triangles(*p);
    }
    return out;
}

/* --- patches by hand --- */

upload_device_surface::upload_device_surface(uint32_t count, uint32_t vertices_each)
    : vertices(count), triangles(count)
{
    std::memset(&it, 0, sizeof it);
    EXPECT_EQ(pool_init(&it.patches, sizeof(patch), count), STATUS_OK);
    for (uint32_t n = 0; n < count; n++) {
        uint32_t slot = 0;
        EXPECT_EQ(pool_take(&it.patches, &slot), STATUS_OK);
        EXPECT_EQ(slot, n);
        std::memset(pool_at(&it.patches, slot), 0, sizeof(patch));
        at(n)->at = {static_cast<int32_t>(n), 0, 0};
        change(n, vertices_each);
    }
}

upload_device_surface::~upload_device_surface() { pool_finish(&it.patches); }

patch *upload_device_surface::at(uint32_t n) { return static_cast<patch *>(pool_at(&it.patches, n)); }

void upload_device_surface::change(uint32_t n, uint32_t vertex_count)
{
    patch *p = at(n);
    p->generation = ++it.generation;
    vertices[n].assign(vertex_count, patch_vertex{});
    triangles[n].clear();
    for (uint32_t v = 0; v < vertex_count; v++) {
        vertices[n][v].rgba = static_cast<uint32_t>(p->generation * 4096 + v);
        vertices[n][v].edge = v;
        if (v % 3 == 2)
            triangles[n].push_back({static_cast<uint16_t>(v - 2), static_cast<uint16_t>(v - 1),
                                    static_cast<uint16_t>(v)});
    }
    p->vertices = vertices[n].data();
    p->vertex_count = vertex_count;
    p->triangles = reinterpret_cast<uint16_t(*)[3]>(triangles[n].data());
    p->triangle_count = static_cast<uint32_t>(triangles[n].size());
}

void upload_device_surface::change_vertex(uint32_t n, uint32_t vertex)
{
    at(n)->generation = ++it.generation;
    vertices[n][vertex].rgba++;
}

void upload_device_surface::remove(uint32_t n)
{
    at(n)->generation = ++it.generation;
    at(n)->triangle_count = 0;
}
