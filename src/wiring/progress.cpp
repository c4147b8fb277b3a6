/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/progress.h"

#include <chrono>
#include <cstdio>
#include <thread>
#include <unistd.h>

namespace {

constexpr int BAR_CELLS = 30;
constexpr int64_t REDRAW_NS = 50000000;
constexpr int64_t MOMENT_NS = 300000000;

void bar_draw(const progress &p, double part, const std::string &note)
{
    int full = static_cast<int>(part * BAR_CELLS);
    std::string bar;
    for (int n = 0; n < BAR_CELLS; n++)
        bar += n < full ? "\u2588" : "\u2591";
    std::fprintf(stderr, "\r\033[K%s %s %3d %%  %s", p.what.c_str(), bar.c_str(), static_cast<int>(part * 100),
                 note.c_str());
}

} // namespace

progress progress_begin(std::string what) { return {std::move(what), isatty(STDERR_FILENO) == 1, 0, -1}; }

void progress_show(progress *p, double part, const std::string &note, int64_t now_ns)
{
    if (p->terminal) {
        if (now_ns - p->drawn_ns < REDRAW_NS)
            return;
        p->drawn_ns = now_ns;
        bar_draw(*p, part, note);
    } else if (static_cast<int>(part * 10) > p->tenth) {
        p->tenth = static_cast<int>(part * 10);
        std::fprintf(stderr, "%s %d %%  %s\n", p->what.c_str(), p->tenth * 10, note.c_str());
    }
}

void progress_end(progress *p, const std::string &note)
{
    if (p->terminal) {
        bar_draw(*p, 1, note);
        std::fputc('\n', stderr);
    } else if (p->tenth < 10) {
        std::fprintf(stderr, "%s 100 %%  %s\n", p->what.c_str(), note.c_str());
    }
}

void progress_await(const char *what, const std::function<bool()> &is_done, const std::function<double()> &part)
{
    progress_teller told = progress_teller_begin(what);
    while (!is_done()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        progress_teller_show(&told, part());
    }
    progress_teller_end(&told);
}

progress_teller progress_teller_begin(std::string what)
{
    return {progress_begin(std::move(what)), progress_now_ns(), false};
}

void progress_teller_show(progress_teller *t, double part)
{
    const int64_t now_ns = progress_now_ns();
    t->shown = t->shown || now_ns - t->begun_ns >= MOMENT_NS;
    if (t->shown)
        progress_show(&t->bar, part, "", now_ns);
}

void progress_teller_end(progress_teller *t)
{
    if (t->shown)
        progress_end(&t->bar, "");
}

int64_t progress_now_ns()
{
    using namespace std::chrono;
    return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}
