/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/mesh_file.h"

status mesh_file_check(const mesh_file &f)
{
    assert(f.of != nullptr);
    const mesh &m = *f.of;
    if (!(f.step_mm >= SCULPTURE_STEP_MM_MIN && f.step_mm <= SCULPTURE_STEP_MM_MAX))
        return STATUS_BAD_PARAMETER;
    if (m.triangle_count == 0)
        return STATUS_BAD_PARAMETER;
    if (m.vertex_count > MESH_FILE_COUNT_MAX || m.triangle_count > MESH_FILE_COUNT_MAX)
        return STATUS_TOO_LARGE;
    for (uint32_t t = 0; t < m.triangle_count; t++)
        for (int c = 0; c < 3; c++)
            assert(m.triangles[t][c] < m.vertex_count);
    return STATUS_OK;
}

void mesh_file_position(const mesh_file &f, uint32_t vertex, float out[3])
{
    double steps[3];
    mesh_position(&f.of->vertices[vertex], steps);
    for (int c = 0; c < 3; c++)
        out[c] = static_cast<float>(steps[c] * f.step_mm);
}

std::string mesh_file_name(const mesh_file &f)
{
    size_t n = f.name.size();
    if (n > MESH_FILE_NAME_BYTES) {
        n = MESH_FILE_NAME_BYTES;
        while (n > 0 && (static_cast<unsigned char>(f.name[n]) & 0xC0) == 0x80)
            n--;
    }
    std::string line(f.name.substr(0, n));
    bool blank = true;
    for (char &c : line) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            c = ' ';
        else if (c == '"')
            c = '\'';
        else if (c == '\\')
            c = '/';
        blank = blank && c == ' ';
    }
    return blank ? "piece" : line;
}
