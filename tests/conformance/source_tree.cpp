/* SPDX-License-Identifier: Apache-2.0 */
#include "source_tree.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace {

const std::filesystem::path root = SOURCE_ROOT;

std::string text_of(const std::filesystem::path &path)
{
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        throw std::runtime_error(path.string() + ": cannot be read");
    }
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

bool is_backup(const std::string &name)
{
    return name.empty() || name[0] == '.' || name.back() == '~' || name.ends_with(".orig") || name.ends_with(".pyc");
}

} // namespace

std::vector<source_tree_file> source_tree_read(const std::vector<std::string> &folders)
{
    std::vector<source_tree_file> files;
    for (const std::string &folder : folders) {
        if (!std::filesystem::is_directory(root / folder)) {
            continue;
        }
        for (const auto &entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            if (entry.is_regular_file() && !is_backup(entry.path().filename().string())) {
                files.push_back({entry.path().lexically_relative(root).generic_string(), text_of(entry.path())});
            }
        }
    }
    std::sort(files.begin(), files.end(),
              [](const source_tree_file &a, const source_tree_file &b) { return a.path < b.path; });
    return files;
}

std::optional<std::vector<std::string>> source_tree_listed()
{
    if (!std::filesystem::exists(root / ".git")) {
        return std::nullopt;
    }
    /* A checkout owned by someone else (a container, a shared folder) is still worth listing. */
    const std::string command = "git -c safe.directory='*' -C '" + root.string() +
                                "' ls-files -z --cached --others --exclude-standard 2>/dev/null";
    FILE *pipe = popen(command.c_str(), "r");
    if (pipe == nullptr) {
        return std::nullopt;
    }
    std::string all;
    char piece[4096];
    for (size_t n; (n = fread(piece, 1, sizeof piece, pipe)) > 0;) {
        all.append(piece, n);
    }
    if (pclose(pipe) != 0) {
        return std::nullopt;
    }
    std::vector<std::string> paths;
    std::istringstream in(all);
    for (std::string path; std::getline(in, path, '\0');) {
        paths.push_back(path);
    }
    return paths;
}

std::string source_tree_folder(std::string_view path)
{
    const size_t slash = path.rfind('/');
    return slash == std::string_view::npos ? "" : std::string(path.substr(0, slash));
}

std::string source_tree_room(std::string_view path)
{
    const std::string folder = source_tree_folder(path);
    const size_t slash = folder.rfind('/');
    return slash == std::string::npos ? folder : folder.substr(slash + 1);
}

std::string source_tree_stem(std::string_view path)
{
    const size_t slash = path.rfind('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    return std::string(name.substr(0, name.find('.')));
}

std::string source_tree_extension(std::string_view path)
{
    const size_t slash = path.rfind('/');
    const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
    const size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? "" : std::string(name.substr(dot));
}

bool source_tree_is_header(std::string_view path)
{
    return path.ends_with(".h");
}

bool source_tree_is_code(std::string_view path)
{
    return path.ends_with(".h") || path.ends_with(".c") || path.ends_with(".cpp");
}

std::vector<std::string> source_tree_lines(std::string_view text)
{
    std::vector<std::string> lines;
    std::istringstream in{std::string(text)};
    for (std::string line; std::getline(in, line);) {
        lines.push_back(line);
    }
    return lines;
}

std::string source_tree_join(const source_tree_complaints &complaints)
{
    std::string all = std::to_string(complaints.size()) + " complaint(s)\n";
    for (const std::string &complaint : complaints) {
        all += complaint + "\n";
    }
    return all;
}
