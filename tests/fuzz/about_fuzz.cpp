/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    No text makes the reader of `about` read outside it or accept what its writer would not write; what it refuses
 *         it refuses with a line; every name it lets through can be shown and copied.
 * Method  The input is the text, as an exact-size heap copy that is gone before the answer is looked at; and the same
 *         bytes are tried as a name.
 */
#include "station/about.h"

#include <cstdlib>
#include <cstring>

namespace {

void require(bool truth)
{
    if (!truth)
        std::abort();
}

void check_name(const std::string &name)
{
    const std::string trouble = about_name_trouble(name);
    if (!trouble.empty())
        return;
    about_trouble where;
    const about a = {name, ABOUT_ASIDE, name.size()};
    require(about_parse(about_text(a), &where) == a);
    require(about_text(a).size() <= ABOUT_BYTES_MAX);
    require(about_name_trouble(about_copy_name(name)).empty());
    for (const char byte : name)
        require(static_cast<unsigned char>(byte) >= 0x20 && byte != 0x7f);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *copy = static_cast<char *>(std::malloc(size));
    if (size > 0)
        std::memcpy(copy, data, size);
    about_trouble trouble;
    const std::optional<about> a = about_parse(std::string_view(copy, size), &trouble);
    const std::string text(copy, size);
    std::free(copy);
    if (a) {
        require(about_text(*a) == text);
        check_name(a->name);
    } else {
        require(trouble.line >= 1 && trouble.line <= 5 && !trouble.expected.empty());
    }
    check_name(text);
    return 0;
}
