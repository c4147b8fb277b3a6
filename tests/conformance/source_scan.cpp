/* SPDX-License-Identifier: Apache-2.0 */
#include "source_scan.h"

#include "source_token.h"

#include <algorithm>
#include <set>

namespace {

/* One word of a declaration, or one whole bracket group of it. */
struct piece {
    size_t first; /* token */
    size_t last;  /* token; of a group, the closing bracket */
    char group;   /* '(' '[' '{' or 0 */
};

using pieces = std::vector<piece>;

bool is_one_of(const std::string &word, const std::set<std::string> &words)
{
    return words.count(word) != 0;
}

const std::set<std::string> aggregate_words = {"struct", "union", "class", "enum"};
const std::set<std::string> attribute_words = {"__attribute__", "alignas", "_Alignas", "__declspec", "noexcept",
                                               "requires",      "explicit", "decltype"};
const std::set<std::string> after_parameters = {"const", "noexcept", "override", "final", "volatile", "try"};

class scanner {
public:
    explicit scanner(std::string_view text) : tokens_(source_token_cut_code(text)) {}

    source_scan scan()
    {
        for (const source_token &token : tokens_) {
            std::string rest;
            if (token.kind == source_token_kind::directive && source_token_directive(token, &rest) == "define") {
                note(source_scan_kind::macro, source_token_leading_word(rest), token.line);
            }
        }
        std::erase_if(tokens_,
                      [](const source_token &token) { return token.kind == source_token_kind::directive; });
        scope(0, tokens_.size(), false);
        return std::move(result_);
    }

private:
    void note(source_scan_kind kind, const std::string &name, int line)
    {
        result_.names.push_back({kind, name, line});
    }

    const std::string &word(const piece &p) const
    {
        return tokens_[p.first].text;
    }

    bool is_name(const piece &p) const
    {
        return p.group == 0 && tokens_[p.first].kind == source_token_kind::word;
    }

    /* The closing bracket of the group that opens at `open`, or the last token. */
    size_t closing(size_t open) const
    {
        int depth = 0;
        for (size_t i = open; i < tokens_.size(); ++i) {
            if (tokens_[i].kind != source_token_kind::punctuation) {
                continue;
            }
            const char c = tokens_[i].text[0];
            depth += c == '(' || c == '[' || c == '{';
            depth -= c == ')' || c == ']' || c == '}';
            if (depth == 0) {
                return i;
            }
        }
        return tokens_.size() - 1;
    }

    void scope(size_t begin, size_t end, bool is_members)
    {
        pieces statement;
        for (size_t i = begin; i < end;) {
            const std::string &text = tokens_[i].text;
            const bool is_mark = tokens_[i].kind == source_token_kind::punctuation;
            if (is_mark && text == ";") {
                finish(statement, is_members);
                statement.clear();
                ++i;
            } else if (is_mark && (text == "(" || text == "[")) {
                const size_t last = closing(i);
                statement.push_back({i, last, text[0]});
                i = last + 1;
            } else if (is_mark && text == "{") {
                const size_t last = closing(i);
                brace(statement, {i, last, '{'}, is_members);
                i = last + 1;
            } else if (is_members && is_mark && text == ":" && is_access(statement)) {
                statement.clear();
                ++i;
            } else {
                statement.push_back({i, i, 0});
                ++i;
            }
        }
    }

    bool is_access(const pieces &statement) const
    {
        return statement.size() == 1 && is_one_of(word(statement[0]), {"public", "private", "protected"});
    }

    /* What the braces are depends on what stands before them. The statement goes on after a type's body or an
     * initialiser and is over after anything else. */
    void brace(pieces &statement, const piece &group, bool is_members)
    {
        const pieces plain = without_attributes(statement);
        if (is_linkage_or_namespace(plain)) {
            note_namespace(plain);
            scope(group.first + 1, group.last, is_members);
            statement.clear();
        } else if (const size_t at = aggregate_at(plain); at < plain.size()) {
            aggregate(plain, at, group, is_members);
            /* What follows the body declares variables or aliases: the type is now one word and its braces. */
            statement.assign(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(at) + 1);
            statement.push_back(group);
        } else if (is_function_head(plain)) {
            function_body(plain, group, is_members);
            statement.clear();
        } else {
            statement.push_back(group);
        }
    }

