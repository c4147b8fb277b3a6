/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A GLSL program: texts in, a linked program out, or the words of the compiler. Every text is given the same
 *          first lines (version, precision), so that shader headers hold only what differs.
 * Is not:  The texts (clay_shader.h and its like); who draws with them.
 * Owner:   the caller owns the OpenGL name; the context must be current.
 * Errors:  program_open false: nothing is left in OpenGL, the trouble holds the program's name, the stage, and the
 *          compiler's own words.
 * Cost:    milliseconds: compile at opening, never in a frame.
 */
#ifndef GLAISE_VIEW_PROGRAM_H
#define GLAISE_VIEW_PROGRAM_H

#include <GLES3/gl31.h>

#include <string>
#include <vector>

/* Parts of one stage, joined in order. */
using program_text = std::vector<const char *>;

[[nodiscard]] bool program_open(const char *name, const program_text &vertex, const program_text &fragment,
                                GLuint *program_out, std::string *trouble_out);
/* 0 is fine. */
void program_close(GLuint program);

/* Place of a uniform; asserts that the program has it: a name that no longer fits its shader is our bug. */
GLint program_uniform(GLuint program, const char *name);

#endif
