/* SPDX-License-Identifier: Apache-2.0 */
#include "station/command.h"

#include "exchange/exchange.h"
#include "sculpture/sculpture.h"

#include <charconv>
#include <cmath>

namespace {

/* Ranges, in one home. A world of 100 metres is more than any piece needs and keeps every key far inside int32 at the
   finest step. */
constexpr double WORLD_MM = 1e5, SIZE_MM_MIN = 0.01, SIZE_MM_MAX = 1e4, SCALE_MIN = 0.01, SCALE_MAX = 100;
constexpr double RATE_MAX = 1e4, GLIDE_MS_MAX = 600000, TURN_DEGREES = 36000, DEVICES = 7, BUTTONS = 255;

command_argument number(const char *name, double lo, double hi) { return {name, COMMAND_NUMBER, lo, hi}; }
command_argument integer(const char *name, double lo, double hi) { return {name, COMMAND_INTEGER, lo, hi}; }
command_argument word(const char *name, std::vector<std::string_view> words)
{
    return {name, COMMAND_WORD, 0, 0, std::move(words)};
}
command_argument world(const char *name) { return number(name, -WORLD_MM, WORLD_MM); }
command_argument axis(const char *name) { return number(name, -1e3, 1e3); }
command_argument count(const char *name) { return integer(name, -32768, 32767); }

const std::vector<std::string_view> DOWN_UP{"up", "down"};
const std::vector<std::string_view> ON_OFF{"off", "on"};
const std::vector<std::string_view> MEANINGS{"nothing", "apply", "undo", "redo", "clutch", "next-action", "fork",
                                             "environment-next", "menu", "raking", "silhouette", "plain", "mirror",
                                             "bare"};
const std::vector<std::string_view> HOLDABLE{"raking", "silhouette", "plain", "mirror", "bare"};

std::vector<std::string_view> action_names()
{
    std::vector<std::string_view> names;
    for (int a = 0; a < ACTION_COUNT; a++)
        names.emplace_back(action_name(static_cast<action>(a)));
    return names;
}

std::vector<command_form> device_forms()
{
    return {
        {COMMAND_PUCK, "puck",
         {integer("DEVICE", 0, DEVICES), count("X"), count("Y"), count("Z"), count("RX"), count("RY"), count("RZ")},
         "a SpaceMouse report: displacement from -350 to 350, HID frame (x right, y to the user, z down)"},
        {COMMAND_BUTTON, "button", {integer("DEVICE", 0, DEVICES), integer("N", 0, BUTTONS), word("EDGE", DOWN_UP)},
         "a puck's button goes down or up"},
        {COMMAND_PEDAL, "pedal", {integer("N", 0, 7), word("EDGE", DOWN_UP)}, "a pedal goes down or up"},
        {COMMAND_MOUSE, "mouse", {number("DX", -1e4, 1e4), number("DY", -1e4, 1e4), number("WHEEL", -1e3, 1e3)},
         "the mouse moved by pixels and wheel notches"},
        {COMMAND_RECORDING, "recording", {integer("DEVICE", 0, DEVICES), {"FILE", COMMAND_NAME, 0, 0}},
         "plays a hid-recorder file from here on, as that puck; the file lies beside the tape"},
        {COMMAND_MOVES, "moves", {word("DEVICE", {"mouse", "puck0", "puck1", "puck2", "puck3"}),
          word("WHAT", {"nothing", "scene", "tool", "light0", "light1", "light2", "light3"})},
         "which device moves what"},
        {COMMAND_MEANS_PEDAL, "means-pedal", {integer("N", 0, 7), word("WHAT", MEANINGS)}, "what a pedal does"},
        {COMMAND_MEANS_BUTTON, "means-button", {integer("N", 0, 31), word("WHAT", MEANINGS)}, "what a button does"},
        {COMMAND_SPEED, "speed", {number("MM_PER_SECOND", 0, 1e4), number("DEGREES_PER_SECOND", 0, 3600)},
         "how fast a fully deflected puck moves and turns, at a camera distance of 200 mm"},
        {COMMAND_FILTER, "filter", {number("DEAD_ZONE", 0, 0.5), number("CURVE", 0, 1)},
         "the puck's dead zone as a part of full deflection, and how cubic its response is"},
    };
}

std::vector<command_form> tool_forms()
{
    return {
        {COMMAND_APPLY, "apply", {word("EDGE", DOWN_UP)}, "begins or ends a stroke, as the apply pedal does"},
        {COMMAND_UNDO, "undo", {}, "takes the last stroke back"},
        {COMMAND_REDO, "redo", {}, "brings an undone stroke again"},
        {COMMAND_FORK, "fork", {}, "goes to the end of the next older branch of history; after the oldest, the newest"},
        {COMMAND_CLEAR, "clear", {}, "takes all clay away, as one stroke"},
        {COMMAND_TOOL,
         "tool",
         {word("SHAPE", {"ellipsoid", "box", "freeform"})},
         "ellipsoid with Wyvill's or the box-shaped potential, or the tool made last"},
        {COMMAND_MAKE_TOOL, "make-tool", {}, "duplicates the clay as the freeform tool"},
        {COMMAND_SIZE,
         "size",
         {number("A", SIZE_MM_MIN, SIZE_MM_MAX), number("B", SIZE_MM_MIN, SIZE_MM_MAX),
          number("C", SIZE_MM_MIN, SIZE_MM_MAX)},
         "semi-axes of an ellipsoid's influence, mm"},
        {COMMAND_SCALE,
         "scale",
         {number("A", SCALE_MIN, SCALE_MAX), number("B", SCALE_MIN, SCALE_MAX), number("C", SCALE_MIN, SCALE_MAX)},
         "scale of a freeform tool, 1 = as it was sculpted"},
        {COMMAND_BORDER,
         "border",
         {number("PART", 0.001, 1)},
         "width of the box-shaped potential's fall, of its radius"},
        {COMMAND_ACTION, "action", {word("ACTION", action_names())}, "what the tool does to the clay"},
        {COMMAND_COLOUR, "colour", {{"RGB", COMMAND_RGB, 0, 0}}, "the tool's colour, #rrggbb"},
        {COMMAND_RATE,
         "rate",
         {number("PER_SECOND", 0, RATE_MAX)},
         "potential deposited or taken per second; for smooth, stamp, print the part done per second"},
        {COMMAND_SPACING,
         "spacing",
         {number("PART", 0.02, 1)},
         "distance between dabs, of the tool's smallest semi-axis"},
        {COMMAND_DEFORM,
         "deform",
         {number("S", 0, 3), number("M", 0.001, 3), number("R", 0.001, 3), number("N", 0, 3), number("KAPPA", 0, 1000)},
         "the stamp's deformation function; S is 1.5, S + M + R at most 3"},
        {COMMAND_PLACE, "place", {world("X"), world("Y"), world("Z")}, "puts the tool there, mm"},
        {COMMAND_TURN,
         "turn",
         {axis("AX"), axis("AY"), axis("AZ"), number("DEGREES", -TURN_DEGREES, TURN_DEGREES)},
         "sets the tool's orientation: so many degrees about that axis"},
        {COMMAND_GLIDE,
         "glide",
         {world("X"), world("Y"), world("Z"), number("MS", 0, GLIDE_MS_MAX)},
         "moves the tool there on a straight line within that time"},
        {COMMAND_SPIN,
         "spin",
         {axis("AX"), axis("AY"), axis("AZ"), number("DEGREES", -TURN_DEGREES, TURN_DEGREES),
          number("MS", 0, GLIDE_MS_MAX)},
         "turns the tool about its own place within that time"},
        {COMMAND_ORBIT,
         "orbit",
         {world("X"), world("Y"), world("Z"), axis("AX"), axis("AY"), axis("AZ"),
          number("DEGREES", -TURN_DEGREES, TURN_DEGREES), number("MS", 0, GLIDE_MS_MAX)},
         "carries the tool round the line through X Y Z along AX AY AZ within that time"},
    };
}

std::vector<command_form> look_forms()
{
    return {
        {COMMAND_VIEW,
         "view",
         {axis("AX"), axis("AY"), axis("AZ"), number("DEGREES", -TURN_DEGREES, TURN_DEGREES),
          number("DISTANCE", 0.1, 1e6)},
         "turns the scene and sets the eye's distance, mm"},
        {COMMAND_DISTANCE, "distance", {number("DISTANCE", 0.1, 1e6)}, "sets the eye's distance alone, mm"},
        {COMMAND_CENTRE, "centre", {world("X"), world("Y"), world("Z")}, "the point that the eye looks at, mm"},
        {COMMAND_LOOK,
         "look",
         {word("LOOK", {"clay", "plain", "silhouette", "raking"})},
         "clay: lit by all around it; plain: by the lights alone; silhouette: its outline; raking: one grazing light"},
        {COMMAND_STRUCTURE,
         "structure",
         {word("WHAT", {"surface", "stored", "crossing"})},
         "shows the surface, all cubes that have a corner stored, or those that the surface passes through"},
        {COMMAND_SCENERY,
         "scenery",
         {word("SCENERY", {"studio", "window", "strips", "night", "own"})},
         "what surrounds the piece, lights it and is mirrored in it; own: the picture that was brought last"},
        {COMMAND_SCENERY_PICTURE,
         "scenery-picture",
         {{"FILE", COMMAND_NAME, 0, 0}},
         "brings a PNG beside the tape as scenery: a picture of a mirror ball, or a panorama twice as wide as high"},
        {COMMAND_ENVIRONMENT,
         "environment",
         {word("MODE", {"none", "opaque", "semi", "clearcoat"}), number("STRENGTH", 0, 1)},
         "the layer that mirrors the scenery; STRENGTH is the semi-transparent layer's weight"},
        {COMMAND_ENVIRONMENT_NEXT, "environment-next", {}, "goes from none to opaque, semi, clearcoat, and round"},
        {COMMAND_OCCLUSION, "occlusion", {number("PART", 0, 1)}, "how much darker hollows are"},
        {COMMAND_SHADOWS, "shadows", {word("SHOWN", ON_OFF)}, "whether the first light throws shadows"},
        {COMMAND_FLOOR, "floor", {word("SHOWN", ON_OFF)}, "draws the turntable at the workspace's bottom or not"},
        {COMMAND_BLUR, "blur", {number("PART", 0, 1)}, "depth of field: how wide the lens is open; the work is sharp"},
        {COMMAND_MIRROR, "mirror", {word("SHOWN", ON_OFF)}, "shows left for right: what is lopsided strikes the eye"},
        {COMMAND_HOLD,
         "hold",
         {word("WHAT", HOLDABLE), word("EDGE", DOWN_UP)},
         "a look or an effect for as long as it is held; afterwards everything is as it was"},
        {COMMAND_STEREO,
         "stereo",
         {word("LAYOUT", {"mono", "side-half", "side-full", "top-half", "top-full", "rows", "columns", "checker",
                          "anaglyph", "packed"})},
         "how the two eyes' pictures share the screen"},
        {COMMAND_STEREO_EYES,
         "stereo-eyes",
         {number("SEPARATION", 0, 0.2), number("DEPTH", 0.25, 4)},
         "the eyes' separation as a part of the distance of the plane of zero parallax, and that, of the work's"},
        {COMMAND_STEREO_SWAP, "stereo-swap", {word("SWAPPED", ON_OFF)}, "gives each eye the other's picture"},
    };
}

std::vector<command_form> picture_forms()
{
    return {
        {COMMAND_LIGHT,
         "light",
         {integer("N", 0, 3),
          world("X"),
          world("Y"),
          world("Z"),
          {"RGB", COMMAND_RGB, 0, 0},
          number("STRENGTH", 0, 100),
          word("WITH", {"scene", "viewer"})},
         "lights a light and says with what it moves"},
        {COMMAND_LIGHT_OFF, "light-off", {integer("N", 0, 3)}, "puts a light out"},
        {COMMAND_LIGHT_WITH,
         "light-with",
         {integer("N", 0, 3), word("WITH", {"scene", "viewer"})},
         "says with what a light moves; it stays where it is"},
        {COMMAND_LIGHTS_SHOWN, "lights-shown", {word("SHOWN", ON_OFF)}, "draws the lights as small spheres or not"},
        {COMMAND_KEEPING_SHOWN,
         "keeping-shown",
         {word("SHOWN", ON_OFF)},
         "says in the corner whether all is kept: green when it is, amber until then, red when it cannot be"},
        {COMMAND_STRIP_SHOWN,
         "strip-shown",
         {word("SHOWN", ON_OFF)},
         "draws the strip at the bottom: what is kept, what the puck holds, what each pedal does, the tool"},
        {COMMAND_MATERIAL,
         "material",
         {number("SPECULAR", 0, 1), number("SHININESS", 1, 1000), number("AMBIENT", 0, 1)},
         "how the clay shines"},
        {COMMAND_TOOL_STYLE,
         "tool-style",
         {word("STYLE", {"hidden", "wireframe", "transparent"})},
         "how the tool is drawn"},
        {COMMAND_WORKSPACE,
         "workspace",
         {world("X0"), world("Y0"), world("Z0"), world("X1"), world("Y1"), world("Z1")},
         "the workspace box, mm; it bounds nothing"},
        {COMMAND_WORKSPACE_FIT, "workspace-fit", {}, "puts the workspace box round the piece"},
        {COMMAND_WORKSPACE_SHOWN, "workspace-shown", {word("SHOWN", ON_OFF)}, "draws the workspace box or not"},
        {COMMAND_PICTURE,
         "picture",
         {{"FILE", COMMAND_NAME, 0, 0}},
         "a picture of this moment, where pictures are wanted"},
        {COMMAND_TURNTABLE,
         "turntable",
         {{"FILE", COMMAND_NAME, 0, 0}, integer("FRAMES", 1, COMMAND_FRAMES_MAX)},
         "pictures FILE-000.png, FILE-001.png ... of this moment's piece in one full turn, where pictures are wanted"},
        {COMMAND_EXPORT,
         "export",
         {{"FILE", COMMAND_NAME, 0, 0}},
         "the piece as it is now as a file, where pictures are wanted; its ending says which format"},
        {COMMAND_NAMES_FROM,
         "names-from",
         {integer("N", 1, 999999)},
         "the next picture or export that a menu asks for is called by this number, the one after it by the next"},
    };
}

std::vector<command_form> forms_make()
{
    std::vector<command_form> all;
    for (std::vector<command_form> (*make)() : {device_forms, tool_forms, look_forms, picture_forms})
        for (command_form &form : make())
            all.push_back(std::move(form));
    return all;
}

std::string_view word_take(std::string_view *rest)
{
    size_t from = rest->find_first_not_of(" \t");
    if (from == std::string_view::npos) {
        *rest = {};
        return {};
    }
    size_t to = rest->find_first_of(" \t", from);
    std::string_view taken = rest->substr(from, to == std::string_view::npos ? to : to - from);
    *rest = to == std::string_view::npos ? std::string_view{} : rest->substr(to);
    return taken;
}

std::string words_joined(const std::vector<std::string_view> &words)
{
    std::string out;
    for (std::string_view w : words)
        out += (out.empty() ? "" : ", ") + std::string(w);
    return out;
}

std::string expected_of(const command_argument &a)
{
    switch (a.kind) {
    case COMMAND_NUMBER:
        return std::string(a.name) + ", a number from " + command_number_text(a.lo) + " to " +
               command_number_text(a.hi);
    case COMMAND_INTEGER:
        return std::string(a.name) + ", a whole number from " + command_number_text(a.lo) + " to " +
               command_number_text(a.hi);
    case COMMAND_WORD: return std::string(a.name) + ", one of: " + words_joined(a.words);
    case COMMAND_RGB: return std::string(a.name) + ", a colour as #rrggbb";
    case COMMAND_NAME: return std::string(a.name) + ", a file name of letters, digits, '.', '_', '-' (no folder)";
    }
    return a.name;
}

bool name_is_plain(std::string_view text)
{
    if (text.empty() || text.size() > 100 || text[0] == '.' || text[0] == '-')
        return false;
    for (char c : text)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
              c == '-'))
            return false;
    return true;
}

