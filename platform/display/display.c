/* SPDX-License-Identifier: Apache-2.0 */
#include "platform/display/display.h"

#include "platform/display/headless.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>

struct display {
    display_kind kind;
    headless headless;
};

display *display_open(display_kind kind, display_trouble *trouble_out)
{
    assert(trouble_out);
    trouble_out->text[0] = '\0';
    if (kind != DISPLAY_HEADLESS) {
        snprintf(trouble_out->text, sizeof trouble_out->text, "display: kind %d is not one this program was built with",
                 (int)kind);
        return NULL;
    }
    display *d = calloc(1, sizeof *d);
    if (!d) {
        snprintf(trouble_out->text, sizeof trouble_out->text, "display: no memory");
        return NULL;
    }
    d->kind = kind;
    if (!headless_open(&d->headless, trouble_out)) {
        free(d);
        return NULL;
    }
    return d;
}

bool display_make_current(display *d, display_trouble *trouble_out)
{
    assert(d && trouble_out);
    trouble_out->text[0] = '\0';
    return headless_make_current(&d->headless, trouble_out);
}

void display_close(display *d)
{
    if (!d)
        return;
    headless_close(&d->headless);
    free(d);
}

bool display_is_lost(const display *d)
{
    assert(d);
    return headless_is_lost(&d->headless);
}

const char *display_description(const display *d)
{
    assert(d);
    return d->headless.description;
}
