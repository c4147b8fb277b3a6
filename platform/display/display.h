/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    The display port: somewhere to draw with OpenGL ES 3.1. Whoever draws asks for a kind of display, makes it
 *          current on the drawing thread, and knows nothing of what lies behind it.
 * Is not:  What is drawn, or the picture's buffers (whoever draws has those); input (platform/desk, spacemouse).
 * Shape:   display_open tries every way its kind knows, best first, and takes the first that works:
 *
 *              DISPLAY_HEADLESS   no window, no default framebuffer: see headless.h
 *
 * Owner:   the caller owns the display and closes it; the OpenGL objects made in it end with it.
 * Errors:  display_open answers NULL, display_make_current false; the trouble then says, in one line, everything that
 *          was tried and what each try was missing. Nothing is left half open.
 * Cost:    display_open loads the driver: tens of milliseconds, some hundred for a software renderer.
 */
#ifndef GLAISE_DISPLAY_DISPLAY_H
#define GLAISE_DISPLAY_DISPLAY_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define DISPLAY_CHECKED __attribute__((warn_unused_result))

typedef enum display_kind { DISPLAY_HEADLESS } display_kind;

enum { DISPLAY_TEXT_BYTES = 512 };

typedef struct display_trouble {
    char text[DISPLAY_TEXT_BYTES]; /* cut, never overrun */
} display_trouble;

typedef struct display display;

/* An opened display is not yet current. */
DISPLAY_CHECKED display *display_open(display_kind kind, display_trouble *trouble_out);
/* On the calling thread; at most one thread has it at a time. */
DISPLAY_CHECKED bool display_make_current(display *d, display_trouble *trouble_out);
/* NULL is fine. If it is current on the calling thread, that ends too; on another thread it must not be. */
void display_close(display *d);

/* Has the driver been reset, so that everything made in the context is gone? Then it is to be closed and opened anew.
   Always false where the driver does not say, or it is not current here. */
bool display_is_lost(const display *d);

/* Which way was taken, e.g. "EGL 1.5 surfaceless". Holds until display_close. */
const char *display_description(const display *d);

#ifdef __cplusplus
}
#endif
#endif
