/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The picture: a sculpture's patches under lights and a scenery, with tool, lights and workspace box, drawn
 *          into a framebuffer of its own. This is the room's door.
 * Is not:  What is to be seen (station/snapshot.h); a screen or window (platform/display); a picture file
 *          (exchange/picture.h).
 * Shape:
 *              view_update   changed patches -> device                                         upload.h, page.h
 *              view_draw     shadow map, when piece or lamp moved                              shadow.h
 *                            for each eye:
 *                              relief and hollows, half size                                   hollow.h
 *                              backdrop, clay or cubes, turntable, box, lights, tool;          canvas.h, backdrop.h,
 *                              multisampled                                                    skin.h, cubes.h,
 *                                                                                              wheel.h, marker.h
 *                              depth of field                                                  lens.h
 *                              menus and the strip                                             overlay.h
 *                            both eyes into one                                              stereo.h
 *              view_pixels   the finished picture as bytes
 *
 *          What a device cannot do is left out: the picture is poorer, and view_lacks says how. A device without
 *          multisampling draws four times the pixels instead.
 * Units:   pixels; millimetres in the snapshot.
 * Owner:   view_open's caller owns the view. An OpenGL ES 3.1 context must be current in every call, and always the
 *          same. The view leaves no framebuffer, program or vertex array bound, and takes the state it needs for
 *          itself.
 * Errors:  true, or false and one sentence in the trouble. After a failed view_update what was sent is shown, the
 *          rest is tried again by the next; after a failed view_draw there is no picture.
 * Cost:    view_open: compiles some ten programs, computes the scenery, tenths of a second. view_update: by changed
 *          patch. view_draw: up to four calls per 65,536 vertices, and a few. See README for the effects' costs.
 * Source:  000 sections 2 and 5.
 */
#ifndef GLAISE_VIEW_VIEW_H
#define GLAISE_VIEW_VIEW_H

#include "sculpture/sculpture.h"
#include "station/snapshot.h"
#include "view/quality.h"
#include "view/scenery.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

struct view;

constexpr int VIEW_SIDE_MAX = 65536; /* of a picture that is drawn in parts */
constexpr size_t VIEW_ALL = std::numeric_limits<size_t>::max(); /* budget of a picture: nothing waits */
/* Budget of a frame at 60 Hz: 170 patches of 160 vertices, as a stroke of a large tool changes them. Packing and
   writing it is to take about a millisecond of the processor, 60 MiB a second are 0.4 % of what a Raspberry Pi 5's
   memory moves. */
constexpr size_t VIEW_FRAME_BYTES = size_t{1} << 20;

struct view_counts {
    uint64_t uploaded_bytes;   /* of patches, since view_open; the tool's own not counted */
    uint64_t uploaded_patches; /* likewise */
    uint32_t patches;          /* on the device now */
    uint32_t waiting;          /* patches, the tool's too, that are not drawn as they are: over the budget */
    int samples;               /* per pixel in the last picture; 0 before the first */
    uint32_t passes;           /* framebuffers drawn into for the last picture */
    uint32_t page_draws;       /* draw calls of patches for it */
};

/* What a device is to do without, as if it could not: for trying what is left. */
struct view_limits {
    int samples = 4;
    bool clay = true, shadows = true, hollows = true, wheel = true, lens = true, stereo = true;
    bool backdrop = true, marks = true, cubes = true, words = true;
};

/* NULL and a trouble when no context is current, it is older than 3.1, or the device refuses even the plain look. */
[[nodiscard]] view *view_open(std::string *trouble_out, const view_limits &limits = {});
void view_close(view *v); /* NULL is fine */
/* How large the screen's pixels are, so that words can be read; 0, as at first: it does not say. */
void view_screen(view *v, double pixels_per_mm);
/* What this device does not show, in sentences; empty when nothing. It may grow with a picture: where memory ends, an
   effect is left out. */
const std::string &view_lacks(const view *v);

/* The picture for SNAPSHOT_SCENERY_OWN. A bad one is refused, the one before stays. */
[[nodiscard]] bool view_scenery(view *v, scenery_picture own, std::string *trouble_out);

/* Brings what is shown up to date with the sculpture's surface. The sculpture must stay until it is forgotten: its
   structure is looked at where that is to be drawn. budget_bytes: what may be sent now; the rest waits for
   the next update, see upload.h. It also holds, for the tool's own surface, in each view_draw until then. */
[[nodiscard]] bool view_update(view *v, const sculpture *s, std::string *trouble_out, size_t budget_bytes = VIEW_ALL);
/* Forgets every patch: before another sculpture is shown by the same view. */
void view_forget(view *v);

/* How long the last frame took. True when that changes what is drawn from now on: view_quality says what. */
bool view_frame_took(view *v, int64_t ns);
/* Empty, or what is left out to hold the frame rate. */
const char *view_quality(const view *v);

/* The largest size of the same shape that can be drawn in one, at least 1 x 1; a sentence when it is another than was
   asked for. */
std::string view_size_fitted(int *width, int *height);
/* Draws the patches of the last update. Width and height 1..CANVAS_SIDE_MAX, of the finished picture: with two eyes
   side by side both are in it. */
[[nodiscard]] bool view_draw(view *v, const snapshot &s, int width, int height, std::string *trouble_out);

struct view_part {
    int x, y, width, height; /* pixels; x, y from the whole picture's top left corner */
};
/* The same, of a part of a picture that may be larger than any canvas: width and height 1..VIEW_SIDE_MAX, the part's
   own 1..CANVAS_SIDE_MAX. view_pixels then has the part. */
[[nodiscard]] bool view_draw_part(view *v, const snapshot &s, int width, int height, const view_part &part,
                                  std::string *trouble_out);

/* The last picture: width x height RGBA8, sRGB, top row first, alpha 255. Waits for the device. */
[[nodiscard]] bool view_pixels(view *v, std::vector<uint8_t> *rgba_out, std::string *trouble_out);
/* The same as an OpenGL texture, bottom row first, for whoever shows it; 0 when there is none. Holds until the next
   view_draw. */
uint32_t view_texture(const view *v);

view_counts view_count(const view *v);

#endif