bool rgb_parse(std::string_view text, double *out)
{
    uint32_t rgb = 0;
    if (text.size() != 7 || text[0] != '#')
        return false;
    auto r = std::from_chars(text.data() + 1, text.data() + 7, rgb, 16);
    *out = rgb;
    return r.ec == std::errc{} && r.ptr == text.data() + 7;
}

bool argument_parse(const command_argument &a, std::string_view text, double *number_out, std::string *name_out)
{
    const char *end = text.data() + text.size();
    switch (a.kind) {
    case COMMAND_NUMBER:
    case COMMAND_INTEGER: {
        auto r = std::from_chars(text.data(), end, *number_out);
        bool whole = a.kind == COMMAND_NUMBER || *number_out == std::floor(*number_out);
        return r.ec == std::errc{} && r.ptr == end && *number_out >= a.lo && *number_out <= a.hi && whole;
    }
    case COMMAND_WORD:
        for (size_t n = 0; n < a.words.size(); n++)
            if (a.words[n] == text) {
                *number_out = static_cast<double>(n);
                return true;
            }
        return false;
    case COMMAND_RGB: return rgb_parse(text, number_out);
    case COMMAND_NAME: *name_out = text; return name_is_plain(text);
    }
    return false;
}

/* What no single argument can say. */
bool whole_fits(const command &c, std::string *expected_out)
{
    const auto &n = c.number;
    deform d;
    if (c.kind == COMMAND_DEFORM && deform_init(&d, n[0], n[1], n[2], n[3], n[4]) != STATUS_OK) {
        *expected_out = "S = 1.5 and S + M + R at most 3";
        return false;
    }
    bool turns = c.kind == COMMAND_TURN || c.kind == COMMAND_SPIN || c.kind == COMMAND_VIEW || c.kind == COMMAND_ORBIT;
    int first = c.kind == COMMAND_ORBIT ? 3 : 0;
    if (turns && n[first] * n[first] + n[first + 1] * n[first + 1] + n[first + 2] * n[first + 2] < 1e-12) {
        *expected_out = "an axis AX AY AZ that is not zero";
        return false;
    }
    if (c.kind == COMMAND_EXPORT && exchange_format_of(c.name) == EXCHANGE_UNKNOWN) {
        *expected_out = "FILE, a name that ends in one of " + exchange_endings();
        return false;
    }
    if (c.kind == COMMAND_WORKSPACE && !(n[0] < n[3] && n[1] < n[4] && n[2] < n[5])) {
        *expected_out = "X0 < X1, Y0 < Y1, Z0 < Z1";
        return false;
    }
    return true;
}

} // namespace

