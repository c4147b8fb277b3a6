/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    All that a picture needs to know besides the sculpture itself: where the eye is, the lights, the tool, the
 *          environment, what is shown. Plain values, copied; station fills it, view reads it.
 * Is not:  The clay's patches (view takes those from the sculpture); a command.
 * Shape:   world space is right-handed, x right, y up, z towards the viewer at the start. The scene can be turned: a
 *          world point goes through scene (turn, then shift), then the camera looks at it from +z.
 *
 *              world --scene_turn, scene_shift--> turned world --camera--> eye --projection--> screen
 *
 * Units:   millimetres, radians, linear colours 0..1.
 * Owner:   the value's owner; `tool_surface` belongs to the station and outlives the snapshot's use in one frame.
 * Source:  000 sections 2 and 5.
 */
#ifndef GLAISE_STATION_SNAPSHOT_H
#define GLAISE_STATION_SNAPSHOT_H

#include "sculpture/sculpture.h"

#include <array>
#include <cstdint>

enum { SNAPSHOT_LIGHTS = 4 };

enum snapshot_environment {
    SNAPSHOT_ENVIRONMENT_NONE,
    SNAPSHOT_ENVIRONMENT_OPAQUE,    /* metal: the map alone */
    SNAPSHOT_ENVIRONMENT_SEMI,      /* a constant layer over the clay's colour */
    SNAPSHOT_ENVIRONMENT_CLEARCOAT, /* a layer that grows towards grazing angles */
};

/* Is what was made on the medium? */
enum snapshot_keeping { SNAPSHOT_KEEPING_ALL, SNAPSHOT_KEEPING_UNDER_WAY, SNAPSHOT_KEEPING_FAILS };

enum snapshot_tool_style { SNAPSHOT_TOOL_HIDDEN, SNAPSHOT_TOOL_WIREFRAME, SNAPSHOT_TOOL_TRANSPARENT };

struct snapshot_light {
    bool lit = false;
    bool with_viewer = false;         /* position is in eye space, else in world space */
    std::array<double, 3> position{}; /* mm */
    std::array<float, 3> colour{1, 1, 1};
    float strength = 1;
};

struct snapshot_material {
    float specular = 0.25f; /* 0..1 */
    float shininess = 40;   /* Blinn-Phong exponent */
    float ambient = 0.25f;
};

struct snapshot {
    std::array<double, 4> scene_turn{1, 0, 0, 0}; /* unit quaternion w, x, y, z */
    std::array<double, 3> scene_shift{};          /* mm, after the turn */
    double camera_distance = 200;                 /* mm from eye to the origin of the turned world */
    double field_of_view = 0.6;                   /* vertical */
    double step_mm = 1;                           /* of the sculpture's lattice */

    std::array<snapshot_light, SNAPSHOT_LIGHTS> lights{};
    snapshot_material material;
    snapshot_environment environment = SNAPSHOT_ENVIRONMENT_NONE;
    float environment_strength = 0.4f; /* weight of the semi-transparent layer */

    snapshot_tool_style tool_style = SNAPSHOT_TOOL_WIREFRAME;
    frame tool_world{};                     /* mm; an ellipsoid's axes are its semi-axes */
    std::array<float, 3> tool_colour{1, 1, 1};
    /* freeform: its own iso-surface, lattice steps about tool_middle; else ellipsoid */
    const surface *tool_surface = nullptr;
    std::array<double, 3> tool_middle{};    /* freeform: key-space point of its clay that is the tool's origin */
    bool tool_working = false;              /* the pedal is down */

    bool box_shown = true;
    std::array<double, 3> box_lo{-50, -50, -50}, box_hi{50, 50, 50}; /* workspace, mm */
    bool lights_shown = true;

    bool keeping_shown = false;
    snapshot_keeping keeping = SNAPSHOT_KEEPING_ALL;
};

#endif
