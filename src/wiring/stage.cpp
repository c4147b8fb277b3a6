/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/stage.h"

#ifdef GLAISE_VIEW

#include "exchange/picture.h"
#include "platform/display/display.h"
#include "view/view.h"
#include "wiring/store.h"

#include <cstdio>

struct stage {
    display *place = nullptr;
    view *eye = nullptr;
};

stage *stage_open(std::string *text_out)
{
    display_trouble trouble;
    auto *s = new stage;
    s->place = display_open(DISPLAY_HEADLESS, &trouble);
    if (s->place && display_make_current(s->place, &trouble)) {
        s->eye = view_open(text_out);
        if (s->eye) {
            if (!view_lacks(s->eye).empty())
                std::fprintf(stderr, "glaise: pictures are poorer here: %s\n", view_lacks(s->eye).c_str());
            return s;
        }
    } else {
        *text_out = trouble.text;
    }
    stage_close(s);
    return nullptr;
}

void stage_close(stage *s)
{
    if (!s)
        return;
    if (s->eye)
        view_close(s->eye);
    display_close(s->place);
    delete s;
}

bool stage_picture(stage *s, const sculpture *piece, const snapshot &shown, int width, int height,
                   const std::string &path, std::string *text_out)
{
    std::vector<uint8_t> rgba;
    if (!view_update(s->eye, piece, text_out) || !view_draw(s->eye, shown, width, height, text_out) ||
        !view_pixels(s->eye, &rgba, text_out))
        return false;
    picture p = {static_cast<uint32_t>(width), static_cast<uint32_t>(height), 4, rgba.data(),
                 4 * static_cast<ptrdiff_t>(width)};
    return store_export(
        path, [&p](checkpoint_sink sink, void *self) { return picture_write(p, sink, self); }, text_out);
}

#else

stage *stage_open(std::string *text_out)
{
    *text_out = "this program was built without pictures";
    return nullptr;
}

void stage_close(stage *) {}

bool stage_picture(stage *, const sculpture *, const snapshot &, int, int, const std::string &, std::string *)
{
    return false;
}

#endif
