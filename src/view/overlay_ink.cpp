/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay_ink.h"

#include "view/colour_shader.h"
#include "view/overlay_shader.h"
#include "view/program.h"

#include <cstddef>

bool overlay_ink_open(overlay_ink *k, std::string *trouble_out)
{
    if (!program_open("overlay", {colour_shader_text, overlay_shader_vertex}, {overlay_shader_fragment}, &k->program,
                      trouble_out))
        return false;
    k->scale = program_uniform(k->program, "u_scale");
    k->shift = program_uniform(k->program, "u_shift");
    glUseProgram(k->program);
    glUniform1i(program_uniform(k->program, "u_letters"), 0);
    glUseProgram(0);
    glGenVertexArrays(1, &k->array);
    glGenBuffers(1, &k->vertices);
    glGenBuffers(1, &k->indices);
    glBindVertexArray(k->array);
    glBindBuffer(GL_ARRAY_BUFFER, k->vertices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, k->indices);
    const auto at = [](size_t offset) { return reinterpret_cast<const void *>(offset); };
    const auto stride = static_cast<GLsizei>(sizeof(ImDrawVert));
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, pos)));
    glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, at(offsetof(ImDrawVert, uv)));
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, at(offsetof(ImDrawVert, col)));
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
    return true;
}

void overlay_ink_close(overlay_ink *k)
{
    program_close(k->program);
    if (k->array != 0) {
        glDeleteVertexArrays(1, &k->array);
        glDeleteBuffers(1, &k->vertices);
        glDeleteBuffers(1, &k->indices);
        glDeleteTextures(1, &k->letters);
    }
    *k = overlay_ink{};
}

void overlay_ink_letters(overlay_ink *k, const uint8_t *coverage, int width, int height)
{
    glDeleteTextures(1, &k->letters);
    glGenTextures(1, &k->letters);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, k->letters);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R8, width, height);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, coverage);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void overlay_ink_draw(const overlay_ink &k, const ImDrawData *data, const overlay_ink_fit &fit)
{
    static_assert(sizeof(ImDrawIdx) == 2);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(k.program);
    const double w = fit.width, h = fit.height;
    glUniform2f(k.scale, static_cast<float>(2 * fit.times_x / w), static_cast<float>(-2 * fit.times_y / h));
    glUniform2f(k.shift, static_cast<float>(2 * fit.plus_x / w - 1), static_cast<float>(1 - 2 * fit.plus_y / h));
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, k.letters);
    glBindVertexArray(k.array);
    glBindBuffer(GL_ARRAY_BUFFER, k.vertices);
    for (int n = 0; n < data->CmdListsCount; n++) {
        const ImDrawList &list = *data->CmdLists[n];
        glBufferData(GL_ARRAY_BUFFER, list.VtxBuffer.Size * static_cast<GLsizeiptr>(sizeof(ImDrawVert)),
                     list.VtxBuffer.Data, GL_STREAM_DRAW);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.Size * static_cast<GLsizeiptr>(sizeof(ImDrawIdx)),
                     list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd &c : list.CmdBuffer)
            glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(c.ElemCount), GL_UNSIGNED_SHORT,
                           reinterpret_cast<const void *>(c.IdxOffset * sizeof(ImDrawIdx)));
    }
    glBindVertexArray(0);
    glBindBuffer(GL_ARRAY_BUFFER, 0);
    glBindTexture(GL_TEXTURE_2D, 0);
    glUseProgram(0);
    glDisable(GL_BLEND);
}
