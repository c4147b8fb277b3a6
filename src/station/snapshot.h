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
#include "station/snapshot_menu.h"

#include <array>
#include <cstdint>

enum { SNAPSHOT_LIGHTS = 4 };

enum snapshot_environment {
    SNAPSHOT_ENVIRONMENT_NONE,
    SNAPSHOT_ENVIRONMENT_OPAQUE,    /* metal: the map alone */
    SNAPSHOT_ENVIRONMENT_SEMI,      /* a constant layer over the clay's colour */
    SNAPSHOT_ENVIRONMENT_CLEARCOAT, /* a layer that grows towards grazing angles */
};

/* What surrounds the piece: its light falls on the clay and is mirrored in it. */
enum snapshot_scenery {
    SNAPSHOT_SCENERY_STUDIO,
    SNAPSHOT_SCENERY_WINDOW,
    SNAPSHOT_SCENERY_STRIPS, /* for reading curvature */
    SNAPSHOT_SCENERY_NIGHT,
    SNAPSHOT_SCENERY_OWN, /* a picture that somebody brought */
    SNAPSHOT_SCENERIES,
};

enum snapshot_look {
    SNAPSHOT_LOOK_CLAY,       /* physically based: the scenery's light and the lights */
    SNAPSHOT_LOOK_PLAIN,      /* the papers': lights alone */
    SNAPSHOT_LOOK_SILHOUETTE, /* the outline alone */
    SNAPSHOT_LOOK_RAKING,     /* one light that grazes the clay: lumps throw shadows */
};

/* 000 figure 5. */
enum snapshot_structure {
    SNAPSHOT_STRUCTURE_SURFACE,
    SNAPSHOT_STRUCTURE_STORED,   /* all cubes that have a corner stored */
    SNAPSHOT_STRUCTURE_CROSSING, /* the cubes that the surface passes through */
};

enum snapshot_layout { /* of the two eyes' pictures in one */
    SNAPSHOT_LAYOUT_MONO,
    SNAPSHOT_LAYOUT_SIDE_HALF, /* left and right, each half as wide */
    SNAPSHOT_LAYOUT_SIDE_FULL, /* left and right, twice as wide together */
    SNAPSHOT_LAYOUT_TOP_HALF,
    SNAPSHOT_LAYOUT_TOP_FULL,
    SNAPSHOT_LAYOUT_ROWS,    /* interleaved */
    SNAPSHOT_LAYOUT_COLUMNS, /* interleaved */
    SNAPSHOT_LAYOUT_CHECKER,
    SNAPSHOT_LAYOUT_ANAGLYPH, /* red for the left eye, cyan for the right */
    SNAPSHOT_LAYOUT_PACKED,   /* HDMI 1.4 frame packing: one above the other, a gap between */
    SNAPSHOT_LAYOUTS,
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

struct snapshot_effects {
    float occlusion = 0.6f; /* how much darker hollows are, 0..1 */
    bool shadows = true;    /* of the first light that is lit */
    bool floor = true;      /* the turntable, at the workspace's bottom */
    float blur = 0;         /* depth of field: the lens's width, as a part of its widest; 0: all is sharp */
    bool mirrored = false;  /* left for right */
};

struct snapshot_eyes {
    snapshot_layout layout = SNAPSHOT_LAYOUT_MONO;
    bool swapped = false;           /* the right eye comes first: on the left, on top, in even rows, in red */
    double separation = 1.0 / 30;   /* of the plane's distance */
    double plane_mm = 200;          /* from the eyes to the plane of zero parallax */
};

struct snapshot {
    std::array<double, 4> scene_turn{1, 0, 0, 0}; /* unit quaternion w, x, y, z */
    std::array<double, 3> scene_shift{};          /* mm, after the turn */
    double camera_distance = 200;                 /* mm from eye to the origin of the turned world */
    double field_of_view = 0.6;                   /* vertical */
    double step_mm = 1;                           /* of the sculpture's lattice */

    std::array<snapshot_light, SNAPSHOT_LIGHTS> lights{};
    snapshot_material material;
    snapshot_look look = SNAPSHOT_LOOK_PLAIN;
    snapshot_effects effects;
    snapshot_structure structure = SNAPSHOT_STRUCTURE_SURFACE;
    snapshot_eyes eyes;
    snapshot_scenery scenery = SNAPSHOT_SCENERY_STUDIO;
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

    snapshot_menu menu;
    snapshot_menu_strip strip;
};

#endif
