/* SPDX-License-Identifier: Apache-2.0 */
#include "station/history_thread.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>

struct history_thread {
    sculpture *piece = nullptr;
    history *of = nullptr;
    std::function<void(const keeper_facts &)> tell_kept;
    keeper port{};
    std::thread thread;

    std::mutex guard; /* of all that follows */
    std::condition_variable handed, progressed;
    keeper_job *first = nullptr, *last = nullptr;
    keeper_job *field = nullptr; /* its checkpoint is being written */
    keeper_facts facts{};
    bool idle = true;  /* nothing waits and nothing is in hand */
    bool looks = false; /* it will look up by itself within LOOK_MS */
    bool ends = false;
};

namespace {

history_thread *of(void *self) { return static_cast<history_thread *>(self); }

/* Waking a thread takes the frame several microseconds. A stroke under way hands a part now and then: for the next of
   them the thread looks up by itself, well within the 100 ms. */
constexpr int LOOK_MS = 10;

bool is_part(const keeper_job *job) { return job->kind == KEEPER_PUT && !job->ends; }

/* --- the other side --- */

void port_hand(void *self, keeper_job *job)
{
    history_thread *t = of(self);
    bool wake = false;
    {
        const std::lock_guard<std::mutex> lock(t->guard);
        job->next = nullptr;
        (t->last ? t->last->next : t->first) = job;
        t->last = job;
        t->idle = false;
        wake = !t->looks || !is_part(job);
    }
    if (wake)
        t->handed.notify_one();
}

bool port_is_done(void *self, const keeper_job *job)
{
    const std::lock_guard<std::mutex> lock(of(self)->guard);
    return job->done;
}

void port_await(void *self, const keeper_job *job)
{
    std::unique_lock<std::mutex> lock(of(self)->guard);
    of(self)->progressed.wait(lock, [job] { return job->done; });
}

void port_settle(void *self)
{
    std::unique_lock<std::mutex> lock(of(self)->guard);
    of(self)->progressed.wait(lock, [self] { return of(self)->idle; });
}

void port_look(void *self, keeper_facts *facts_out)
{
    const std::lock_guard<std::mutex> lock(of(self)->guard);
    *facts_out = of(self)->facts;
}

/* --- the thread --- */

void publish(history_thread *t)
{
    keeper_facts facts;
    keeper_look(t->of, &facts);
    t->of->trouble.text[0] = '\0';
    bool more_kept = false;
    {
        const std::lock_guard<std::mutex> lock(t->guard);
        more_kept = facts.kept != t->facts.kept;
        if (facts.trouble.text[0] == '\0')
            facts.trouble = t->facts.trouble;
        t->facts = facts;
    }
    if (more_kept && t->tell_kept)
        t->tell_kept(facts);
}

void job_end(history_thread *t, keeper_job *job)
{
    {
        const std::lock_guard<std::mutex> lock(t->guard);
        job->done = true;
    }
    t->progressed.notify_all();
}

keeper_job *job_take(history_thread *t)
{
    const std::lock_guard<std::mutex> lock(t->guard);
    keeper_job *job = t->first;
    if (job) {
        t->first = job->next;
        t->last = t->first ? t->last : nullptr;
    }
    return job;
}

/* Answers whether there were any. */
bool jobs_do(history_thread *t)
{
    bool any = false;
    for (; keeper_job *job = job_take(t); any = true) {
        keeper_do(t->of, job);
        publish(t);
        if (job->kind == KEEPER_FIELD && t->of->writer)
            t->field = job;
        else
            job_end(t, job);
    }
    return any;
}

/* One slice of what can wait; answers whether there is more. */
bool work(history_thread *t)
{
    const bool more = history_work(t->of);
    if (t->field && !t->of->writer) {
        publish(t);
        job_end(t, t->field);
        t->field = nullptr;
    }
    return more;
}

void run(history_thread *t)
{
    for (;;) {
        const bool any = jobs_do(t);
        /* Between two slices of a checkpoint a full medium has become no roomier. */
        const bool waits = !any && t->field && t->of->medium == HISTORY_MEDIUM_FULL;
        const bool kept = !waits && history_keep(t->of) == STATUS_OK;
        publish(t);
        const bool more = work(t);
        std::unique_lock<std::mutex> lock(t->guard);
        if (t->first || (more && (t->field || !t->ends))) /* at the end only a checkpoint under way is waited for */
            continue;
        t->idle = true;
        t->progressed.notify_all();
        if (t->ends)
            return;
        const auto something = [t] { return t->first || t->ends; };
        t->looks = t->of->in_stroke;
        if (t->looks)
            t->handed.wait_for(lock, std::chrono::milliseconds(LOOK_MS), something);
        else if (kept)
            t->handed.wait(lock, something);
        else
            t->handed.wait_for(lock, std::chrono::milliseconds(HISTORY_THREAD_AGAIN_MS), something);
        t->looks = false;
    }
}

} // namespace

history_thread *history_thread_open(sculpture *piece, std::function<void(const keeper_facts &)> kept)
{
    auto *t = new history_thread;
    t->piece = piece;
    t->of = &piece->history;
    t->tell_kept = std::move(kept);
    t->port = {t, port_hand, port_is_done, port_await, port_settle, port_look};
    keeper_look(t->of, &t->facts);
    /* First, since the keeper in place ends its work here, in the caller's thread. */
    sculpture_keeper_set(piece, &t->port);
    try {
        t->thread = std::thread(run, t);
    } catch (const std::system_error &) {
        sculpture_keeper_set(piece, nullptr);
        delete t;
        return nullptr;
    }
    return t;
}

void history_thread_close(history_thread *t)
{
    if (!t)
        return;
    {
        const std::lock_guard<std::mutex> lock(t->guard);
        t->ends = true;
    }
    t->handed.notify_one();
    t->thread.join();
    sculpture_keeper_set(t->piece, nullptr);
    delete t;
}
