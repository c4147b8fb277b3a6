/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/ply.h"

#include "exchange/outlet.h"

namespace {

void header(outlet &o, const mesh_file &f)
{
    outlet_text(o, "ply\nformat binary_little_endian 1.0\ncomment glaise, millimetres\ncomment ");
    outlet_text(o, mesh_file_name(f));
    outlet_text(o, "\nelement vertex ");
    outlet_integer(o, f.of->vertex_count);
    for (const char *property : {"x", "y", "z", "nx", "ny", "nz"}) {
        outlet_text(o, "\nproperty float ");
        outlet_text(o, property);
    }
    for (const char *property : {"red", "green", "blue", "alpha"}) {
        outlet_text(o, "\nproperty uchar ");
        outlet_text(o, property);
    }
    outlet_text(o, "\nelement face ");
    outlet_integer(o, f.of->triangle_count);
    outlet_text(o, "\nproperty list uchar int vertex_indices\nend_header\n");
}

} // namespace

status ply_write(const mesh_file &f, checkpoint_sink sink, void *self)
{
    const status refusal = mesh_file_check(f);
    if (refusal != STATUS_OK)
        return refusal;
    outlet o;
    outlet_begin(o, sink, self);
    header(o, f);
    for (uint32_t n = 0; n < f.of->vertex_count; n++) {
        const mesh_vertex &v = f.of->vertices[n];
        float position[3];
        mesh_file_position(f, n, position);
        for (float x : position)
            outlet_f32(o, x);
        for (float x : v.normal)
            outlet_f32(o, x);
        for (int c = 0; c < 4; c++)
            outlet_u8(o, colour_channel(v.rgba, c));
    }
    for (uint32_t t = 0; t < f.of->triangle_count; t++) {
        outlet_u8(o, 3);
        for (int c = 0; c < 3; c++)
            outlet_u32(o, f.of->triangles[t][c]);
    }
    return outlet_end(o);
}
