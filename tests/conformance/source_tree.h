/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   the files of the repository as texts, for tests that read the tree instead of running it. Paths are relative
 *         to the root and written with '/'.
 * Is not: a parser; words are source_token.h, declarations are source_scan.h.
 * Owner:  everything is returned by value.
 * Errors: a file that cannot be read throws std::runtime_error naming it; a folder that is not there is empty.
 */
#ifndef GLAISE_CONFORMANCE_SOURCE_TREE_H
#define GLAISE_CONFORMANCE_SOURCE_TREE_H

#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct source_tree_file {
    std::string path;
    std::string text;
};

/* What a test reports: one line per trouble, "path:line: what is wrong". */
using source_tree_complaints = std::vector<std::string>;

/* All regular files under the named folders of the root, sorted by path. Editors' backups are left out. */
std::vector<source_tree_file> source_tree_read(const std::vector<std::string> &folders);

/* The files git tracks or would add, or nothing where there is no git or no repository. */
std::optional<std::vector<std::string>> source_tree_listed();

/* "src/clay/brick.h" -> folder "src/clay", room "clay", stem "brick", extension ".h". */
std::string source_tree_folder(std::string_view path);
std::string source_tree_room(std::string_view path);
std::string source_tree_stem(std::string_view path);
std::string source_tree_extension(std::string_view path);

bool source_tree_is_header(std::string_view path);

/* C and C++ files, headers included. */
bool source_tree_is_code(std::string_view path);

std::vector<std::string> source_tree_lines(std::string_view text);

std::string source_tree_join(const source_tree_complaints &complaints);

#endif
