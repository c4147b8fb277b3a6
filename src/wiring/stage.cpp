/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/stage.h"

#ifdef GLAISE_VIEW

#include "exchange/picture.h"
#include "exchange/picture_source.h"
#include "platform/display/display.h"
#include "view/view.h"
#include "wiring/store.h"

#include <cstdio>
#include <utility>

static_assert(LARGE_PICTURE_SIDE_MAX <= PICTURE_SIDE_MAX && LARGE_PICTURE_SIDE_MAX <= VIEW_SIDE_MAX);

struct stage {
    display *place = nullptr;
    view *eye = nullptr;
    std::string told;    /* of what pictures do without */
    std::string scenery; /* path of the picture that was brought last, to be read again */
};

namespace {

void shut(stage *s)
{
    view_close(std::exchange(s->eye, nullptr));
    display_close(std::exchange(s->place, nullptr));
}

bool set_up(stage *s, std::string *text_out)
{
    display_trouble trouble;
    s->place = display_open(DISPLAY_HEADLESS, &trouble);
    if (!s->place || !display_make_current(s->place, &trouble)) {
        *text_out = trouble.text;
        return false;
    }
    s->eye = view_open(text_out);
    return s->eye != nullptr;
}

void tell_lacks(stage *s)
{
    if (view_lacks(s->eye) == s->told)
        return;
    s->told = view_lacks(s->eye);
    std::fprintf(stderr, "glaise: pictures are poorer here: %s\n", s->told.c_str());
}

/* A driver that was reset took everything along. */
bool is_there(stage *s, std::string *text_out)
{
    if (s->eye && !display_is_lost(s->place))
        return true;
    std::fprintf(stderr, "glaise: the graphics driver was reset; the picture is made anew\n");
    return stage_renew(s, text_out);
}

} // namespace

stage *stage_open(std::string *text_out)
{
    auto *s = new stage;
    if (set_up(s, text_out)) {
        tell_lacks(s);
        return s;
    }
    stage_close(s);
    return nullptr;
}

void stage_close(stage *s)
{
    if (!s)
        return;
    shut(s);
    delete s;
}

bool stage_renew(stage *s, std::string *text_out)
{
    shut(s);
    if (!set_up(s, text_out))
        return false;
    std::string unread; /* it was told when it was brought, or the file has gone since: the studio serves */
    if (!s->scenery.empty() && !stage_scenery(s, s->scenery, &unread))
        std::fprintf(stderr, "glaise: %s\n", unread.c_str());
    return true;
}

bool stage_picture(stage *s, const sculpture *piece, const snapshot &shown, const large_picture_size &size,
                   const std::string &path, std::string *text_out, const std::function<void(double)> &told)
{
    std::string trouble = large_picture_trouble(size);
    if (!trouble.empty() || !is_there(s, &trouble) || !view_update(s->eye, piece, &trouble)) {
        *text_out = path + ": " + trouble;
        return false;
    }
    large_picture whole;
    whole.size = size;
    whole.draw = [&](int width, int height, const large_picture_part &part, std::vector<uint8_t> *rgba_out,
                     std::string *why_out) {
        if (!view_draw_part(s->eye, shown, width, height, {part.x, part.y, part.width, part.height}, why_out) ||
            !view_pixels(s->eye, rgba_out, why_out))
            return false;
        const double across = static_cast<double>(part.x + part.width) / width;
        if (told)
            told((part.y + part.height * across) / height);
        return true;
    };
    const picture_rows rows = [&](uint32_t y, const uint8_t **row_out) {
        *row_out = large_picture_row(&whole, static_cast<int>(y), &trouble);
        return *row_out ? STATUS_OK : STATUS_IO; /* the sentence says which */
    };
    const auto write = [&](checkpoint_sink sink, void *self) {
        return picture_write_rows(static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height), 4, rows, sink,
                                  self);
    };
    const bool good = store_export(path, write, text_out);
    tell_lacks(s);
    if (good)
        return true;
    if (!trouble.empty())
        *text_out = path + ": " + trouble;
    return false;
}

bool stage_scenery(stage *s, const std::string &path, std::string *text_out)
{
    picture_source brought;
    exchange_outcome outcome;
    const auto read = [&](checkpoint_source source, void *self) {
        outcome = picture_source_read(source, self, &brought);
        return outcome.state == STATUS_OK;
    };
    text_out->clear();
    if (!store_import(path, read, text_out)) {
        if (text_out->empty())
            *text_out = path + ": " + outcome.text;
        return false;
    }
    std::string trouble;
    scenery_picture own = {static_cast<int>(brought.width), static_cast<int>(brought.height), std::move(brought.rgba)};
    if (view_scenery(s->eye, std::move(own), &trouble)) {
        s->scenery = path;
        return true;
    }
    *text_out = path + ": " + trouble;
    return false;
}

#else

stage *stage_open(std::string *text_out)
{
    *text_out = "this program was built without pictures";
    return nullptr;
}

void stage_close(stage *) {}

bool stage_picture(stage *, const sculpture *, const snapshot &, const large_picture_size &, const std::string &,
                   std::string *, const std::function<void(double)> &)
{
    return false;
}

bool stage_renew(stage *, std::string *) { return false; }

bool stage_scenery(stage *, const std::string &, std::string *) { return false; }

#endif
