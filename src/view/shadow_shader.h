/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The fragment stage that writes depth and no colour.
 * Is not:  The lookup (lighting_shader.h). The vertex stage is patch_shader.h.
 * Units:   depth of the clip volume.
 */
#ifndef GLAISE_VIEW_SHADOW_SHADER_H
#define GLAISE_VIEW_SHADOW_SHADER_H

inline constexpr char shadow_shader_fragment[] = "void main() {}\n";

#endif
