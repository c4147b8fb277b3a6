/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: knowledge flows only along the arrows of the design's section "Rooms"; a sibling, an upward or a sideways
 *       include is an error. And what a file uses of the standard algorithms it includes itself: other releases of the
 *       library bring them along elsewhere, or nowhere.
 * Method: every #include "..." in src and platform is looked up in the table below, which is that section line by
 *       line. Each wrong arrow the table must catch is planted once. */
#include "source_token.h"
#include "source_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

/* Room -> what it may include besides itself: a room, or one header of a room. A chain a -> b -> c lets a include c;
 * sculpture and what stands behind exchange and station are doors: behind a door only what the door itself shows. */
const std::map<std::string, std::set<std::string>> arrows = {
    {"src/main.cpp", {"src/wiring"}},
    {"src/wiring",
     {"src/station", "src/view", "src/exchange", "src/history/byte_store.h", "platform/device_event.h",
      "platform/display", "platform/spacemouse", "platform/pedals", "platform/desk", "platform/storage",
      "platform/service"}},
    {"src/view", {"src/station/snapshot.h", "src/sculpture"}},
    {"src/station", {"src/sculpture", "src/exchange"}},
    {"src/exchange", {"src/sculpture", "src/solid"}},
    {"src/sculpture",
     {"src/tool", "src/surface", "src/history", "src/solid", "src/particle", "src/clay", "src/lattice"}},
    {"src/tool", {"src/clay", "src/lattice"}},
    {"src/surface", {"src/clay", "src/lattice"}},
    {"src/history", {"src/clay", "src/lattice"}},
    {"src/solid", {"src/clay", "src/lattice"}},
    {"src/particle", {"src/clay", "src/lattice"}},
    {"src/clay", {"src/lattice"}},
    {"src/lattice", {}},
    {"platform/device_event.h", {}},
    {"platform/display", {"platform/device_event.h", "platform/service/log.h"}},
    {"platform/spacemouse", {"platform/device_event.h", "platform/service/log.h"}},
    {"platform/pedals", {"platform/device_event.h", "platform/service/log.h"}},
    {"platform/desk", {"platform/device_event.h", "platform/service/log.h"}},
    {"platform/storage", {"platform/device_event.h", "platform/service/log.h"}},
    {"platform/service", {"platform/device_event.h"}},
};

const std::set<std::string> room_words = {"lattice", "clay",  "tool",    "surface",   "history", "solid",
                                          "particle", "view", "station", "sculpture", "wiring",  "exchange"};

/* The node of the graph a file belongs to: a room, or itself where it stands outside the rooms. */
std::string node_of(const std::string &path)
{
    return arrows.count(path) != 0 ? path : source_tree_folder(path);
}

/* "clay/brick.h" is src/clay/brick.h; platform's headers say platform. */
std::string target_of(const std::string &include)
{
    return include.starts_with("platform/") ? include : "src/" + include;
}

source_tree_complaints wrong_arrows(const source_tree_file &file, const std::set<std::string> &paths)
{
    source_tree_complaints complaints;
    const std::string node = node_of(file.path);
    const auto allowed = arrows.find(node);
    if (allowed == arrows.end()) {
        return {file.path + ":1: no room of the design"};
    }
    for (const source_token_include &include : source_token_includes(file.text)) {
        const std::string at = file.path + ":" + std::to_string(include.line) + ": ";
        const std::string first = include.path.substr(0, include.path.find('/'));
        if (!include.quoted) {
            if (room_words.count(first) != 0 || first == "platform" || first == "tests" || first == "src") {
                complaints.push_back(at + "<" + include.path + "> is ours: write it in quotes");
            }
            continue;
        }
        const std::string target = target_of(include.path);
        if (paths.count(target) == 0) {
            complaints.push_back(at + "\"" + include.path + "\" is no file under src/, nor one of platform/");
        } else if (node_of(target) != node && allowed->second.count(target) == 0 &&
                   allowed->second.count(source_tree_folder(target)) == 0) {
            complaints.push_back(at + node + " may not include \"" + include.path + "\"");
        }
    }
    return complaints;
}

/* What only <algorithm> promises. */
const std::set<std::string> algorithms = {
    "min",         "max",         "clamp",     "minmax",      "min_element", "max_element", "sort",
    "stable_sort", "nth_element", "is_sorted", "lower_bound", "upper_bound", "any_of",      "all_of",
    "none_of",     "find",        "find_if",   "count",       "count_if",    "copy",        "copy_n",
    "copy_if",     "fill",        "fill_n",    "equal",       "reverse",     "rotate",      "transform",
    "unique",      "remove_if", "shuffle",     "generate",    "replace",     "replace_if"};

/* std::min( without #include <algorithm>; one complaint a file is enough. */
source_tree_complaints borrowed_algorithms(const source_tree_file &file)
{
    for (const source_token_include &include : source_token_includes(file.text)) {
        if (include.path == "algorithm") {
            return {};
        }
    }
    const std::vector<source_token> tokens = source_token_cut_code(file.text);
    for (size_t i = 0; i + 3 < tokens.size(); ++i) {
        if (tokens[i].text == "std" && tokens[i + 1].text == "::" && algorithms.count(tokens[i + 2].text) != 0 &&
            (tokens[i + 3].text == "(" || tokens[i + 3].text == "<")) {
            return {file.path + ":" + std::to_string(tokens[i].line) + ": std::" + tokens[i + 2].text +
                    " without <algorithm>"};
        }
    }
    return {};
}

std::set<std::string> paths_of(const std::vector<source_tree_file> &files)
{
    std::set<std::string> paths;
    for (const source_tree_file &file : files) {
        paths.insert(file.path);
    }
    return paths;
}

