/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A crew (lattice/crew.h) of threads that stay: the caller is hand 0, each other hand has a thread of its own.
 * Is not:  A pool that balances: who does which brick is the crew's rule.
 * Shape:   between two jobs a thread looks for the next one for LOOK_US, since dabs follow each other, then sleeps. A
 *          share that its hand has not begun when the caller is done with its own is the caller's: nobody waits for a
 *          thread that sleeps or whose core was taken away before it began.
 * Owner:   crew_of_threads_open / _close; the port must not be used after closing. One caller at a time.
 * Errors:  nullptr where the system gives no threads, or hands < 1.
 * Cost:    a job takes a microsecond or two more than its longest share. Waking a sleeping hand takes long (100 us on a
 *          virtual machine); until then the caller works alone.
 */
#ifndef GLAISE_STATION_CREW_OF_THREADS_H
#define GLAISE_STATION_CREW_OF_THREADS_H

#include "sculpture/sculpture.h" /* the port: lattice/crew.h */

constexpr int64_t CREW_OF_THREADS_LOOK_US = 300;

struct crew_of_threads;

crew_of_threads *crew_of_threads_open(uint32_t hands);
void crew_of_threads_close(crew_of_threads *c); /* nullptr is fine */
const crew *crew_of_threads_port(const crew_of_threads *c);

#endif
