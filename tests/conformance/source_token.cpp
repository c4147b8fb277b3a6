/* SPDX-License-Identifier: Apache-2.0 */
#include "source_token.h"

#include <algorithm>
#include <array>

namespace {

bool is_word_start(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

bool is_word(char c)
{
    return is_word_start(c) || is_digit(c);
}

bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

/* Whether a sign may follow: 1e-3, 0x1p-3, but not 0xe-3. */
bool is_exponent(const std::string &number)
{
    const bool is_hex = number.starts_with("0x") || number.starts_with("0X");
    return !number.empty() && std::string_view(is_hex ? "pP" : "eE").find(number.back()) != std::string_view::npos;
}

class cutter {
public:
    explicit cutter(std::string_view text) : text_(text) {}

    std::vector<source_token> cut()
    {
        while (at_ < text_.size()) {
            one();
        }
        return std::move(tokens_);
    }

private:
    char peek(size_t ahead = 0) const
    {
        return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
    }

    char take()
    {
        const char c = text_[at_++];
        if (c == '\n') {
            ++line_;
        }
        return c;
    }

    void keep(source_token_kind kind, std::string text, int line)
    {
        tokens_.push_back({kind, std::move(text), line});
    }

    void one()
    {
        const char c = peek();
        if (c == '\n') {
            line_is_fresh_ = true;
        }
        if (is_blank(c) || c == '\\') {
            take();
        } else if (c == '/' && (peek(1) == '/' || peek(1) == '*')) {
            const int line = line_;
            keep(source_token_kind::comment, comment(), line);
        } else if (c == '#' && line_is_fresh_) {
            directive();
        } else {
            line_is_fresh_ = false;
            ordinary(c);
        }
    }

    void ordinary(char c)
    {
        const int line = line_;
        if (is_word_start(c)) {
            std::string word;
            while (is_word(peek())) {
                word += take();
            }
            if ((word == "R" || word == "u8R" || word == "LR") && peek() == '"') {
                keep(source_token_kind::text, word + raw_literal(), line);
            } else {
                keep(source_token_kind::word, word, line);
            }
        } else if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
            keep(source_token_kind::number, number(), line);
        } else if (c == '"' || c == '\'') {
            keep(source_token_kind::text, literal(), line);
        } else {
            keep(source_token_kind::punctuation, punctuation(), line);
        }
    }

    std::string comment()
    {
        std::string out;
        if (peek(1) == '/') {
            while (at_ < text_.size() && peek() != '\n') {
                out += take();
            }
            return out;
        }
        out += take();
        out += take();
        while (at_ < text_.size()) {
            if (peek() == '*' && peek(1) == '/') {
                out += take();
                out += take();
                break;
            }
            out += take();
        }
        return out;
    }

    std::string literal()
    {
        const char quote = peek();
        std::string out(1, take());
        while (at_ < text_.size() && peek() != '\n') {
            const char c = take();
            out += c;
            if (c == quote) {
                break;
            }
            if (c == '\\' && at_ < text_.size()) {
                out += take();
            }
        }
        return out;
    }

    std::string raw_literal()
    {
        std::string out(1, take());
        std::string fence = ")";
        while (at_ < text_.size() && peek() != '(') {
            fence += peek();
            out += take();
        }
        fence += '"';
        while (at_ < text_.size() && !out.ends_with(fence)) {
            out += take();
        }
        return out;
    }

    std::string number()
    {
        std::string out;
        while (is_word(peek()) || peek() == '.' || (peek() == '\'' && is_word(peek(1))) ||
               ((peek() == '+' || peek() == '-') && is_exponent(out))) {
            out += take();
        }
        return out;
    }

    std::string punctuation()
    {
        static const std::array<std::string_view, 9> long_ones = {"...", "::", "->", "==", "!=",
                                                                  "<=",  ">=", "&&", "||"};
        for (const std::string_view one : long_ones) {
            if (text_.substr(at_, one.size()) == one) {
                at_ += one.size();
                return std::string(one);
            }
        }
        return std::string(1, take());
    }

    void directive()
    {
        const int line = line_;
        std::string out;
        while (at_ < text_.size() && peek() != '\n') {
            if (peek() == '/' && (peek(1) == '/' || peek(1) == '*')) {
                comment();
                out += ' ';
            } else if (peek() == '\\' && peek(1) == '\n') {
                take();
                take();
                out += ' ';
            } else if (peek() == '"') {
                out += literal();
            } else {
                out += take();
            }
        }
        keep(source_token_kind::directive, out, line);
    }

    std::string_view text_;
    size_t at_ = 0;
    int line_ = 1;
    bool line_is_fresh_ = true;
    std::vector<source_token> tokens_;
};

} // namespace

std::vector<source_token> source_token_cut(std::string_view text)
{
    return cutter(text).cut();
}

std::vector<source_token> source_token_cut_code(std::string_view text)
{
    std::vector<source_token> tokens = source_token_cut(text);
    std::erase_if(tokens, [](const source_token &token) { return token.kind == source_token_kind::comment; });
    return tokens;
}

std::string source_token_directive(const source_token &token, std::string *rest)
{
    size_t at = token.text.find_first_not_of(" \t", 1);
    at = std::min(at, token.text.size());
    const std::string name = source_token_leading_word(std::string_view(token.text).substr(at));
    if (rest != nullptr) {
        const size_t begin = token.text.find_first_not_of(" \t", at + name.size());
        *rest = begin == std::string::npos ? "" : token.text.substr(begin);
        rest->erase(rest->find_last_not_of(" \t\r") + 1);
    }
    return name;
}

std::string source_token_leading_word(std::string_view text)
{
    size_t n = 0;
    while (n < text.size() && is_word(text[n])) {
        ++n;
    }
    return std::string(text.substr(0, n));
}

std::vector<source_token_include> source_token_includes(std::string_view text)
{
    std::vector<source_token_include> includes;
    for (const source_token &token : source_token_cut_code(text)) {
        std::string rest;
        if (token.kind != source_token_kind::directive || source_token_directive(token, &rest) != "include" ||
            rest.size() < 3) {
            continue;
        }
        const bool quoted = rest[0] == '"';
        const size_t end = rest.find(quoted ? '"' : '>', 1);
        if (end != std::string::npos) {
            includes.push_back({rest.substr(1, end - 1), quoted, token.line});
        }
    }
    return includes;
}