TEST(include_graph, follows_the_arrows)
{
    const std::vector<source_tree_file> files = source_tree_read({"src", "platform"});
    const std::set<std::string> paths = paths_of(files);
    source_tree_complaints complaints;
    size_t count = 0;
    for (const source_tree_file &file : files) {
        if (source_tree_is_code(file.path)) {
            const source_tree_complaints more = wrong_arrows(file, paths);
            complaints.insert(complaints.end(), more.begin(), more.end());
            count += source_token_includes(file.text).size();
        }
    }
    EXPECT_GT(count, 50u) << "the tree was not read";
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(include_graph, algorithms_are_not_borrowed)
{
    source_tree_complaints complaints;
    for (const source_tree_file &file : source_tree_read({"src", "platform", "tests"})) {
        if (source_tree_is_code(file.path)) {
            const source_tree_complaints more = borrowed_algorithms(file);
            complaints.insert(complaints.end(), more.begin(), more.end());
        }
    }
    EXPECT_TRUE(complaints.empty()) << source_tree_join(complaints);
}

TEST(include_graph, planted_borrowed_algorithms_are_seen)
{
    EXPECT_EQ(borrowed_algorithms({"a.cpp", "#include <vector>\nint f(int a) { return std::min(a, 3); }\n"}).size(),
              1u);
    EXPECT_EQ(borrowed_algorithms({"a.cpp", "int f(int a) { return std::max<int>(a, 3); }\n"}).size(), 1u);
    EXPECT_EQ(borrowed_algorithms({"a.cpp", "#include <algorithm>\nint f(int a) { return std::min(a, 3); }\n"}).size(),
              0u);
    EXPECT_EQ(borrowed_algorithms({"a.cpp", "size_t f(std::string a) { return a.find(3) + box::min(1, 2); }\n"}).size(),
              0u);
}

/* The files the planted includes name. */
const std::set<std::string> planted_paths = {
    "src/lattice/key.h",   "src/clay/brick.h",        "src/tool/action.h",        "src/surface/patch.h",
    "src/history/ring.h",  "src/history/byte_store.h", "src/sculpture/sculpture.h", "src/solid/tree.h",
    "src/exchange/ply.h",  "src/station/snapshot.h",  "src/station/station.h",    "src/view/frame.h",
    "src/wiring/loop.h",   "platform/display/egl.h",  "platform/device_event.h",  "platform/service/log.h",
    "platform/service/watchdog.h"};

size_t planted(const std::string &path, const std::string &include)
{
    return wrong_arrows({path, "#include " + include + "\n"}, planted_paths).size();
}

struct arrow {
    const char *from;
    const char *include;
};

TEST(include_graph, a_planted_wrong_arrow_is_seen)
{
    const arrow wrong[] = {
        {"src/tool/a.c", "\"surface/patch.h\""},        {"src/surface/a.c", "\"history/ring.h\""},
        {"src/lattice/a.c", "\"clay/brick.h\""},        {"src/clay/a.c", "\"tool/action.h\""},
        {"src/sculpture/a.c", "\"station/station.h\""}, {"src/sculpture/a.c", "\"exchange/ply.h\""},
        {"src/exchange/a.c", "\"clay/brick.h\""},       {"src/exchange/a.c", "\"station/station.h\""},
        {"src/station/a.cpp", "\"view/frame.h\""},      {"src/station/a.cpp", "\"clay/brick.h\""},
        {"src/view/a.cpp", "\"station/station.h\""},    {"src/view/a.cpp", "\"surface/patch.h\""},
        {"src/wiring/a.cpp", "\"clay/brick.h\""},       {"src/wiring/a.cpp", "\"history/ring.h\""},
        {"src/main.cpp", "\"station/station.h\""},      {"src/main.cpp", "\"platform/display/egl.h\""},
        {"src/clay/a.c", "\"platform/service/log.h\""}, {"platform/display/a.c", "\"clay/brick.h\""},
        {"platform/display/a.c", "\"platform/service/watchdog.h\""},
        {"platform/storage/a.c", "\"platform/display/egl.h\""},
        {"platform/device_event.h", "\"platform/service/log.h\""},
        {"src/clay/a.c", "\"brick.h\""},                {"src/clay/a.c", "<clay/brick.h>"},
        {"src/clay/a.c", "\"../lattice/key.h\""},       {"src/clay/a.c", "\"lattice/gone.h\""},
        {"src/surprise/a.c", "\"lattice/key.h\""},
    };
    for (const arrow &one : wrong) {
        EXPECT_EQ(planted(one.from, one.include), 1u) << one.from << " includes " << one.include;
    }
}

TEST(include_graph, the_arrows_of_the_design_are_open)
{
    const arrow right[] = {
        {"src/clay/a.c", "\"clay/brick.h\""},          {"src/clay/a.c", "\"lattice/key.h\""},
        {"src/tool/a.c", "\"clay/brick.h\""},          {"src/sculpture/a.c", "\"surface/patch.h\""},
        {"src/exchange/a.c", "\"solid/tree.h\""},      {"src/station/a.cpp", "\"exchange/ply.h\""},
        {"src/view/a.cpp", "\"station/snapshot.h\""},  {"src/wiring/a.cpp", "\"history/byte_store.h\""},
        {"src/main.cpp", "\"wiring/loop.h\""},         {"src/wiring/a.cpp", "\"platform/display/egl.h\""},
        {"src/clay/a.c", "<stdint.h>"},                {"platform/display/a.c", "\"platform/device_event.h\""},
        {"platform/display/a.c", "\"platform/service/log.h\""},
    };
    for (const arrow &one : right) {
        EXPECT_EQ(planted(one.from, one.include), 0u) << one.from << " includes " << one.include;
    }
}

} // namespace
