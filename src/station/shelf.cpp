/* SPDX-License-Identifier: Apache-2.0 */
#include "station/shelf.h"

#include "station/shelf_copy.h"

#include <algorithm>

namespace {

constexpr std::string_view PIECE = "piece-", MAKING = "making-", REMOVED = "removed-";
constexpr size_t DIGITS = 4;

std::string folder_of(std::string_view kind, int number)
{
    std::string digits = std::to_string(number);
    return std::string(kind) + std::string(DIGITS - digits.size(), '0') + digits;
}

/* 0: no such folder. */
int number_of(std::string_view kind, std::string_view folder)
{
    if (!folder.starts_with(kind) || folder.size() != kind.size() + DIGITS)
        return 0;
    int number = 0;
    for (const char digit : folder.substr(kind.size())) {
        if (digit < '0' || digit > '9')
            return 0;
        number = 10 * number + (digit - '0');
    }
    return number;
}

/* --- looking --- */

shelf_piece piece_look(const shelf_port &port, int number)
{
    shelf_piece p;
    p.number = number;
    const std::string folder = shelf_folder(number);
    std::optional<std::string> text;
    p.trouble = port.read(folder, SHELF_ABOUT_NAME, ABOUT_BYTES_MAX + 1, &text);
    about_trouble trouble;
    const std::optional<about> facts = text ? about_parse(*text, &trouble) : std::nullopt;
    if (facts && p.trouble.empty()) {
        p.facts = *facts;
        return p;
    }
    p.facts.name = folder;
    const std::string file = folder + "/" + SHELF_ABOUT_NAME;
    if (p.trouble.empty())
        p.trouble = text ? file + ":" + std::to_string(trouble.line) + ": " + trouble.expected
                         : file + ": expected such a file";
    return p;
}

/* Answers also what an earlier opening left to be cleared away. */
std::string look(shelf *s, std::vector<std::string> *leftovers_out)
{
    std::vector<std::string> folders;
    std::string text = s->port.list(&folders);
    if (!text.empty())
        return text;
    std::sort(folders.begin(), folders.end());
    s->pieces.clear();
    s->taken.clear();
    for (const std::string &folder : folders) {
        const int piece = number_of(PIECE, folder), leftover = number_of(MAKING, folder) + number_of(REMOVED, folder);
        if (piece)
            s->pieces.push_back(piece_look(s->port, piece));
        else if (leftover)
            leftovers_out->push_back(folder);
        if (piece || leftover)
            s->taken.push_back(piece + leftover);
    }
    std::sort(s->taken.begin(), s->taken.end());
    return "";
}

/* A call that failed may have done its work. */
std::string failed(shelf *s, std::string text)
{
    std::vector<std::string> leftovers;
    const std::string also = look(s, &leftovers);
    return also.empty() || text.find(also) != std::string::npos ? text : text + "; " + also;
}

/* --- making and changing --- */

/* The one after the last; when there is none, the first that is free. 0: there is none. */
int number_free(const shelf &s)
{
    if (s.taken.empty() || s.taken.back() < SHELF_PIECES_MAX)
        return s.taken.empty() ? 1 : s.taken.back() + 1;
    int number = 1;
    for (const int taken : s.taken)
        number += taken == number;
    return number <= SHELF_PIECES_MAX ? number : 0;
}

uint64_t turn_next(const shelf &s)
{
    uint64_t last = 0;
    for (const shelf_piece &p : s.pieces)
        last = std::max(last, p.facts.turn);
    return std::min(last + 1, ABOUT_TURN_MAX);
}

using filling = std::function<std::string(const std::string &folder, const byte_store &store)>;

/* S1. What is filled in is on the medium before `about` is, and that before the folder has its name. */
std::string piece_make(shelf *s, const std::string &name, const filling &fill, int *number_out)
{
    const int number = number_free(*s);
    if (!number)
        return "expected fewer than " + std::to_string(SHELF_PIECES_MAX) + " pieces";
    const std::string making = folder_of(MAKING, number);
    const about facts = {name, ABOUT_ON, turn_next(*s)};
    byte_store store;
    std::string text = s->port.open(making, &store);
    if (text.empty()) {
        text = fill(making, store);
        s->port.close(store);
    }
    if (text.empty())
        text = s->port.replace(making, SHELF_ABOUT_NAME, about_text(facts));
    if (text.empty())
        text = s->port.rename(making, shelf_folder(number));
    if (!text.empty()) {
        (void)s->port.remove(making); /* else the next opening does it */
        return failed(s, text);
    }
    const auto after = [number](const shelf_piece &p) { return p.number > number; };
    s->pieces.insert(std::find_if(s->pieces.begin(), s->pieces.end(), after), {number, facts, ""});
    s->taken.insert(std::lower_bound(s->taken.begin(), s->taken.end(), number), number);
    *number_out = number;
    return "";
}

std::string none_such(int number) { return std::to_string(number) + ": expected the number of a piece on this shelf"; }

std::string piece_change(shelf *s, int number, const std::function<std::string(about *)> &change)
{
    const auto same = [number](const shelf_piece &p) { return p.number == number; };
    const auto piece = std::find_if(s->pieces.begin(), s->pieces.end(), same);
    if (piece == s->pieces.end())
        return none_such(number);
    if (!piece->trouble.empty())
        return piece->trouble + "; it is left as it is, but can be duplicated";
    about facts = piece->facts;
    std::string text = change(&facts);
    if (!text.empty() || facts == piece->facts)
        return text;
    text = s->port.replace(shelf_folder(number), SHELF_ABOUT_NAME, about_text(facts));
    if (!text.empty())
        return failed(s, text);
    piece->facts = facts;
    return "";
}

std::string state_change(shelf *s, int number, about_state state)
{
    return piece_change(s, number, [&](about *facts) -> std::string {
        if (facts->state == state)
            return "";
        if (state == ABOUT_ASIDE && facts->state == ABOUT_DISCARDED)
            return facts->name + ": is discarded; bring it back first";
        if (state == ABOUT_DISCARDED && facts->state == ABOUT_ON)
            return facts->name + ": is on the shelf; set it aside first";
        facts->state = state;
        facts->turn = turn_next(*s);
        return "";
    });
}

/* --- removing --- */

/* S2. */
std::string piece_remove(shelf *s, int number)
{
    const std::string removed = folder_of(REMOVED, number);
    std::string text = s->port.rename(shelf_folder(number), removed);
    if (!text.empty())
        return text;
    std::erase_if(s->pieces, [number](const shelf_piece &p) { return p.number == number; });
    text = s->port.remove(removed);
    if (text.empty())
        std::erase(s->taken, number);
    return text;
}

std::vector<int> discarded(const shelf &s, int spared)
{
    std::vector<const shelf_piece *> all;
    for (const shelf_piece &p : s.pieces)
        if (p.trouble.empty() && p.facts.state == ABOUT_DISCARDED && p.number != spared)
            all.push_back(&p);
    std::stable_sort(all.begin(), all.end(), [](auto *a, auto *b) { return a->facts.turn < b->facts.turn; });
    std::vector<int> numbers;
    for (const shelf_piece *p : all)
        numbers.push_back(p->number);
    return numbers;
}

/* A piece that cannot be removed (it may be open) does not keep the others. */
std::string room_make(shelf *s, uint64_t bytes, int spared)
{
    uint64_t free = 0;
    std::string first;
    std::string text = s->port.free(&free);
    for (const int number : discarded(*s, spared)) {
        if (!text.empty() || free >= bytes)
            break;
        const std::string why = piece_remove(s, number);
        first = first.empty() ? why : first;
        text = s->port.free(&free);
    }
    if (!text.empty() || free >= bytes)
        return text.empty() ? "" : failed(s, text);
    const std::string short_of = "expected " + std::to_string(bytes) + " bytes, only " + std::to_string(free) +
                                 " are free, and nothing more that is discarded can be removed";
    return failed(s, first.empty() ? short_of : short_of + " (" + first + ")");
}

} // namespace

