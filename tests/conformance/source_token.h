/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   C and C++ text cut into words, comments kept apart. Enough for laws about names and lengths.
 * Is not: a preprocessor: macros are not expanded, both sides of an #if are read.
 * Shape:  comments and directives are tokens too; a directive is one token holding its whole logical line, without
 *         comments, continuation lines joined. Punctuation is one character a token, but for "::" "->" "==" "!=" "<="
 *         ">=" "&&" "||" and "...".
 * Errors: text that ends inside a comment or literal ends that token at the end of the text.
 */
#ifndef GLAISE_CONFORMANCE_SOURCE_TOKEN_H
#define GLAISE_CONFORMANCE_SOURCE_TOKEN_H

#include <string>
#include <string_view>
#include <vector>

enum class source_token_kind { word, number, text, punctuation, directive, comment };

struct source_token {
    source_token_kind kind;
    std::string text;
    int line; /* of its first character, from 1 */
};

std::vector<source_token> source_token_cut(std::string_view text);

/* The same without comments. */
std::vector<source_token> source_token_cut_code(std::string_view text);

struct source_token_include {
    std::string path;
    bool quoted; /* "path", not <path> */
    int line;
};

std::vector<source_token_include> source_token_includes(std::string_view text);

/* "#define NAME ..." -> directive "define", rest "NAME ...". */
std::string source_token_directive(const source_token &token, std::string *rest);

/* The identifier a text begins with. */
std::string source_token_leading_word(std::string_view text);

#endif
