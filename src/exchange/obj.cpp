/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/obj.h"

#include "exchange/outlet.h"

namespace {

constexpr int colour_digits = 5; /* an 8-bit channel needs three; five leave a reader's rounding harmless */

void vertices(outlet &o, const mesh_file &f)
{
    for (uint32_t n = 0; n < f.of->vertex_count; n++) {
        float position[3];
        mesh_file_position(f, n, position);
        outlet_text(o, "v");
        for (float x : position) {
            outlet_text(o, " ");
            outlet_decimal(o, x);
        }
        for (int c = 0; c < 3; c++) {
            outlet_text(o, " ");
            outlet_decimal(o, static_cast<float>(colour_channel(f.of->vertices[n].rgba, c)) / 255.0f, colour_digits);
        }
        outlet_text(o, "\n");
    }
}

void normals(outlet &o, const mesh_file &f)
{
    for (uint32_t n = 0; n < f.of->vertex_count; n++) {
        outlet_text(o, "vn");
        for (float x : f.of->vertices[n].normal) {
            outlet_text(o, " ");
            outlet_decimal(o, x);
        }
        outlet_text(o, "\n");
    }
}

void faces(outlet &o, const mesh_file &f)
{
    for (uint32_t t = 0; t < f.of->triangle_count; t++) {
        outlet_text(o, "f");
        for (int c = 0; c < 3; c++) {
            const uint64_t number = uint64_t{f.of->triangles[t][c]} + 1;
            outlet_text(o, " ");
            outlet_integer(o, number);
            outlet_text(o, "//");
            outlet_integer(o, number);
        }
        outlet_text(o, "\n");
    }
}

} // namespace

status obj_write(const mesh_file &f, checkpoint_sink sink, void *self)
{
    const status refusal = mesh_file_check(f);
    if (refusal != STATUS_OK)
        return refusal;
    outlet o;
    outlet_begin(o, sink, self);
    outlet_text(o, "# glaise, millimetres\no ");
    outlet_text(o, mesh_file_name(f));
    outlet_text(o, "\n");
    vertices(o, f);
    normals(o, f);
    faces(o, f);
    return outlet_end(o);
}