std::string shelf_open(shelf *s, shelf_port port)
{
    *s = {};
    s->port = std::move(port);
    std::vector<std::string> leftovers;
    std::string text = look(s, &leftovers);
    for (const std::string &folder : leftovers) {
        const std::string why = s->port.remove(folder);
        if (why.empty())
            std::erase(s->taken, number_of(MAKING, folder) + number_of(REMOVED, folder));
        else
            s->trouble = why;
    }
    return text;
}

const shelf_piece *shelf_find(const shelf *s, int number)
{
    for (const shelf_piece &p : s->pieces)
        if (p.number == number)
            return &p;
    return nullptr;
}

std::string shelf_folder(int number) { return folder_of(PIECE, number); }

std::string shelf_new(shelf *s, const std::string &name, int *number_out)
{
    const std::string trouble = about_name_trouble(name);
    if (!trouble.empty())
        return trouble;
    const auto nothing = [](const std::string &, const byte_store &) { return std::string(); };
    return piece_make(s, name, nothing, number_out);
}

std::string shelf_rename(shelf *s, int number, const std::string &name)
{
    return piece_change(s, number, [&name](about *facts) {
        facts->name = name;
        return about_name_trouble(name);
    });
}

std::string shelf_set_aside(shelf *s, int number) { return state_change(s, number, ABOUT_ASIDE); }
std::string shelf_bring_back(shelf *s, int number) { return state_change(s, number, ABOUT_ON); }
std::string shelf_discard(shelf *s, int number) { return state_change(s, number, ABOUT_DISCARDED); }
std::string shelf_make_room(shelf *s, uint64_t bytes) { return room_make(s, bytes, 0); }

std::string shelf_duplicate(shelf *s, int number, still *moment, const std::function<void(double)> &told,
                            int *number_out)
{
    const shelf_piece *from = shelf_find(s, number);
    if (!from)
        return none_such(number);
    const std::string name = about_copy_name(from->facts.name), folder = shelf_folder(number);
    uint64_t bytes = moment ? shelf_copy_bytes(*moment) : 0;
    const std::string text = moment ? "" : s->port.bytes(folder, &bytes);
    if (!text.empty())
        return text;
    (void)room_make(s, bytes, number); /* whether it is enough, writing says */
    const auto fill = [&](const std::string &making, const byte_store &store) {
        if (moment)
            return shelf_copy_moment(s->port, folder, moment, making, store, told);
        return shelf_copy_files(s->port, folder, bytes, making, store, told);
    };
    return piece_make(s, name, fill, number_out);
}
