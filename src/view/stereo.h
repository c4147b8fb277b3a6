/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Two eyes: the projection of each, made from the one between them, and the finished picture, made from what
 *          the two have seen. Every layout of enum snapshot_layout, whole or in parts.
 * Is not:  What an eye's picture shows (view.h); where the plane of zero parallax is wanted (station/showing.h); which
 *          3D mode a television is in (platform/display/stereo_mode.h).
 * Shape:   Both eyes look the same way, off axis, never toed in: then no point is higher in one eye than in the other.
 *
 *              left *----.        .------  what lies on the plane is on the same pixel in both eyes,
 *                         ><plane ><      before it the left eye sees it further right (crossed),
 *              right *----'        '------ behind it further left
 *
 *              eye = eye_from_mono * mono                     the eye's own space: a shift along x, no more
 *              clip = clip_from_eye * eye                     sheared back by what the plane was shifted
 *
 *          A mono projection that is mirrored in x (negative first element) stays right: what was the left eye's place
 *          is then the right eye's, else near and far would change places.
 *
 *          Eye space is the eye's own: a shader that works in it needs no change. What is given in mono's eye space,
 *          such as lights that move with the viewer, goes through eye_from_mono first. clip_from_eye is no longer
 *          symmetric: whoever goes back from the screen must use its inverse, not its diagonal alone. A backdrop that
 *          lies behind all is to be shifted by far_shift, else it stands in the plane. What lies in the screen itself
 *          (menus, beads) is drawn alike for both eyes.
 *
 *          Layouts, for the first eye (left, unless swapped) and the second; z is the gap, black:
 *
 *              side  1 2      top  1      packed  1      rows  1 1 1    columns  1 2 1    checker  1 2 1
 *                                  2              z            2 2 2             1 2 1             2 1 2
 *                                                 2            1 1 1             1 2 1             1 2 1
 *
 *          Rows, columns and squares are counted from the top left of the whole finished picture, which is the screen.
 *          Each eye is drawn at full size and no pixel of it is mixed with others. In half layouts each eye is drawn
 *          at half size with the finished picture's aspect; a last row or column that is left over is black.
 *          Anaglyph: the matrix of least squares, which takes from each eye what would leak into the other. It was
 *          made from spectra, which add as light does: it is applied to linear light, and what falls outside 0..1 is
 *          cut.
 * Units:   millimetres; pixels, counted from the top left corner; parallax as a part of the picture's width.
 * Owner:   the caller owns `stereo`; a zeroed one is closed. Its context must be current.
 * Errors:  stereo_trouble says in words what is wrong; the other functions assert that nothing is. stereo_open false:
 *          the trouble has the compiler's words.
 * Cost:    stereo_compose: one triangle, one or two texels a pixel.
 * Source:  Bourke, "Calculating stereo pairs" (off-axis frusta; separation 1/30 of the plane's distance, nothing nearer
 *          than half of it, rules of thumb). Dubois, "Conversion of a stereo pair to anaglyph with the least-squares
 *          projection method", 2009 (red and cyan glasses, LCD). HDMI 1.4a, its 3D structures (frame packing).
 */
#ifndef GLAISE_VIEW_STEREO_H
#define GLAISE_VIEW_STEREO_H

#include "view/projection.h"

#include <GLES3/gl31.h>

#include <string>

/* Of the picture's width, between the two eyes' images of one point. The rules of thumb come to this where a picture is
   as wide as its plane is far; and a point at infinity asks nobody to look apart (65 mm) on screens up to 1.95 m. */
constexpr double STEREO_PARALLAX_MAX = 1.0 / 30;

enum stereo_eye { STEREO_LEFT, STEREO_RIGHT, STEREO_EYES };

struct stereo_seen {
    projection seen; /* near and far are mono's */
    glm::dmat4 eye_from_mono;
    double far_shift; /* of what is infinitely far, along x of the clip volume (-1..1), against mono */
};

/* The whole finished picture. */
struct stereo_screen {
    snapshot_layout layout = SNAPSHOT_LAYOUT_MONO;
    bool swapped = false; /* as in snapshot_eyes */
    int width = 0, height = 0;
    int gap = 0; /* rows between the two: packed only */
};

struct stereo_size {
    int width, height;
};

/* What of an eye's picture shows in a part of the finished one, and where in it. Width and height 0: nothing. */
struct stereo_share {
    projection_part of_eye;
    int x, y; /* of its top left pixel, in the part */
};

struct stereo {
    GLuint program = 0, array = 0;
    GLint part = -1, way = -1, first_share = -1, second_share = -1;
};

/* --- the eyes --- */

/* Millimetres: what was asked for, or less, so that neither the nearest thing nor the farthest has more parallax than
   STEREO_PARALLAX_MAX. whole: of the whole picture, not of a part. nearest, farthest: of what is looked at; a lamp
   close to the eye would flatten everything else. Continuous in all of them. */
double stereo_separation_mm(const snapshot_eyes &eyes, const projection &whole, double nearest_mm, double farthest_mm);

/* mono: of the whole picture, or of a part (projection_of_part). */
stereo_seen stereo_see(const projection &mono, double plane_mm, double separation_mm, stereo_eye eye);

/* --- layouts --- */

/* Empty when the eyes and the finished picture can be drawn. */
std::string stereo_trouble(const snapshot_eyes &eyes, const stereo_screen &whole);

/* An eye's picture, in pixels. */
stereo_size stereo_eye_size(const stereo_screen &whole);
/* What an eye's picture looks like when it is shown: the width and height to project with. */
stereo_size stereo_shape(const stereo_screen &whole);
/* The finished picture that shows both eyes in a shape of width x height. */
stereo_size stereo_finished(snapshot_layout layout, int width, int height, int gap);
/* Of a packed picture where no display says: what 1080 and 720 lines have (45, 30), a 49th of the height. */
int stereo_gap_usual(int height);

/* part: of the finished picture. */
stereo_share stereo_share_of(const stereo_screen &whole, stereo_eye eye, const projection_part &part);

/* --- the finished picture --- */

[[nodiscard]] bool stereo_open(stereo *c, std::string *trouble_out);
void stereo_close(stereo *c);

/* Covers the bound framebuffer (part.width x part.height, encoding sRGB). left and right: textures of sRGB, bottom row
   first as OpenGL has them, each the size of its share; 0 where it has none. The framebuffer stays bound, depth and
   blending are off. */
void stereo_compose(const stereo &c, const stereo_screen &whole, const projection_part &part, GLuint left,
                    GLuint right);

#endif
