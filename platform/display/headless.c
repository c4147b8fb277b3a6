/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/display/headless.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { DEVICES_MAX = 16 };

/* What the ways tried so far were missing, gathered into the trouble. */
typedef struct report {
    display_trouble *trouble;
    const char *way;
} report;

__attribute__((format(printf, 2, 3))) static bool missing(report *r, const char *format, ...)
{
    size_t used = strlen(r->trouble->text);
    size_t room = sizeof r->trouble->text - used;
    int n = snprintf(r->trouble->text + used, room, "; %s: ", r->way);
    if (n > 0 && (size_t)n < room) {
        va_list list;
        va_start(list, format);
        vsnprintf(r->trouble->text + used + n, room - (size_t)n, format, list);
        va_end(list);
    }
    return false;
}

static const char *egl_error(void)
{
    switch (eglGetError()) {
    case EGL_SUCCESS: return "no error given";
    case EGL_NOT_INITIALIZED: return "EGL_NOT_INITIALIZED";
    case EGL_BAD_ACCESS: return "EGL_BAD_ACCESS";
    case EGL_BAD_ALLOC: return "EGL_BAD_ALLOC";
    case EGL_BAD_ATTRIBUTE: return "EGL_BAD_ATTRIBUTE";
    case EGL_BAD_CONFIG: return "EGL_BAD_CONFIG";
    case EGL_BAD_CONTEXT: return "EGL_BAD_CONTEXT";
    case EGL_BAD_DISPLAY: return "EGL_BAD_DISPLAY";
    case EGL_BAD_MATCH: return "EGL_BAD_MATCH";
    case EGL_BAD_PARAMETER: return "EGL_BAD_PARAMETER";
    case EGL_BAD_SURFACE: return "EGL_BAD_SURFACE";
    case EGL_CONTEXT_LOST: return "EGL_CONTEXT_LOST";
    default: return "an unknown error";
    }
}

/* Whole words only: one extension's name may begin another's. */
static bool has_word(const char *words, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = words; at && (at = strstr(at, word)); at += n)
        if ((at == words || at[-1] == ' ') && (at[n] == ' ' || at[n] == '\0'))
            return true;
    return false;
}

static bool bind_context(headless *h, report *r)
{
    if (!eglBindAPI(EGL_OPENGL_ES_API))
        return missing(r, "no OpenGL ES (%s)", egl_error());
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    if (!eglChooseConfig(h->egl, wanted, &config, 1, &count) || count < 1)
        return missing(r, "no configuration for OpenGL ES 3 (%s)", egl_error());
    const char *extensions = eglQueryString(h->egl, EGL_EXTENSIONS);
    if (has_word(extensions, "EGL_EXT_create_context_robustness")) {
        /* A driver that was reset then says so, where it would draw nothing any more without a word. */
        const EGLint robust[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1,
                                 EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT, EGL_LOSE_CONTEXT_ON_RESET_EXT,
                                 EGL_NONE};
        h->context = eglCreateContext(h->egl, config, EGL_NO_CONTEXT, robust);
    }
    const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    if (h->context == EGL_NO_CONTEXT)
        h->context = eglCreateContext(h->egl, config, EGL_NO_CONTEXT, version);
    if (h->context == EGL_NO_CONTEXT)
        return missing(r, "no OpenGL ES 3.1 context (%s)", egl_error());
    if (has_word(extensions, "EGL_KHR_surfaceless_context"))
        return true;
    const EGLint one_pixel[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    h->surface = eglCreatePbufferSurface(h->egl, config, one_pixel);
    if (h->surface == EGL_NO_SURFACE)
        return missing(r, "neither EGL_KHR_surfaceless_context nor a pbuffer (%s)", egl_error());
    return true;
}

/* One way: from a native display, which may be EGL_NO_DISPLAY, to a context. Leaves nothing open when it answers
   false. */
static bool try_display(headless *h, EGLDisplay egl, report *r)
{
    if (egl == EGL_NO_DISPLAY)
        return missing(r, "no display (%s)", egl_error());
    EGLint major = 0, minor = 0;
    if (!eglInitialize(egl, &major, &minor))
        return missing(r, "did not initialise (%s)", egl_error());
    h->egl = egl;
    if (!bind_context(h, r)) {
        headless_close(h);
        return false;
    }
    snprintf(h->description, sizeof h->description, "EGL %d.%d %s", (int)major, (int)minor, r->way);
    return true;
}

static bool try_devices(headless *h, const char *extensions, report *r)
{
    PFNEGLQUERYDEVICESEXTPROC query = NULL;
    if (has_word(extensions, "EGL_EXT_device_enumeration") || has_word(extensions, "EGL_EXT_device_base"))
        query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    if (!query || !has_word(extensions, "EGL_EXT_platform_device"))
        return missing(r, "no EGL_EXT_platform_device");
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = 0;
    if (!query(DEVICES_MAX, devices, &count) || count < 1)
        return missing(r, "no device (%s)", egl_error());
    for (EGLint i = 0; i < count; i++)
        if (try_display(h, eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL), r))
            return true;
    return false;
}

bool headless_open(headless *h, display_trouble *trouble_out)
{
    memset(h, 0, sizeof *h);
    snprintf(trouble_out->text, sizeof trouble_out->text, "headless display");
    report r = {trouble_out, "surfaceless"};
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!extensions)
        (void)eglGetError(); /* an EGL without client extensions; the default way may still do */
    bool opened;
    if (has_word(extensions, "EGL_MESA_platform_surfaceless"))
        opened = try_display(h, eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL), &r);
    else
        opened = missing(&r, "no EGL_MESA_platform_surfaceless");
    if (!opened) {
        r.way = "device";
        opened = try_devices(h, extensions, &r);
    }
    if (!opened) {
        r.way = "default";
        opened = try_display(h, eglGetDisplay(EGL_DEFAULT_DISPLAY), &r);
    }
    if (opened)
        trouble_out->text[0] = '\0';
    return opened;
}

bool headless_make_current(headless *h, display_trouble *trouble_out)
{
    EGLSurface surface = h->surface ? h->surface : EGL_NO_SURFACE;
    if (eglBindAPI(EGL_OPENGL_ES_API) && eglMakeCurrent(h->egl, surface, surface, h->context))
        return true;
    snprintf(trouble_out->text, sizeof trouble_out->text, "headless display: the context cannot be made current (%s)",
             egl_error());
    return false;
}

bool headless_is_lost(const headless *h)
{
    typedef unsigned (*reset_status)(void);
    static const char *const names[] = {"glGetGraphicsResetStatus", "glGetGraphicsResetStatusKHR",
                                        "glGetGraphicsResetStatusEXT"};
    if (eglGetCurrentContext() != h->context)
        return false;
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        const reset_status ask = (reset_status)eglGetProcAddress(names[n]);
        if (ask)
            return ask() != 0;
    }
    return false;
}

void headless_close(headless *h)
{
    if (h->egl) {
        if (h->context && eglGetCurrentContext() == h->context)
            eglMakeCurrent(h->egl, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (h->surface)
            eglDestroySurface(h->egl, h->surface);
        if (h->context)
            eglDestroyContext(h->egl, h->context);
        /* No eglTerminate: it unloads the driver, whose threads and caches may outlive it. The display is the process's
           own and is taken up again by the next open. */
    }
    memset(h, 0, sizeof *h);
}
