/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    One long piece of work off the frame path: a file written or read, while sculpting goes on. Whoever sent it
 *          out looks up now and then how far it is.
 * Is not:  A share of a dab (crew_of_threads.h); a queue: each errand has a thread, and there are few.
 * Shape:   errand_begin -> errand_part, errand_is_done, as often as one likes -> errand_end.
 * Owner:   what the work touches is its own until errand_end: a still of the piece (sculpture/still.h), or one that
 *          nobody else has yet.
 * Errors:  the work's answer: empty when it is done, else a sentence for the person. Where the system gives no thread,
 *          errand_begin does the work itself.
 * Cost:    it runs at a lower priority than whoever begins it, so that the frame has the cores first.
 */
#ifndef GLAISE_STATION_ERRAND_H
#define GLAISE_STATION_ERRAND_H

#include <functional>
#include <string>

constexpr int ERRAND_NICENESS = 10;

struct errand;

/* The work says how far it is by calling `told` with 0..1, as often as it likes. */
using errand_work = std::function<std::string(const std::function<void(double)> &told)>;

errand *errand_begin(errand_work work);
double errand_part(const errand *e); /* 0..1 */
bool errand_is_done(const errand *e);
/* Waits for the work to be done, and gives its answer. */
std::string errand_end(errand *e);

#endif
