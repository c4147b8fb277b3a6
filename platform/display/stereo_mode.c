/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/display/stereo_mode.h"

#include <drm_mode.h>

#include <stdio.h>

/* The reason why a mode cannot be drawn for, in the kernel's words for it; NULL where it can. */
static const char *refusal_of(const stereo_mode_timing *t)
{
    if (t->flags & DRM_MODE_FLAG_INTERLACE)
        return "it is interlaced, only progressive modes are taken";
    if (t->flags & DRM_MODE_FLAG_DBLSCAN)
        return "it scans every row twice";
    if (t->hdisplay < 1 || t->vdisplay < 1 || t->vtotal < t->vdisplay)
        return "its size makes no sense";
    switch (t->flags & DRM_MODE_FLAG_3D_MASK) {
    case DRM_MODE_FLAG_3D_NONE:
    case DRM_MODE_FLAG_3D_FRAME_PACKING:
    case DRM_MODE_FLAG_3D_TOP_AND_BOTTOM:
    case DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF: return NULL;
    case DRM_MODE_FLAG_3D_FIELD_ALTERNATIVE: return "its eyes take turns by field";
    case DRM_MODE_FLAG_3D_LINE_ALTERNATIVE: return "its eyes take turns by line";
    case DRM_MODE_FLAG_3D_SIDE_BY_SIDE_FULL: return "its eyes lie side by side at full width";
    case DRM_MODE_FLAG_3D_L_DEPTH:
    case DRM_MODE_FLAG_3D_L_DEPTH_GFX_GFX_DEPTH: return "it wants one eye and a map of depths";
    default: return "its 3D structure is unknown";
    }
}

bool stereo_mode_of(const stereo_mode_timing *timing, stereo_mode *mode_out, display_trouble *trouble_out)
{
    const char *refusal = refusal_of(timing);
    if (refusal) {
        snprintf(trouble_out->text, sizeof trouble_out->text,
                 "mode %d x %d (of %d rows, flags 0x%x) cannot be drawn for: %s", timing->hdisplay, timing->vdisplay,
                 timing->vtotal, (unsigned)timing->flags, refusal);
        return false;
    }
    stereo_mode mode = {STEREO_MODE_ONE, timing->hdisplay, timing->vdisplay, 0};
    switch (timing->flags & DRM_MODE_FLAG_3D_MASK) {
    case DRM_MODE_FLAG_3D_SIDE_BY_SIDE_HALF: mode.layout = STEREO_MODE_SIDE_HALF; break;
    case DRM_MODE_FLAG_3D_TOP_AND_BOTTOM: mode.layout = STEREO_MODE_TOP_HALF; break;
    case DRM_MODE_FLAG_3D_FRAME_PACKING:
        mode.layout = STEREO_MODE_PACKED;
        mode.gap = timing->vtotal - timing->vdisplay;
        mode.height = timing->vdisplay + timing->vtotal;
        break;
    default: break;
    }
    *mode_out = mode;
    trouble_out->text[0] = '\0';
    return true;
}
