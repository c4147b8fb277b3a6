/* SPDX-License-Identifier: Apache-2.0 */
#include "bench_machine.h"

#include "lattice/lanes.h"

#include <fstream>
#include <thread>

std::string bench_machine_processor()
{
    std::ifstream info("/proc/cpuinfo");
    std::string line;
    while (std::getline(info, line))
        for (const char *label : {"model name", "Model", "CPU part"})
            if (line.rfind(label, 0) == 0 && line.find(':') != std::string::npos)
                return line.substr(line.find(':') + 2);
    return "unknown processor";
}

std::string bench_machine_compiler()
{
#if defined(__clang__)
    return "clang " __clang_version__;
#else
    return "gcc " __VERSION__;
#endif
}

std::string bench_machine_text()
{
    return "machine   " + bench_machine_processor() + ", " + std::to_string(std::thread::hardware_concurrency()) +
           " threads\ncompiler  " + bench_machine_compiler() + "\nflags     " BENCH_FLAGS "\nvectors   " +
           lanes_name(lanes_best()) + " where nothing else is said\n";
}