    bool is_linkage_or_namespace(const pieces &plain) const
    {
        if (plain.size() == 2 && word(plain[0]) == "extern" && word(plain[1])[0] == '"') {
            return true;
        }
        return !plain.empty() && (word(plain[0]) == "namespace" ||
                                  (plain.size() > 1 && word(plain[0]) == "inline" && word(plain[1]) == "namespace"));
    }

    void note_namespace(const pieces &plain)
    {
        if (plain.size() > 1 && word(plain[0]) != "extern") {
            note(source_scan_kind::name_space, word(plain.back()), tokens_[plain[0].first].line);
        }
    }

    /* Drops attributes, template heads and a leading extern "C". */
    pieces without_attributes(const pieces &all) const
    {
        pieces plain;
        for (size_t i = 0; i < all.size(); ++i) {
            const bool has_group = i + 1 < all.size() && all[i + 1].group == '(';
            if (all[i].group == '[' && tokens_[all[i].first + 1].text == "[") {
                continue;
            }
            if (is_name(all[i]) && is_one_of(word(all[i]), attribute_words)) {
                i += has_group ? 1 : 0;
                continue;
            }
            if (is_name(all[i]) && word(all[i]) == "template") {
                i = past_angles(all, i + 1) - 1;
                continue;
            }
            plain.push_back(all[i]);
        }
        if (plain.size() > 2 && word(plain[0]) == "extern" && word(plain[1])[0] == '"') {
            plain.erase(plain.begin(), plain.begin() + 2);
        }
        return plain;
    }

    /* The piece behind the <...> that opens at `at`; `at` itself where none opens. */
    size_t past_angles(const pieces &all, size_t at) const
    {
        int depth = 0;
        for (size_t i = at; i < all.size(); ++i) {
            depth += all[i].group == 0 && word(all[i]) == "<";
            depth -= all[i].group == 0 && word(all[i]) == ">";
            if (depth == 0) {
                return i == at && word(all[i]) != ">" && word(all[i]) != "<" ? at : i + 1;
            }
        }
        return all.size();
    }

    size_t equals_at(const pieces &plain) const
    {
        for (size_t i = 0; i < plain.size(); ++i) {
            const bool is_operator = i > 0 && word(plain[i - 1]) == "operator";
            if (plain[i].group == 0 && word(plain[i]) == "=" && !is_operator) {
                return i;
            }
        }
        return plain.size();
    }

    /* The struct, union, class or enum word of a statement that defines or forward-declares a type. */
    size_t aggregate_at(const pieces &plain) const
    {
        if (equals_at(plain) < plain.size()) {
            return plain.size();
        }
        size_t found = plain.size();
        for (size_t i = 0; i < plain.size(); ++i) {
            if (plain[i].group == '(' || plain[i].group == '{') {
                return plain.size();
            }
            if (found == plain.size() && is_name(plain[i]) && is_one_of(word(plain[i]), aggregate_words)) {
                found = i;
            }
        }
        return found;
    }

    void aggregate(const pieces &plain, size_t at, const piece &group, bool is_members)
    {
        const bool is_enum = word(plain[at]) == "enum";
        bool is_scoped = false;
        size_t name = at + 1;
        while (name < plain.size() && (word(plain[name]) == "class" || word(plain[name]) == "struct")) {
            is_scoped = true;
            ++name;
        }
        if (!is_members && name < plain.size() && is_name(plain[name])) {
            note(source_scan_kind::type, word(plain[name]), tokens_[plain[name].first].line);
        }
        if (!is_enum) {
            scope(group.first + 1, group.last, true);
        } else if (!is_scoped && !is_members) {
            enumerators(group);
        }
    }

    void enumerators(const piece &group)
    {
        bool is_start = true;
        for (size_t i = group.first + 1; i < group.last; ++i) {
            const source_token &token = tokens_[i];
            if (token.kind == source_token_kind::word && is_start) {
                note(source_scan_kind::enumerator, token.text, token.line);
                is_start = false;
            } else if (token.text == ",") {
                is_start = true;
            } else if (token.text == "(" || token.text == "{" || token.text == "[") {
                i = closing(i);
            }
        }
    }

    /* The piece that names what a parameter list belongs to: name (...), and not name = ... */
    size_t function_name_at(const pieces &plain) const
    {
        const size_t equals = equals_at(plain);
        for (size_t i = 1; i < equals; ++i) {
            const bool is_pointer = plain[i].group == '(' && tokens_[plain[i].first + 1].text == "*";
            if (plain[i].group == '(' && is_name(plain[i - 1]) && !is_pointer) {
                return i - 1;
            }
        }
        return plain.size();
    }

