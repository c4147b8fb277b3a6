/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    A virtual machine (QEMU) that boots what tests/vm/guest made, and runs until the guest switches it off.
 * Is not:  The guest's kernel and root (tests/vm/guest); what its disk's log of writes says (write_log.h).
 * Shape:   one processor, emulated in one thread: with several, a kernel that writes its own code anew now and then
 *          dies while it boots. The disk is /dev/vda and has a cache that must be flushed; each write, flush and
 *          discard goes to the log. The host syncs neither: a write that ended while a flush took its time would be
 *          logged as flushed with it. What the guest says is in `console`.
 * Errors:  a sentence.
 * Cost:    about 5 s until the guest's first program, then some fifty times what the host would take.
 */
#ifndef GLAISE_VM_GUEST_RUN_H
#define GLAISE_VM_GUEST_RUN_H

#include <filesystem>
#include <string>
#include <vector>

struct guest_run {
    std::filesystem::path kernel, root; /* vmlinuz, NAME.cpio.gz */
    std::filesystem::path disk, log;    /* both are there; the log is begun anew */
    std::filesystem::path console;
    std::string kernel_words;           /* for the kernel's command line; it hands NAME=VALUE on to the first program */
    int limit_s = 900;                  /* then it is switched off */
};

/* "" or what is wrong. A guest that had to be switched off is told so; disk and log are what they were then. */
std::string guest_run_to_end(const guest_run &g);

#endif