std::span<const command_form> command_forms()
{
    static const std::vector<command_form> forms = forms_make();
    return forms;
}

std::string command_usage(const command_form &form)
{
    std::string out(form.name);
    for (const command_argument &a : form.arguments)
        out += std::string(" ") + a.name;
    return out;
}

std::string command_number_text(double v)
{
    char text[40];
    auto r = std::to_chars(text, text + sizeof text, v);
    return std::string(text, r.ptr);
}

std::optional<command> command_parse(std::string_view text, std::string *expected_out)
{
    std::string_view name = word_take(&text);
    for (const command_form &form : command_forms()) {
        if (form.name != name)
            continue;
        command c;
        c.kind = form.kind;
        size_t n = 0;
        for (const command_argument &a : form.arguments)
            if (!argument_parse(a, word_take(&text), &c.number[n++], &c.name)) {
                *expected_out = expected_of(a) + " (" + command_usage(form) + ")";
                return std::nullopt;
            }
        if (!word_take(&text).empty()) {
            *expected_out = "nothing after \"" + command_usage(form) + "\"";
            return std::nullopt;
        }
        if (!whole_fits(c, expected_out))
            return std::nullopt;
        return c;
    }
    *expected_out = "a command, such as \"place X Y Z\" (glaise --help lists them)";
    return std::nullopt;
}

std::string command_text(const command &c)
{
    const command_form &form = command_forms()[c.kind];
    std::string out(form.name);
    size_t n = 0;
    for (const command_argument &a : form.arguments) {
        double v = c.number[n++];
        out += ' ';
        switch (a.kind) {
        case COMMAND_NUMBER:
        case COMMAND_INTEGER: out += command_number_text(v); break;
        case COMMAND_WORD: out += a.words[static_cast<size_t>(v)]; break;
        case COMMAND_NAME: out += c.name; break;
        case COMMAND_RGB: {
            char hex[8];
            snprintf(hex, sizeof hex, "#%06x", static_cast<unsigned>(v));
            out += hex;
        }
        }
    }
    return out;
}