    bool is_operator(const pieces &plain) const
    {
        return std::any_of(plain.begin(), plain.end(), [&](const piece &p) { return word(p) == "operator"; });
    }

    bool is_function_head(const pieces &plain) const
    {
        if (plain.empty() || equals_at(plain) < plain.size()) {
            return false;
        }
        const bool has_parameters =
            std::any_of(plain.begin(), plain.end(), [](const piece &p) { return p.group == '('; });
        if (!has_parameters) {
            return false;
        }
        /* f() : a(1), b{2} { }: the brace after b is no body, the one after } or ) is. */
        bool is_after = false;
        bool is_in_members = false;
        for (const piece &p : plain) {
            is_in_members = is_in_members || (is_after && p.group == 0 && word(p) == ":");
            is_after = is_after || p.group == '(';
        }
        const piece &last = plain.back();
        return !is_in_members || last.group == '(' || last.group == '{' || is_one_of(word(last), after_parameters);
    }

    void function_body(const pieces &plain, const piece &group, bool is_members)
    {
        const size_t at = function_name_at(plain);
        const std::string name = at < plain.size() ? word(plain[at]) : "operator";
        result_.bodies.push_back({name, tokens_[plain[0].first].line, tokens_[group.last].line});
        if (at < plain.size() && !is_members) {
            note_function(plain, at);
        }
        local_statics(group);
    }

    void note_function(const pieces &plain, size_t at)
    {
        const bool is_qualified = at > 0 && (word(plain[at - 1]) == "::" || word(plain[at - 1]) == "~");
        if (at > 0 && !is_qualified && !is_operator(plain)) {
            note(source_scan_kind::function, word(plain[at]), tokens_[plain[at].first].line);
        }
    }

    void local_statics(const piece &group)
    {
        for (size_t i = group.first + 1; i < group.last; ++i) {
            if (!is_one_of(tokens_[i].text, {"static", "thread_local", "_Thread_local"})) {
                continue;
            }
            pieces declaration;
            while (i < group.last && !is_one_of(tokens_[i].text, {";", "=", "{"})) {
                const bool is_group = tokens_[i].text == "(" || tokens_[i].text == "[";
                const size_t last = is_group ? closing(i) : i;
                declaration.push_back({i, last, is_group ? tokens_[i].text[0] : '\0'});
                i = last + 1;
            }
            variables(declaration, false);
        }
    }

    /* A statement that ended with a semicolon. */
    void finish(const pieces &statement, bool is_members)
    {
        pieces plain = without_attributes(statement);
        static const std::set<std::string> silent = {"static_assert", "_Static_assert", "friend", "namespace",
                                                     "__extension__"};
        if (plain.empty() || is_one_of(word(plain[0]), silent)) {
            return;
        }
        const bool is_only_type = plain.size() > 1 && plain.back().group == '{' &&
                                  is_one_of(word(plain[plain.size() - 2]), aggregate_words);
        if (is_members || is_only_type || is_operator(plain)) {
            return;
        }
        if (word(plain[0]) == "using") {
            if (plain.size() > 1 && word(plain[1]) == "namespace") {
                note(source_scan_kind::name_space, "using " + word(plain.back()), tokens_[plain[0].first].line);
            } else if (plain.size() > 1) {
                const size_t at = equals_at(plain) < plain.size() ? 1 : plain.size() - 1;
                note(source_scan_kind::type, word(plain[at]), tokens_[plain[at].first].line);
            }
        } else if (word(plain[0]) == "typedef") {
            type_alias(plain);
        } else if (is_forward(plain)) {
            note(source_scan_kind::forward, word(plain.back()), tokens_[plain.back().first].line);
        } else if (const size_t at = function_name_at(plain); at < plain.size()) {
            note_function(plain, at);
        } else {
            variables(plain, true);
        }
    }

    /* struct x; or enum class x : int; */
    bool is_forward(const pieces &plain) const
    {
        if (!is_one_of(word(plain[0]), aggregate_words)) {
            return false;
        }
        if (plain.size() < 2 || plain[1].group != 0) {
            return false;
        }
        return plain.size() == 2 || (plain.size() == 3 && is_one_of(word(plain[1]), {"class", "struct"}));
    }

