/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    From a snapshot to matrices: world to eye, eye to clip, near and far planes that just hold what is drawn.
 * Is not:  The snapshot's frames of mind (station/snapshot.h); the last step to single precision (whoever draws).
 * Shape:   eye space: right-handed, the eye at the origin looking along -z, y up. Clip depth is OpenGL's, -1..1.
 *
 *              eye = (0, 0, -camera_distance) + scene_shift + scene_turn * world
 *
 *          Near is never nearer than PROJECTION_NEAR_MIN of the camera's distance: 24 bits of depth go far with that.
 * Units:   millimetres, radians; everything in double, so that a piece far out does not shake.
 * Errors:  projection_trouble says in words what is wrong with a snapshot; projection_make asserts that nothing is.
 */
#ifndef GLAISE_VIEW_PROJECTION_H
#define GLAISE_VIEW_PROJECTION_H

#include "station/snapshot.h"

#ifndef GLM_FORCE_RADIANS
#define GLM_FORCE_RADIANS
#endif
#include <glm/glm.hpp>

#include <string>
#include <vector>

constexpr double PROJECTION_NEAR_MIN = 0.02; /* of camera_distance */
constexpr double PROJECTION_FIELD_OF_VIEW_MIN = 0.02, PROJECTION_FIELD_OF_VIEW_MAX = 2.8;

struct projection {
    glm::dmat4 eye_from_world;
    glm::dmat4 clip_from_eye;
    double near_mm, far_mm;
};

/* A ball that must lie between the planes. */
struct projection_ball {
    glm::dvec3 middle_eye;
    double radius;
};

struct projection_part {
    int x, y, width, height;
};

/* Empty when the snapshot can be drawn. */
std::string projection_trouble(const snapshot &s);

glm::dmat4 projection_eye_from_world(const snapshot &s);
/* affine map of a frame: frame coordinates to the frame's outer space */
glm::dmat4 projection_of_frame(const frame &f);
/* The ball round a box given by two corners in world space. */
projection_ball projection_ball_of_box(const glm::dmat4 &eye_from_world, const glm::dvec3 &lo, const glm::dvec3 &hi);

/* Balls that are not finite are not held. */
projection projection_make(const snapshot &s, int width, int height, const std::vector<projection_ball> &held);

/* The same, for a part of the picture alone, pixels from its top left corner: parts of a picture larger than a canvas
   meet without a seam. */
projection projection_of_part(projection p, int width, int height, const projection_part &part);

/* Left for right. Front faces then wind the other way. */
projection projection_mirrored(projection p);
bool projection_is_mirrored(const projection &p);

/* Height in pixels of one millimetre, seen at a depth of `ahead` mm. */
double projection_pixels_per_mm(const snapshot &s, int height, double ahead);

#endif
