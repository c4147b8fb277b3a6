/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Everything that stands on the screen over the picture: the open menu, the strip at the bottom, messages, the
 *          card that says how to begin.
 * Is not:  Their words and state (station/snapshot_menu.h); the piece and its marks (view.h, marker.h).
 * Shape:   drawn last, into whatever framebuffer and viewport are set, once for each eye:
 *
 *              snapshot -> overlay_ring.h, overlay_strip.h -> Dear ImGui's draw list -> overlay_ink.h
 *                             with overlay_pen.h, overlay_icon.h
 *
 *          It is laid out on the screen as the person sees it; an eye says how that becomes its part of the frame.
 * Units:   pixels; pixels_per_mm of the screen, 0 where it does not say.
 * Owner:   the caller owns the overlay. The context must be current throughout. Leaves nothing bound; depth test,
 *          culling and blending off.
 * Errors:  overlay_open NULL: the trouble holds the compiler's words. Without the font file everything is drawn in
 *          letters that are built in, and overlay_message_take has one sentence.
 * Cost:    open: a millisecond; the first picture of a size: letters are drawn, some 10 ms; then below a millisecond.
 */
#ifndef GLAISE_VIEW_OVERLAY_H
#define GLAISE_VIEW_OVERLAY_H

#include "station/snapshot.h"

#include <string>
#include <vector>

struct overlay;

constexpr const char *OVERLAY_FONT_FOLDER = "/usr/share/fonts/truetype/lato"; /* Debian's fonts-lato */

/* One eye's picture. */
struct overlay_eye {
    double shift_pixels = 0;         /* to the right, of the screen's pixels: parallax */
    double scale_x = 1, scale_y = 1; /* 0.5: half a layout, which the screen makes twice as wide or high again */
    int x = 0, y = 0;                /* of the viewport's top left corner in the whole picture, where it is a part */
    int whole_width = 0, whole_height = 0; /* of that picture; 0: the viewport is all of it */
};

struct overlay_word {
    std::string text;
    double x0, y0, x1, y1; /* pixels of the screen */
};

[[nodiscard]] overlay *overlay_open(std::string *trouble_out, const std::string &font_folder = OVERLAY_FONT_FOLDER);
void overlay_close(overlay *o); /* NULL is fine */
/* width, height: the viewport's. Does nothing where the snapshot says that there is nothing to show. */
void overlay_draw(overlay *o, const snapshot &s, int width, int height, double pixels_per_mm,
                  const overlay_eye &eye = {});
/* What there is to tell the person; once. */
bool overlay_message_take(overlay *o, std::string *text_out);
/* The words of the last picture, as they stood on the screen. */
std::vector<overlay_word> overlay_words(const overlay *o);
/* How high a capital letter of the last picture was. */
double overlay_cap_pixels(const overlay *o);

#endif
