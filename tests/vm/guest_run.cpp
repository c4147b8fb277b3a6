/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/vm/guest_run.h"

#include "tests/crash/real_life.h"

#include <chrono>
#include <csignal>
#include <sys/wait.h>
#include <thread>

namespace {

std::vector<std::string> words_of(const guest_run &g)
{
    const std::string quiet = "console=ttyS0 quiet panic=-1 mitigations=off ";
    const std::string file = "driver=file,cache.no-flush=on,";
    return {"-machine", "q35", "-accel", "tcg,thread=single", "-cpu", "max", "-smp", "1", "-m", "512",
            "-nodefaults", "-no-reboot", "-display", "none", "-serial", "file:" + g.console.string(),
            "-kernel", g.kernel.string(), "-initrd", g.root.string(), "-append", quiet + g.kernel_words,
            "-blockdev", file + "node-name=disk,filename=" + g.disk.string(),
            "-blockdev", file + "node-name=log,filename=" + g.log.string(),
            "-blockdev", "driver=blklogwrites,node-name=logged,file=disk,log=log,log-sector-size=512",
            "-device", "virtio-blk-pci,drive=logged,write-cache=on"};
}

} // namespace

std::string guest_run_to_end(const guest_run &g)
{
    using namespace std::chrono;
    const real_life machine = {g.console.parent_path(), "qemu-system-x86_64"};
    const std::string out = "qemu";
    real_life_put(g.log, "");
    const pid_t child = machine.start(words_of(g), out);
    const auto until = steady_clock::now() + seconds(g.limit_s);
    siginfo_t ended = {};
    while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0 &&
           steady_clock::now() < until)
        std::this_thread::sleep_for(milliseconds(50));
    const bool late = ended.si_pid == 0;
    if (late)
        kill(child, SIGKILL);
    const int how = real_life::end(child);
    if (late)
        return "the guest was still running after " + std::to_string(g.limit_s) + " s";
    return how == 0 ? "" : "qemu ended with " + std::to_string(how) + ": " + machine.said(out + ".err");
}
