/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A display without a screen: an EGL context for OpenGL ES 3.1 in which framebuffer objects are drawn and
 *          read. For tests, for pictures made from a tape, for machines where nobody looks.
 * Is not:  A window or a screen; the port callers use (display.h).
 * Shape:   ways tried in turn:
 *              surfaceless   EGL_MESA_platform_surfaceless: Mesa, with or without /dev/dri, in software if need be
 *              device        EGL_EXT_platform_device: the first device that gives a context (other vendors' drivers)
 *              default       eglGetDisplay(EGL_DEFAULT_DISPLAY): whatever the machine's EGL takes for normal
 *          Where a context without a surface is not allowed (EGL_KHR_surfaceless_context), a pbuffer of one pixel is
 *          made and never looked at.
 * Owner:   the caller owns the struct; headless_close ends it.
 * Errors:  headless_open false: the struct is closed again, the trouble names each way and what it was missing.
 */
#ifndef GLAISE_DISPLAY_HEADLESS_H
#define GLAISE_DISPLAY_HEADLESS_H

#include "platform/display/display.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HEADLESS_DESCRIPTION_BYTES = 128 };

/* Handles as EGL has them (EGLDisplay, EGLContext, EGLSurface): kept opaque, so that EGL's header stays inside. */
typedef struct headless {
    void *egl;
    void *context;
    void *surface; /* NULL: no surface is needed */
    char description[HEADLESS_DESCRIPTION_BYTES];
} headless;

DISPLAY_CHECKED bool headless_open(headless *h, display_trouble *trouble_out);
DISPLAY_CHECKED bool headless_make_current(headless *h, display_trouble *trouble_out);
bool headless_is_lost(const headless *h);
void headless_close(headless *h);

#ifdef __cplusplus
}
#endif
#endif
