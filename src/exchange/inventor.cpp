/* SPDX-License-Identifier: Apache-2.0 */
#include "exchange/inventor.h"

#include "exchange/outlet.h"

namespace {

/* Clay under a lamp: a soft highlight. Shininess is Inventor's 0..1 for an exponent of 0..128; this is 40. */
constexpr std::string_view material =
    "  Material { ambientColor .2 .2 .2 specularColor .25 .25 .25 shininess .3125 }\n";

void head(outlet &o, const mesh_file &f)
{
    outlet_text(o, "#Inventor V2.1 ascii\n\nSeparator {\n  Info { string \"glaise, millimetres: ");
    outlet_text(o, mesh_file_name(f));
    outlet_text(o, "\" }\n  ShapeHints { vertexOrdering COUNTERCLOCKWISE shapeType SOLID faceType CONVEX "
                   "creaseAngle 0 }\n");
    outlet_text(o, material);
}

void colours(outlet &o, const mesh_file &f)
{
    static constexpr char digits[] = "0123456789abcdef";
    outlet_text(o, "  PackedColor { orderedRGBA [\n");
    for (uint32_t n = 0; n < f.of->vertex_count; n++) {
        char word[] = "    0x00000000,\n";
        for (int c = 0; c < 4; c++) {
            const unsigned byte = colour_channel(f.of->vertices[n].rgba, c);
            word[6 + 2 * c] = digits[byte >> 4];
            word[7 + 2 * c] = digits[byte & 15];
        }
        outlet_text(o, word);
    }
    outlet_text(o, "  ] }\n  MaterialBinding { value PER_VERTEX_INDEXED }\n");
}

void triple(outlet &o, const float p[3])
{
    outlet_text(o, "   ");
    for (int c = 0; c < 3; c++) {
        outlet_text(o, " ");
        outlet_decimal(o, p[c]);
    }
    outlet_text(o, ",\n");
}

void normals(outlet &o, const mesh_file &f)
{
    outlet_text(o, "  Normal { vector [\n");
    for (uint32_t n = 0; n < f.of->vertex_count; n++)
        triple(o, f.of->vertices[n].normal);
    outlet_text(o, "  ] }\n  NormalBinding { value PER_VERTEX_INDEXED }\n");
}

void positions(outlet &o, const mesh_file &f)
{
    outlet_text(o, "  Coordinate3 { point [\n");
    for (uint32_t n = 0; n < f.of->vertex_count; n++) {
        float position[3];
        mesh_file_position(f, n, position);
        triple(o, position);
    }
    outlet_text(o, "  ] }\n");
}

void faces(outlet &o, const mesh_file &f)
{
    outlet_text(o, "  IndexedFaceSet { coordIndex [\n");
    for (uint32_t t = 0; t < f.of->triangle_count; t++) {
        outlet_text(o, "    ");
        for (int c = 0; c < 3; c++) {
            outlet_integer(o, f.of->triangles[t][c]);
            outlet_text(o, ", ");
        }
        outlet_text(o, "-1,\n");
    }
    outlet_text(o, "  ] }\n");
}

} // namespace

status inventor_write(const mesh_file &f, checkpoint_sink sink, void *self)
{
    const status refusal = mesh_file_check(f);
    if (refusal != STATUS_OK)
        return refusal;
    outlet o;
    outlet_begin(o, sink, self);
    head(o, f);
    colours(o, f);
    normals(o, f);
    positions(o, f);
    faces(o, f);
    outlet_text(o, "}\n");
    return outlet_end(o);
}