    void type_alias(const pieces &plain)
    {
        const bool has_body = std::any_of(plain.begin(), plain.end(), [](const piece &p) { return p.group == '{'; });
        const bool is_forward = plain.size() == 4 && is_one_of(word(plain[1]), aggregate_words) && !has_body &&
                                word(plain[2]) == word(plain[3]);
        for (const pieces &one : declarators(plain)) {
            const size_t name = declared_name(one);
            if (name != 0) {
                note(is_forward ? source_scan_kind::forward : source_scan_kind::type, tokens_[name].text,
                     tokens_[name].line);
            }
        }
    }

    /* Split at commas outside brackets and angles; what follows '=' is dropped. */
    std::vector<pieces> declarators(const pieces &plain) const
    {
        std::vector<pieces> all(1);
        bool is_value = false;
        for (size_t i = 0; i < plain.size(); ++i) {
            if (!is_value && plain[i].group == 0 && word(plain[i]) == "<") {
                i = past_angles(plain, i) - 1;
            } else if (plain[i].group == 0 && word(plain[i]) == ",") {
                all.emplace_back();
                is_value = false;
            } else if (plain[i].group == 0 && word(plain[i]) == "=") {
                is_value = true;
            } else if (!is_value) {
                all.back().push_back(plain[i]);
            }
        }
        return all;
    }

    /* The token that is declared: the last word, or the one inside (*name). 0: none. */
    size_t declared_name(const pieces &one) const
    {
        for (const piece &p : one) {
            if (p.group == '(' && tokens_[p.first + 1].text == "*") {
                size_t name = 0;
                for (size_t i = p.first + 1; i < p.last && tokens_[i].text != "[" && tokens_[i].text != "("; ++i) {
                    name = tokens_[i].kind == source_token_kind::word && tokens_[i].text != "const" ? i : name;
                }
                return name;
            }
        }
        size_t name = 0;
        for (const piece &p : one) {
            if (p.group == '(') {
                break;
            }
            name = is_name(p) ? p.first : name;
        }
        return name;
    }

    void variables(const pieces &plain, bool is_named)
    {
        bool base_is_constant = false;
        bool is_first = true;
        for (const pieces &one : declarators(plain)) {
            const size_t name = declared_name(one);
            if (is_first) {
                base_is_constant = has_constant(one, 0, one.size());
            }
            const bool is_lone_word = is_first && one.size() < 2;
            if (name != 0 && !is_lone_word) {
                if (is_named) {
                    note(source_scan_kind::variable, tokens_[name].text, tokens_[name].line);
                }
                if (!is_constant(one, base_is_constant)) {
                    result_.mutables.push_back({tokens_[name].text, tokens_[name].line});
                }
            }
            is_first = false;
        }
    }

    bool has_constant(const pieces &one, size_t begin, size_t end) const
    {
        for (size_t i = begin; i < end; ++i) {
            if (one[i].group == 0 && is_one_of(word(one[i]), {"const", "constexpr", "constinit"})) {
                return word(one[i]) != "constinit";
            }
        }
        return false;
    }

    /* char const *p can be pointed elsewhere, char *const p cannot. */
    bool is_constant(const pieces &one, bool base_is_constant) const
    {
        size_t behind_star = 0;
        for (size_t i = 0; i < one.size(); ++i) {
            if (one[i].group == '(' && tokens_[one[i].first + 1].text == "*") {
                return tokens_[one[i].first + 2].text == "const";
            }
            if (one[i].group == 0 && word(one[i]) == "*") {
                behind_star = i + 1;
            }
            if (one[i].group == 0 && word(one[i]) == "constexpr") {
                return true;
            }
        }
        return behind_star == 0 ? base_is_constant : has_constant(one, behind_star, one.size());
    }

    std::vector<source_token> tokens_;
    source_scan result_;
};

} // namespace

source_scan source_scan_text(std::string_view text)
{
    return scanner(text).scan();
}

const char *source_scan_kind_text(source_scan_kind kind)
{
    switch (kind) {
    case source_scan_kind::function: return "function";
    case source_scan_kind::type: return "type";
    case source_scan_kind::forward: return "forward declaration";
    case source_scan_kind::variable: return "variable";
    case source_scan_kind::enumerator: return "enumerator";
    case source_scan_kind::macro: return "macro";
    case source_scan_kind::name_space: return "namespace";
    }
    return "name";
}
