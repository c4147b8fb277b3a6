/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a mode of a screen asks of the picture: a 3D mode of HDMI 1.4, as the kernel lists it, becomes a layout
 *          of the two eyes' pictures and the size of the framebuffer that holds them.
 * Is not:  Setting a mode; drawing in a layout (whoever draws).
 * Shape:
 *              3D flag of the mode    layout       framebuffer
 *              none                   one          hdisplay x vdisplay
 *              side by side half      side half    hdisplay x vdisplay, left eye on the left
 *              top and bottom         top half     hdisplay x vdisplay, left eye on top
 *              frame packing          packed       hdisplay x (2 vdisplay + gap), left eye on top, the gap black;
 *                                                  gap = vtotal - vdisplay, the mode's own pause between two pictures
 *
 *          1080p24 packed: 1920 x 2205, gap 45. 720p60 packed: 1280 x 1470, gap 30. The kernel lists modes with these
 *          flags only to whoever has asked for them (DRM_CLIENT_CAP_STEREO_3D), and a mode must be set with its flag.
 *          Packing sends twice the pixels a second.
 * Units:   pixels, rows.
 * Owner:   values.
 * Errors:  stereo_mode_of false: the trouble says what in the mode cannot be drawn for; stereo_mode is as it was.
 *          Only what a kernel lays out itself is taken: the other 3D structures (alternating fields or lines, full side
 *          by side, depth maps) have a flag but no agreed framebuffer. Interlaced modes would tear the eyes apart in
 *          time.
 * Source:  <drm_mode.h>; HDMI 1.4a, its 3D structures.
 */
#ifndef GLAISE_DISPLAY_STEREO_MODE_H
#define GLAISE_DISPLAY_STEREO_MODE_H

#include "platform/display/display.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum stereo_mode_layout {
    STEREO_MODE_ONE, /* no stereo */
    STEREO_MODE_SIDE_HALF,
    STEREO_MODE_TOP_HALF,
    STEREO_MODE_PACKED,
} stereo_mode_layout;

/* The members of the same names of drmModeModeInfo. */
typedef struct stereo_mode_timing {
    uint32_t flags;
    int hdisplay, vdisplay, vtotal;
} stereo_mode_timing;

typedef struct stereo_mode {
    stereo_mode_layout layout;
    int width, height; /* of the framebuffer */
    int gap;           /* rows between the eyes; 0 unless packed */
} stereo_mode;

DISPLAY_CHECKED bool stereo_mode_of(const stereo_mode_timing *timing, stereo_mode *mode_out,
                                    display_trouble *trouble_out);

#ifdef __cplusplus
}
#endif
#endif
