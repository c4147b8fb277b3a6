/* SPDX-License-Identifier: Apache-2.0 */
/* What upload's tests stand on: patches made by hand, the device's memory read back as it would draw it, and a device
 * that can be made to lag behind, to refuse memory, and to tell when it is waited for. */
#ifndef GLAISE_TESTS_UPLOAD_DEVICE_H
#define GLAISE_TESTS_UPLOAD_DEVICE_H

#include "view/upload.h"

#include <array>
#include <map>
#include <tuple>
#include <vector>

/* --- what is drawn --- */

struct upload_device_corner {
    std::array<uint16_t, 3> place;
    std::array<int16_t, 2> normal;
    uint32_t rgba;
    auto operator<=>(const upload_device_corner &) const = default;
};
using upload_device_triangle = std::array<upload_device_corner, 3>;
using upload_device_brick = std::tuple<int32_t, int32_t, int32_t>;
/* Triangles by the brick they are drawn in, in the order they are drawn. */
using upload_device_drawing = std::map<upload_device_brick, std::vector<upload_device_triangle>>;

/* One call: what the device is told to draw with; it may carry it out later. */
struct upload_device_call {
    GLuint vertices, triangles, table;
    int units;
};
std::vector<upload_device_call> upload_device_calls(const upload &u);
/* Carries them out now, on the memory as it is now. A triangle is dropped where the shader drops it: when all its
   corners lie nowhere. One that lies half somewhere, or in two bricks, is a failure. */
upload_device_drawing upload_device_draw(const std::vector<upload_device_call> &calls);

/* What should be drawn of a patch, and of a surface. */
std::vector<upload_device_triangle> upload_device_triangles(const patch &p);
upload_device_drawing upload_device_expected(const surface &s);
inline upload_device_brick upload_device_at(const patch &p) { return {p.at.i, p.at.j, p.at.k}; }

/* --- how the device behaves: this program's own OpenGL calls pass by here --- */

struct upload_device_conduct {
    size_t frames_behind = 0; /* the last so many fences have not passed */
    bool refuses_maps = false;
    int waits = 0;            /* calls that may have waited: see upload_device.cpp */
};
extern upload_device_conduct upload_device;

/* --- patches by hand --- */

/* Patch n lies in brick (n, 0, 0) and has as many triangles as thirds of vertices; each number `look` gives other
   bytes. */
struct upload_device_surface {
    surface it;
    std::vector<std::vector<patch_vertex>> vertices;
    std::vector<std::vector<std::array<uint16_t, 3>>> triangles;

    upload_device_surface(uint32_t count, uint32_t vertices_each);
    ~upload_device_surface();
    upload_device_surface(const upload_device_surface &) = delete;
    upload_device_surface &operator=(const upload_device_surface &) = delete;

    patch *at(uint32_t n);
    void change(uint32_t n, uint32_t vertex_count);
    void change_vertex(uint32_t n, uint32_t vertex);
    void remove(uint32_t n);
};

#endif
