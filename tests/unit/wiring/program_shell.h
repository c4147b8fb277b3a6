/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:   What the tests that start the real program share: a tape of one ball, what a run left behind, a run by the
 *         shell.
 * Is not: A start without a shell, with limits of its own (program_test.cpp), or one that is killed (crash/real_life.h).
 */
#ifndef GLAISE_TESTS_WIRING_PROGRAM_SHELL_H
#define GLAISE_TESTS_WIRING_PROGRAM_SHELL_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/wait.h>

const std::string PROGRAM_SHELL_BALL = "glaise tape 1\n@0 size 20 20 20\n+0 rate 60\n+0 apply down\n+100 apply up\n";

struct program_shell_outcome {
    int exit = -1;
    std::string out, err;
};

inline std::string program_shell_text(const std::filesystem::path &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/* In `folder`; what it says is left in `said`, as out.txt and err.txt. before: words of the shell. */
inline program_shell_outcome program_shell_run(const std::filesystem::path &folder, const std::filesystem::path &said,
                                               const std::string &words, const std::string &before = "")
{
    const std::filesystem::path out = said / "out.txt", err = said / "err.txt";
    const std::string line = "cd '" + folder.string() + "' && " + before + "'" GLAISE_PROGRAM "' " + words + " >'" +
                             out.string() + "' 2>'" + err.string() + "'";
    const int answer = std::system(line.c_str());
    return {WIFEXITED(answer) ? WEXITSTATUS(answer) : -1, program_shell_text(out), program_shell_text(err)};
}

#endif
