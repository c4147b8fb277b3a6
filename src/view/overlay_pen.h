/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What everything on the screen is drawn with: the colours, the size of letters, text that is made to fit.
 * Is not:  What is drawn (overlay_ring.h, overlay_strip.h, overlay_icon.h); OpenGL (overlay_ink.h).
 * Shape:   the size of letters comes from the screen's millimetres, so that they can be read standing:
 *
 *              capital letter   OVERLAY_PEN_CAP_MM     5 mm: at 1.2 m that is 14 minutes of arc. 5 can just be made
 *                                                      out, 14 are read with ease
 *              letter's line    cap / OVERLAY_PEN_CAP  what Lato's capitals are of its line
 *
 *          and is never more than what leaves room for a whole ring and a whole strip.
 * Units:   pixels of the screen, from its top left corner; colours sRGB.
 * Owner:   overlay.cpp owns list and fonts; a pen is good for one picture.
 */
#ifndef GLAISE_VIEW_OVERLAY_PEN_H
#define GLAISE_VIEW_OVERLAY_PEN_H

#include <imgui/imgui.h>

#include <string>
#include <vector>

constexpr double OVERLAY_PEN_CAP_MM = 5.0;
constexpr double OVERLAY_PEN_CAP = 0.597;
constexpr double OVERLAY_PEN_SCREEN_MM = 336; /* the shorter side of a 27-inch screen: where none is known */
constexpr double OVERLAY_PEN_LINES = 26;      /* at least so many lines of text a picture's shorter side */
constexpr double OVERLAY_PEN_LEAST = 7;       /* smaller letters are no letters */
constexpr float OVERLAY_PEN_LABEL = 1.3f;     /* a sector's letters, of the usual ones, where there is room */
constexpr float OVERLAY_PEN_LARGE = 1.6f;     /* the middle's */

/* Fired clay, slip and glaze. */
constexpr ImU32 OVERLAY_PEN_GROUND = IM_COL32(0x1e, 0x17, 0x13, 0xf4);
constexpr ImU32 OVERLAY_PEN_LINE = IM_COL32(0x96, 0x72, 0x5a, 0xff);
constexpr ImU32 OVERLAY_PEN_TEXT = IM_COL32(0xf4, 0xe8, 0xda, 0xff);
constexpr ImU32 OVERLAY_PEN_QUIET = IM_COL32(0xc3, 0xae, 0x9b, 0xff);
constexpr ImU32 OVERLAY_PEN_LIT = IM_COL32(0xb5, 0x64, 0x3c, 0xf4);
constexpr ImU32 OVERLAY_PEN_CHOSEN = IM_COL32(0xf0, 0xc2, 0x74, 0xff);
constexpr ImU32 OVERLAY_PEN_GOOD = IM_COL32(0x86, 0xb8, 0x6c, 0xff);
constexpr ImU32 OVERLAY_PEN_WAITS = IM_COL32(0xf0, 0xa8, 0x38, 0xff);
constexpr ImU32 OVERLAY_PEN_BAD = IM_COL32(0xe6, 0x48, 0x34, 0xff);

/* Words where they stand: tests look at them. */
struct overlay_pen_word {
    std::string text;
    double x0, y0, x1, y1;
};

struct overlay_pen {
    ImDrawList *list = nullptr;
    ImFont *usual = nullptr, *label = nullptr, *bold = nullptr; /* as large as they are drawn: enlarged they blur */
    float size = 16;              /* of a line of usual letters */
    float width = 0, height = 0;  /* of the picture */
    bool ascii = false;           /* the font has nothing else */
    std::vector<overlay_pen_word> *words = nullptr;
};

/* A line of letters' height. pixels_per_mm 0: not known. */
double overlay_pen_size(double width, double height, double pixels_per_mm);
/* How wide it would be. */
float overlay_pen_width(const overlay_pen &p, bool bold, float size, const std::string &text);
/* The size at which it is no wider than `most`. */
float overlay_pen_fit(const overlay_pen &p, bool bold, float size, const std::string &text, float most);
/* x: its left end (0), middle (0.5) or right end (1), by `about`; y: its middle. */
void overlay_pen_text(const overlay_pen &p, bool bold, float size, float x, float y, float about, ImU32 colour,
                      const std::string &text);
/* Lines no wider than `most`, where words allow it. */
std::vector<std::string> overlay_pen_broken(const overlay_pen &p, bool bold, float size, float most,
                                            const std::string &text);
/* The same, drawn about the middle of all of them; a word that is too wide is made smaller. */
void overlay_pen_lines(const overlay_pen &p, bool bold, float size, float x, float y, float most, ImU32 colour,
                      const std::string &text);
/* A thick arc from one angle to another, clockwise from the top, radians. */
void overlay_pen_arc(const overlay_pen &p, ImVec2 middle, float inner, float outer, double from, double to,
                     ImU32 colour);
ImVec2 overlay_pen_round(ImVec2 middle, double radius, double angle); /* clockwise from the top, radians */
ImU32 overlay_pen_rgb(unsigned rgb, unsigned alpha = 255);            /* 0xrrggbb */

#endif
