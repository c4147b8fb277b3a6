/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    What a benchmark's figures hold for: processor, compiler, flags, and the vectors that row kernels choose.
 * Is not:  How busy the machine is (bench_clock.h).
 * Errors:  What cannot be found out is called unknown.
 */
#ifndef GLAISE_BENCH_BENCH_MACHINE_H
#define GLAISE_BENCH_BENCH_MACHINE_H

#include <string>

std::string bench_machine_processor();
std::string bench_machine_compiler();
/* Four lines, each with its name. */
std::string bench_machine_text();

#endif
