/* SPDX-License-Identifier: Apache-2.0 */
#include "golden_tape.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <sys/wait.h>

namespace {

const std::string folder_here = SOURCE_ROOT "/tests/golden/";

/* Words of every line that is not a comment. */
std::vector<std::vector<std::string>> table_read(const std::string &path)
{
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(golden_tape_text(path));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream in(line);
        std::vector<std::string> words;
        for (std::string word; in >> word;)
            words.push_back(word);
        if (!words.empty() && words[0][0] != '#')
            rows.push_back(std::move(words));
    }
    return rows;
}

std::string quoted(const std::string &word)
{
    std::string out = "'";
    for (char c : word)
        out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::string value_of(const std::string &json, const std::string &key)
{
    const std::string mark = "\"" + key + "\": \"";
    const size_t at = json.find(mark);
    return at == std::string::npos ? "" : json.substr(at + mark.size(), 16);
}

} // namespace

std::vector<golden_tape> golden_tape_list()
{
    std::vector<golden_tape> list;
    for (const auto &row : table_read(folder_here + "tapes.txt"))
        if (row.size() >= 3)
            list.push_back({row[0], row[1], row[2], {row.begin() + 3, row.end()}});
    return list;
}

std::vector<golden_tape_digests> golden_tape_recorded()
{
    std::vector<golden_tape_digests> list;
    for (const auto &row : table_read(folder_here + "digests.txt"))
        if (row.size() == 3)
            list.push_back({row[0], row[1], row[2]});
    return list;
}

golden_tape_digests golden_tape_digests_of(const std::string &name, const std::string &json)
{
    const std::string whole = json.substr(0, json.find("\"dab\": [")); /* each dab has digests of its own */
    return {name, value_of(whole, "field_digest"), value_of(whole, "mesh_digest")};
}

std::string golden_tape_folder(const std::string &name)
{
    const std::string folder = GOLDEN_OUTPUT "/" + name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

golden_tape_outcome golden_tape_replay(const golden_tape &tape, const std::string &folder,
                                       const std::vector<std::string> &words)
{
    std::string line = quoted(GLAISE_PROGRAM) + " replay " + quoted(SOURCE_ROOT "/" + tape.path) + " --settings " +
                       quoted(SOURCE_ROOT "/config/station.tape") + " --step " + tape.step_mm;
    for (const std::string &word : words)
        line += " " + quoted(word);
    line += " >" + quoted(folder + "/said.txt") + " 2>&1 </dev/null";
    const int answer = std::system(line.c_str());
    return {WIFEXITED(answer) ? WEXITSTATUS(answer) : -1, golden_tape_text(folder + "/said.txt")};
}

std::string golden_tape_text(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::ostream &operator<<(std::ostream &out, const golden_tape &tape) { return out << tape.name; }
