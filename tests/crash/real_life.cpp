/* SPDX-License-Identifier: Apache-2.0 */
#include "tests/crash/real_life.h"

#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

std::string real_life_tape(seeded &chance, int strokes)
{
    std::ostringstream tape;
    tape << "glaise tape 1\n@0 size 7 7 7\n+0 rate 30\n";
    for (int n = 0; n < strokes; n++) {
        char colour[16];
        std::snprintf(colour, sizeof colour, "#%06x", 0x102030 + n * 0x0301);
        const int64_t x = seeded_int(chance, -30, 30), y = seeded_int(chance, -30, 30), z = seeded_int(chance, -30, 30);
        tape << "+20 colour " << colour << "\n+0 place " << x << ' ' << y << ' ' << z << "\n+0 apply down\n+0 glide "
             << x + 12 << ' ' << y + n % 5 << ' ' << z << " 400\n+" << seeded_int(chance, 60, 400) << " apply up\n";
        if (seeded_chance(chance, 0.25))
            tape << "+10 undo\n+10 undo\n+10 redo\n";
        if (seeded_chance(chance, 0.2))
            tape << "+10 undo\n";
        if (seeded_chance(chance, 0.1))
            tape << "+10 fork\n";
    }
    return tape.str();
}

uint64_t real_life_number(const char *variable, uint64_t usual)
{
    const char *text = std::getenv(variable);
    return text ? std::strtoull(text, nullptr, 10) : usual;
}

std::string real_life_text(const std::filesystem::path &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void real_life_put(const std::filesystem::path &path, const std::string &text)
{
    std::ofstream(path, std::ios::binary) << text;
}

pid_t real_life::start(const std::vector<std::string> &words, const std::string &out) const
{
    const pid_t child = fork();
    if (child != 0)
        return child;
    dup2(open((base / out).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open((base / (out + ".err")).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    std::vector<char *> argv = {const_cast<char *>(program.c_str())};
    for (const std::string &word : words)
        argv.push_back(const_cast<char *>(word.c_str()));
    argv.push_back(nullptr);
    execvp(program.c_str(), argv.data());
    _exit(127);
}

int real_life::end(pid_t child)
{
    int how = 0;
    waitpid(child, &how, 0);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -WTERMSIG(how);
}

std::vector<std::string> real_life::replay(const std::string &tape) const
{
    return {"replay", (base / tape).string(), "--store", (base / "store").string(), "--ring", "12", "--hands", "1"};
}

std::string real_life_value(const std::string &text, const std::string &word)
{
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first, second;
        words >> first >> second;
        if (first == word)
            return second.substr(0, second.find(','));
    }
    return "";
}

real_life_states real_life_states_of(const real_life &life, const std::string &tape)
{
    real_life_states states;
    const std::string stroke = "\"stroke\": ", field = "\"field_digest\": \"";
    real_life_put(life.base / "empty.tape", real_life_nothing);
    std::vector<std::string> whole = life.replay(tape);
    whole.insert(whole.end(), {"--stats", (life.base / "whole.json").string()});
    if (life.run(whole, "whole") != 0 ||
        life.run({"replay", (life.base / "empty.tape").string(), "--stats", (life.base / "empty.json").string()},
                 "empty") != 0)
        return states;
    const std::string json = life.said("whole.json"), none = life.said("empty.json");
    for (size_t at = json.find("\"dab\": ["); (at = json.find(stroke, at)) != std::string::npos;) {
        const uint64_t n = std::stoull(json.substr(at + stroke.size()));
        at = json.find(field, at) + field.size();
        states[n].insert(json.substr(at, 16));
    }
    states[0].insert(none.substr(none.find(field) + field.size(), 16));
    return states;
}

real_life_kept real_life_kept_line(const std::string &line)
{
    real_life_kept now;
    std::string kept;
    std::istringstream words(line);
    const bool whole = words >> kept >> now.record >> now.stroke >> now.digest && kept == "kept" &&
                       now.digest.size() == 16 && line.find('\n') != std::string::npos;
    return whole ? now : real_life_kept();
}

real_life_kept real_life_last_kept(const std::string &said)
{
    real_life_kept last;
    for (size_t at = 0, end; (end = said.find('\n', at)) != std::string::npos; at = end + 1) {
        const real_life_kept now = real_life_kept_line(said.substr(at, end + 1 - at));
        if (now.record > 0)
            last = now;
    }
    return last;
}
