/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/shelf_task.h"

#include "station/shelf.h"
#include "wiring/progress.h"
#include "wiring/replay.h"
#include "wiring/shelf_store.h"

#include <cstdio>
#include <filesystem>

namespace {

constexpr uint64_t MIB_BYTES = 1 << 20;

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

/* A shelf on a real folder. */
struct counter {
    shelf_store *folder = nullptr;
    shelf pieces;
    ~counter() { shelf_store_close(folder); }
};

/* With `make`, the folder is made in one that is there. */
std::string counter_open(counter *c, const std::string &folder, bool make)
{
    shelf_port port;
    std::string text;
    std::error_code error;
    if (!make && !std::filesystem::is_directory(folder, error))
        return folder + ": expected the folder of a shelf (glaise shelf FOLDER new NAME makes one)";
    c->folder = shelf_store_open(folder, &port, &text);
    if (!c->folder)
        return text;
    text = shelf_open(&c->pieces, std::move(port));
    if (text.empty() && !c->pieces.trouble.empty())
        complain(0, c->pieces.trouble);
    return text;
}

void piece_tell(const counter &c, const shelf_piece &p)
{
    uint64_t bytes = 0;
    char size[32] = "?";
    if (c.pieces.port.bytes(shelf_folder(p.number), &bytes).empty())
        std::snprintf(size, sizeof size, "%.1f MiB", static_cast<double>(bytes) / MIB_BYTES);
    std::printf("%4d  %-9s  %10s  %s\n", p.number, std::string(about_state_word(p.facts.state)).c_str(), size,
                p.facts.name.c_str());
}

int all_tell(const counter &c)
{
    for (const shelf_piece &p : c.pieces.pieces)
        piece_tell(c, p);
    std::fflush(stdout);
    for (const shelf_piece &p : c.pieces.pieces)
        if (!p.trouble.empty())
            complain(0, p.trouble);
    return 0;
}

std::string duplicate(counter *c, int number, int *number_out)
{
    progress_teller bar = progress_teller_begin("duplicating");
    const auto told = [&](double part) { progress_teller_show(&bar, part); };
    const std::string text = shelf_duplicate(&c->pieces, number, nullptr, told, number_out);
    progress_teller_end(&bar);
    return text;
}

std::string act(counter *c, const arguments &a, int *number_out)
{
    shelf *s = &c->pieces;
    *number_out = a.piece;
    switch (a.act) {
    case ARGUMENTS_SHELF_NEW: return shelf_new(s, a.name, number_out);
    case ARGUMENTS_SHELF_RENAME: return shelf_rename(s, a.piece, a.name);
    case ARGUMENTS_SHELF_DUPLICATE: return duplicate(c, a.piece, number_out);
    case ARGUMENTS_SHELF_SET_ASIDE: return shelf_set_aside(s, a.piece);
    case ARGUMENTS_SHELF_BRING_BACK: return shelf_bring_back(s, a.piece);
    case ARGUMENTS_SHELF_DISCARD: return shelf_discard(s, a.piece);
    case ARGUMENTS_SHELF_MAKE_ROOM: return shelf_make_room(s, static_cast<uint64_t>(a.room_mib) * MIB_BYTES);
    case ARGUMENTS_SHELF_LIST: break;
    }
    return "";
}

} // namespace

int shelf_task(const arguments &a)
{
    counter c;
    int number = 0;
    std::string text = about_name_trouble(a.name);
    if ((a.act == ARGUMENTS_SHELF_NEW || a.act == ARGUMENTS_SHELF_RENAME) && !text.empty())
        return complain(ARGUMENTS_EXIT_WRONG, text);
    text = counter_open(&c, a.shelf, a.act == ARGUMENTS_SHELF_NEW);
    if (!text.empty())
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    if (a.piece && !shelf_find(&c.pieces, a.piece))
        return complain(ARGUMENTS_EXIT_WRONG, a.shelf + ": expected the number of a piece on this shelf, not " +
                                                  std::to_string(a.piece));
    text = act(&c, a, &number);
    if (!text.empty())
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    if (!number)
        return all_tell(c);
    piece_tell(c, *shelf_find(&c.pieces, number));
    return 0;
}

int shelf_task_replay(const arguments &a)
{
    counter c;
    const std::string text = counter_open(&c, a.shelf, false);
    if (!text.empty())
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    if (!shelf_find(&c.pieces, a.piece))
        return complain(ARGUMENTS_EXIT_WRONG, a.shelf + ": expected the number of a piece on this shelf, not " +
                                                  std::to_string(a.piece));
    arguments b = a;
    b.store = (std::filesystem::path(a.shelf) / shelf_folder(a.piece)).string();
    b.thumbnail = (std::filesystem::path(b.store) / SHELF_THUMBNAIL_NAME).string();
    return replay_tape(b);
}
