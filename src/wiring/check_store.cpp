/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/check_store.h"

#include "station/opening.h"
#include "station/overlay_store.h"
#include "wiring/store.h"

#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace {

int complain(int exit, const std::string &text)
{
    std::fprintf(stderr, "glaise: %s\n", text.c_str());
    return exit;
}

void print(void *, check_weight weight, const char *file, uint64_t offset, const char *expected)
{
    const char *kind = weight == CHECK_PROBLEM ? "problem" : "note";
    if (offset == UINT64_MAX)
        std::printf("%-9s %s %s\n", kind, file, expected);
    else
        std::printf("%-9s %s at byte %" PRIu64 ": expected %s\n", kind, file, offset, expected);
}

void print_state(sculpture *piece)
{
    const keeper_facts facts = sculpture_facts(piece);
    std::printf("step      %g mm\n", piece->step_mm);
    std::printf("corners   %" PRIu64 " in %u bricks\n", piece->clay.corners, clay_brick_count(&piece->clay));
    std::printf("record    %" PRIu64 "\n", facts.put);
    std::printf("stroke    %" PRIu64 ", tip %" PRIu64 "\n", facts.cursor, facts.tip);
    std::printf("history   %u strokes in %u branches\n", facts.strokes, facts.branches);
    std::printf("digest    %016" PRIx64 "\n", sculpture_digest(piece));
}

void collect(void *self, check_weight weight, const char *file, uint64_t, const char *)
{
    if (weight == CHECK_PROBLEM)
        static_cast<std::set<std::string> *>(self)->insert(file);
}

/* What lies beneath the checkpoint that closing wrote may go where it is damaged: strokes that cannot be undone. The
   reserve is nothing but space. */
int write_copy(overlay_store *copy, const std::string &folder)
{
    const byte_store from = overlay_store_port(copy);
    std::set<std::string> without = {RESERVE_NAME};
    check_facts facts;
    std::string text;
    byte_store to;
    store *made = store_open(folder, &to, &text);
    status s = made ? sculpture_check(&from, collect, &without, &facts) : STATUS_IO;
    if (s == STATUS_OK)
        s = overlay_store_copy(copy, without, to);
    store_close(made);
    if (s != STATUS_OK)
        return complain(ARGUMENTS_EXIT_TROUBLE, made ? folder + ": " + status_text(s) : text);
    std::printf("repaired  %s\n", folder.c_str());
    return 0;
}

/* What opening makes of the copy, in memory; with a folder, written there once closing has put it in order. */
int open_copy(overlay_store *copy, const std::string &repaired, bool *finding_out)
{
    const byte_store port = overlay_store_port(copy);
    history_finding finding;
    auto piece = std::make_unique<sculpture>();
    status s = sculpture_open(piece.get(), &port, CAPACITY_BRICKS, nullptr, SCULPTURE_STEP_MM_DEFAULT, &finding);
    *finding_out = finding.text[0] != '\0';
    if (*finding_out)
        std::printf("opening   %s\n", finding.text);
    if (s != STATUS_OK)
        return complain(ARGUMENTS_EXIT_TROUBLE, status_text(s));
    print_state(piece.get());
    s = sculpture_close(piece.get());
    if (s != STATUS_OK)
        return complain(ARGUMENTS_EXIT_TROUBLE, status_text(s));
    return repaired.empty() ? 0 : write_copy(copy, repaired);
}

} // namespace

int check_store(const arguments &a)
{
    std::error_code error;
    std::string text;
    const std::string repaired = a.repair ? a.input + ".repaired" : "";
    if (!std::filesystem::is_directory(a.input, error))
        return complain(ARGUMENTS_EXIT_WRONG, a.input + ": expected a store, which is a folder");
    if (!repaired.empty() && std::filesystem::exists(repaired, error))
        return complain(ARGUMENTS_EXIT_WRONG, repaired + ": expected that there is no such folder yet");
    overlay_store copy;
    store *folder = store_open(a.input, &copy.under, &text);
    if (!folder)
        return complain(ARGUMENTS_EXIT_TROUBLE, text);
    check_facts facts;
    const status s = check_run(&copy.under, print, nullptr, &facts);
    bool found = false;
    int exit = s == STATUS_OK ? 0 : complain(ARGUMENTS_EXIT_TROUBLE, a.input + ": " + status_text(s));
    if (exit == 0) {
        std::printf("read      %u undo-files with %u records, %u checkpoints\n", facts.undo_files, facts.records,
                    facts.checkpoints);
        exit = open_copy(&copy, repaired, &found);
    }
    store_close(folder);
    return exit == 0 && (facts.problems > 0 || found) ? ARGUMENTS_EXIT_TROUBLE : exit;
}
