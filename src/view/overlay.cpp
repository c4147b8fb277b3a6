/* SPDX-License-Identifier: Apache-2.0 */
#include "view/overlay.h"

#include "view/overlay_ink.h"
#include "view/overlay_ring.h"
#include "view/overlay_strip.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>

struct overlay {
    overlay_ink ink;
    ImGuiContext *context = nullptr;
    std::string usual, bold; /* font files, whole; empty: none */
    std::string message;
    ImFont *usual_font = nullptr, *label_font = nullptr, *bold_font = nullptr;
    double size = 0; /* that the letters were drawn for */
    std::vector<overlay_pen_word> words;
};

namespace {

constexpr ImWchar ranges[] = {0x20, 0x7e, 0xa0, 0xff, 0x2013, 0x2014, 0x2026, 0x2026, 0x203a, 0x203a, 0};

/* Others may have a context of their own. */
class current {
  public:
    explicit current(ImGuiContext *c) : before_(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(c); }
    ~current() { ImGui::SetCurrentContext(before_); }
    current(const current &) = delete;
    current &operator=(const current &) = delete;

  private:
    ImGuiContext *before_;
};

/* The library asserts on what is no font, so that is seen to here. */
std::string font_read(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    constexpr size_t font_bytes_least = 1024;
    const bool is_font = bytes.size() >= font_bytes_least && bytes.compare(0, 4, std::string("\0\1\0\0", 4)) == 0;
    return is_font ? bytes : "";
}

ImFont *font_add(const std::string &bytes, double size)
{
    ImFontConfig wanted;
    wanted.SizePixels = static_cast<float>(size);
    wanted.OversampleH = 2;
    wanted.FontDataOwnedByAtlas = false;
    ImFontAtlas *letters = ImGui::GetIO().Fonts;
    if (bytes.empty()) {
        wanted.FontDataOwnedByAtlas = true;
        return letters->AddFontDefault(&wanted);
    }
    /* It is only read. */
    return letters->AddFontFromMemoryTTF(const_cast<char *>(bytes.data()), static_cast<int>(bytes.size()),
                                         wanted.SizePixels, &wanted, ranges);
}

void letters_make(overlay *o, double size)
{
    if (o->size == size)
        return;
    ImFontAtlas *letters = ImGui::GetIO().Fonts;
    letters->Clear();
    o->usual_font = font_add(o->usual, size);
    o->label_font = font_add(o->usual, std::round(size * OVERLAY_PEN_LABEL));
    o->bold_font = font_add(o->bold, std::round(size * OVERLAY_PEN_LARGE));
    unsigned char *coverage = nullptr;
    int width = 0, height = 0;
    letters->GetTexDataAsAlpha8(&coverage, &width, &height);
    overlay_ink_letters(&o->ink, coverage, width, height);
    letters->ClearTexData();
    o->size = size;
}

/* Is there anything? Most pictures of tapes have nothing. */
bool is_wanted(const snapshot &s) { return overlay_strip_is_shown(s) || s.keeping_shown; }

} // namespace

overlay *overlay_open(std::string *trouble_out, const std::string &font_folder)
{
    auto o = std::make_unique<overlay>();
    if (!overlay_ink_open(&o->ink, trouble_out))
        return nullptr;
    ImGuiContext *before = ImGui::GetCurrentContext();
    o->context = ImGui::CreateContext();
    ImGui::SetCurrentContext(o->context);
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::SetCurrentContext(before);
    o->usual = font_read(font_folder + "/Lato-Regular.ttf");
    o->bold = font_read(font_folder + "/Lato-Bold.ttf");
    if (o->usual.empty() || o->bold.empty()) {
        o->usual.clear();
        o->bold.clear();
        o->message = font_folder + ": no Lato-Regular.ttf and Lato-Bold.ttf; the built-in letters serve";
    }
    return o.release();
}

void overlay_close(overlay *o)
{
    if (!o)
        return;
    ImGui::DestroyContext(o->context);
    overlay_ink_close(&o->ink);
    delete o;
}

void overlay_draw(overlay *o, const snapshot &s, int width, int height, double pixels_per_mm, const overlay_eye &eye)
{
    o->words.clear();
    if (!is_wanted(s))
        return;
    const current here(o->context);
    const double wide = (eye.whole_width > 0 ? eye.whole_width : width) / eye.scale_x;
    const double high = (eye.whole_height > 0 ? eye.whole_height : height) / eye.scale_y;
    const double size = overlay_pen_size(wide, high, pixels_per_mm);
    letters_make(o, size);
    ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(wide), static_cast<float>(high));
    ImGui::GetIO().DeltaTime = 1.0f / 60; /* nothing here moves by it */
    ImGui::NewFrame();
    overlay_pen pen;
    pen.list = ImGui::GetBackgroundDrawList();
    pen.usual = o->usual_font;
    pen.label = o->label_font;
    pen.bold = o->bold_font;
    pen.size = static_cast<float>(size);
    pen.width = static_cast<float>(wide);
    pen.height = static_cast<float>(high);
    pen.ascii = o->usual.empty();
    pen.words = &o->words;
    overlay_strip_draw(pen, s);
    overlay_ring_draw(pen, s.menu, overlay_strip_height(pen, s));
    ImGui::Render();
    overlay_ink_draw(o->ink, ImGui::GetDrawData(),
                     {eye.scale_x, eye.scale_y, eye.shift_pixels * eye.scale_x - eye.x, -static_cast<double>(eye.y),
                      width, height});
}

bool overlay_message_take(overlay *o, std::string *text_out)
{
    *text_out = std::exchange(o->message, {});
    return !text_out->empty();
}

std::vector<overlay_word> overlay_words(const overlay *o)
{
    std::vector<overlay_word> all;
    for (const overlay_pen_word &w : o->words)
        all.push_back({w.text, w.x0, w.y0, w.x1, w.y1});
    return all;
}

double overlay_cap_pixels(const overlay *o)
{
    if (!o->usual_font)
        return 0;
    const ImFontGlyph *h = o->usual_font->FindGlyph('H');
    return h->Y1 - h->Y0;
}
