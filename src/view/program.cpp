/* SPDX-License-Identifier: Apache-2.0 */
#include "view/program.h"

#include <cassert>

namespace {

constexpr char preamble[] = R"(#version 310 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp isampler2D;
)";

std::string trimmed(std::string text)
{
    while (!text.empty() && (text.back() == '\n' || text.back() == '\0' || text.back() == ' '))
        text.pop_back();
    return text.empty() ? "no words from the compiler" : text;
}

std::string shader_words(GLuint shader)
{
    GLint length = 0;
    glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    std::string words(static_cast<size_t>(length > 0 ? length : 0), '\0');
    if (length > 0)
        glGetShaderInfoLog(shader, length, nullptr, words.data());
    return trimmed(words);
}

std::string program_words(GLuint program)
{
    GLint length = 0;
    glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    std::string words(static_cast<size_t>(length > 0 ? length : 0), '\0');
    if (length > 0)
        glGetProgramInfoLog(program, length, nullptr, words.data());
    return trimmed(words);
}

/* 0 and a trouble when it does not compile. */
GLuint compile(const char *name, const char *stage, GLenum kind, const program_text &text, std::string *trouble_out)
{
    GLuint shader = glCreateShader(kind);
    if (shader == 0) {
        *trouble_out = std::string(name) + ", " + stage + " shader: OpenGL gives no shader (is a context current?)";
        return 0;
    }
    program_text parts{preamble};
    parts.insert(parts.end(), text.begin(), text.end());
    glShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
    glCompileShader(shader);
    GLint done = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (done == GL_TRUE)
        return shader;
    *trouble_out = std::string(name) + ", " + stage + " shader does not compile: " + shader_words(shader);
    glDeleteShader(shader);
    return 0;
}

} // namespace

bool program_open(const char *name, const program_text &vertex, const program_text &fragment, GLuint *program_out,
                  std::string *trouble_out)
{
    *program_out = 0;
    GLuint first = compile(name, "vertex", GL_VERTEX_SHADER, vertex, trouble_out);
    if (first == 0)
        return false;
    GLuint second = compile(name, "fragment", GL_FRAGMENT_SHADER, fragment, trouble_out);
    if (second == 0) {
        glDeleteShader(first);
        return false;
    }
    GLuint program = glCreateProgram();
    glAttachShader(program, first);
    glAttachShader(program, second);
    glLinkProgram(program);
    glDeleteShader(first);
    glDeleteShader(second);
    GLint done = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done != GL_TRUE) {
        *trouble_out = std::string(name) + " does not link: " + program_words(program);
        glDeleteProgram(program);
        return false;
    }
    *program_out = program;
    return true;
}

void program_close(GLuint program)
{
    if (program != 0)
        glDeleteProgram(program);
}

GLint program_uniform(GLuint program, const char *name)
{
    GLint place = glGetUniformLocation(program, name);
    assert(place >= 0);
    return place;
}
