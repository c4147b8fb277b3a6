/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The light of one picture, and how it is handed to a program that was built with lighting_shader.h.
 * Is not:  Where shadows and hollows come from (shadow.h, hollow.h).
 * Shape:   textures lie in units of their own, the same in every program: LIGHTING_UNIT_...
 * Units:   millimetres, eye space.
 * Owner:   refers into what it was made of.
 */
#ifndef GLAISE_VIEW_LIGHTING_H
#define GLAISE_VIEW_LIGHTING_H

#include "view/projection.h"
#include "view/scenery.h"
#include "view/shadow.h"

/* 0 is the bricks' table: upload.h. */
enum {
    LIGHTING_UNIT_MIRROR = 1,
    LIGHTING_UNIT_ROUGH,
    LIGHTING_UNIT_SHADOW,
    LIGHTING_UNIT_SHADOW_BARE,
    LIGHTING_UNIT_HOLLOW,
    LIGHTING_UNITS,
};

/* The raking look's one lamp, with the viewer: from the left, grazing, so far out that its rays are parallel. */
constexpr glm::dvec3 LIGHTING_RAKING{-0.956, 0.271, 0.115};
constexpr double LIGHTING_RAKING_DISTANCE = 40; /* of the camera's */
constexpr float LIGHTING_RAKING_STRENGTH = 1.6f;

struct lighting_lamps {
    GLint count = 0; /* lit ones, in the snapshot's order */
    std::array<glm::vec3, SNAPSHOT_LIGHTS> place{}, colour{};
};

struct lighting {
    lighting_lamps lamps;
    const struct scenery *scenery = nullptr;
    const struct shadow *shadow = nullptr;
    glm::dmat4 mono_from_eye{1}; /* of an eye beside the one that lamps and shadows were made for */
    shadow_sight sight;
    int shadow_taps = 0; /* 0: no shadows */
    GLuint hollow = 0;
    float hollow_strength = 0; /* 0: none */
    double near_mm = 0, far_mm = 1;
    glm::vec2 origin{0}; /* of this part of the picture, from the whole's lower left corner, pixels */
};

struct lighting_uniforms {
    GLint count = -1, place = -1, colour = -1, irradiance = -1, origin = -1;
    GLint shadow_taps = -1, shadow_from_eye = -1, shadow = -1;
    GLint hollow_strength = -1, depth_range = -1;
};

lighting_lamps lighting_lamps_of(const snapshot &s, const glm::dmat4 &eye_from_world);
/* Asserts that the program has them all, and tells it its units. */
lighting_uniforms lighting_find(GLuint program);
/* Of the program in use. */
void lighting_set(const lighting_uniforms &at, const lighting &light);
/* Binds the textures, once a picture, for all programs. */
void lighting_bind(const lighting &light);
void lighting_release();

#endif
