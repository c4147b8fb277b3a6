/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/stl.h"

#include "exchange/outlet.h"

#include <cmath>

namespace {

constexpr size_t header_bytes = 80;
constexpr std::string_view header_text = "glaise, binary STL, millimetres";
static_assert(header_text.size() < header_bytes);

void facet_normal(const float corner[3][3], float out[3])
{
    double u[3], v[3];
    for (int c = 0; c < 3; c++) {
        u[c] = static_cast<double>(corner[1][c]) - corner[0][c];
        v[c] = static_cast<double>(corner[2][c]) - corner[0][c];
    }
    const double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int c = 0; c < 3; c++)
        out[c] = length > 0 ? static_cast<float>(n[c] / length) : 0.0f;
}

} // namespace

status stl_write(const mesh_file &f, checkpoint_sink sink, void *self)
{
    const status refusal = mesh_file_check(f);
    if (refusal != STATUS_OK)
        return refusal;
    outlet o;
    outlet_begin(o, sink, self);
    outlet_text(o, header_text);
    for (size_t n = header_text.size(); n < header_bytes; n++)
        outlet_u8(o, 0);
    outlet_u32(o, f.of->triangle_count);
    for (uint32_t t = 0; t < f.of->triangle_count; t++) {
        float corner[3][3], normal[3];
        for (int n = 0; n < 3; n++)
            mesh_file_position(f, f.of->triangles[t][n], corner[n]);
        facet_normal(corner, normal);
        for (float x : normal)
            outlet_f32(o, x);
        for (const float(&p)[3] : corner)
            for (float x : p)
                outlet_f32(o, x);
        outlet_u8(o, 0);
        outlet_u8(o, 0);
    }
    return outlet_end(o);
}
