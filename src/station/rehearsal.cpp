/* SPDX-License-Identifier: Apache-2.0 */
#include "station/rehearsal.h"

#include "station/overlay_store.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

/* How often at the most: each time a file less is in the store. */
constexpr int TRIES = 64;

/* The name of the file that the other process read last, where both see it. */
struct last_read {
    char name[BYTE_STORE_NAME_MAX + 1];
};

/* A port that tells what is read through it. Nothing is written through it: the overlay holds that. */
struct told_store {
    byte_store under;
    last_read *told;
};

told_store &of(void *self) { return *static_cast<told_store *>(self); }

status told_read(void *self, const char *name, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    told_store &s = of(self);
    std::snprintf(s.told->name, sizeof s.told->name, "%s", name);
    return s.under.read(s.under.self, name, offset, bytes, n, got_out);
}

status told_size(void *self, const char *name, uint64_t *bytes_out, bool *exists_out)
{
    return of(self).under.size(of(self).under.self, name, bytes_out, exists_out);
}

status told_list(void *self, void (*take)(void *into, const char *name), void *into)
{
    return of(self).under.list(of(self).under.self, take, into);
}

/* In the other process, which ends here. */
[[noreturn]] void rehearse(const byte_store &port, const rehearsal_opening &open, last_read *told)
{
    told_store reads = {port, told};
    overlay_store over;
    over.under.self = &reads; /* the overlay writes nothing beneath itself */
    over.under.read = told_read;
    over.under.size = told_size;
    over.under.list = told_list;
    open(overlay_store_port(&over));
    _exit(0);
}

enum class end { lived, crashed, unknown };

end wait_for(pid_t child)
{
    int how = 0;
    while (waitpid(child, &how, 0) != child)
        if (errno != EINTR)
            return end::unknown;
    if (WIFEXITED(how) && WEXITSTATUS(how) == 0)
        return end::lived;
    const bool killed = WIFSIGNALED(how) && (WTERMSIG(how) == SIGKILL || WTERMSIG(how) == SIGTERM);
    return killed ? end::unknown : end::crashed; /* that somebody killed it says nothing about what it read */
}

/* One process; what crashed it is set aside. False: there is nothing more to try. */
bool try_once(const byte_store &port, const rehearsal_opening &open, last_read *told, history_finding *finding_out)
{
    told->name[0] = '\0';
    std::fflush(nullptr); /* or both would write what is buffered */
    const pid_t child = fork();
    if (child == 0)
        rehearse(port, open, told);
    if (child < 0 || wait_for(child) != end::crashed || told->name[0] == '\0')
        return false;
    if (sculpture_set_aside(&port, told->name) != STATUS_OK)
        return false;
    if (finding_out->text[0] == '\0')
        std::snprintf(finding_out->text, sizeof finding_out->text,
                      "%s made the last start fail and was set aside: what it held is missing", told->name);
    return true;
}

} // namespace

void rehearsal_begin(const byte_store &port, const rehearsal_opening &open, history_finding *finding_out)
{
    finding_out->text[0] = '\0';
    static constexpr char text[] = "this store is being opened\n";
    uint64_t bytes = 0;
    bool exists = false;
    const bool unended = port.size(port.self, REHEARSAL_MARK, &bytes, &exists) == STATUS_OK && exists;
    const status marked = unended ? STATUS_OK : port.write(port.self, REHEARSAL_MARK, 0, text, sizeof text - 1);
    (void)marked; /* without it, the next start opens as this one does */
    if (!unended)
        return;
    void *page = mmap(nullptr, sizeof(last_read), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED)
        return;
    for (int n = 0; n < TRIES && try_once(port, open, static_cast<last_read *>(page), finding_out); n++)
        continue;
    munmap(page, sizeof(last_read));
}

void rehearsal_end(const byte_store &port)
{
    const status gone = port.remove(port.self, REHEARSAL_MARK);
    (void)gone; /* then the next opening is rehearsed, and comes to its end */
}
