/* SPDX-License-Identifier: Apache-2.0 */
/* Goal: the tapes of tapes.txt give the field and the mesh they gave when digests.txt was written, to the bit, and
 *       together they use every action there is.
 * Method: the program itself replays them and its --stats are read. Where a change is meant: tests/golden/renew. */
#include "golden_tape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace {

class golden : public testing::TestWithParam<golden_tape> {
};

TEST_P(golden, digests_are_as_recorded)
{
    const std::vector<golden_tape_digests> recorded = golden_tape_recorded();
    const auto expected = std::find_if(recorded.begin(), recorded.end(),
                                       [](const golden_tape_digests &d) { return d.name == GetParam().name; });
    ASSERT_NE(expected, recorded.end()) << "no line in digests.txt";
    const std::string folder = golden_tape_folder("digests-" + GetParam().name);
    const golden_tape_outcome outcome = golden_tape_replay(GetParam(), folder, {"--stats", folder + "/stats.json"});
    ASSERT_EQ(outcome.exit, 0) << outcome.said;
    EXPECT_EQ(outcome.said.find("refused"), std::string::npos) << outcome.said;
    const golden_tape_digests got = golden_tape_digests_of(GetParam().name, golden_tape_text(folder + "/stats.json"));
    EXPECT_EQ(got.field, expected->field);
    EXPECT_EQ(got.mesh, expected->mesh);
    if (!HasFailure())
        std::filesystem::remove_all(folder);
}

INSTANTIATE_TEST_SUITE_P(tapes, golden, testing::ValuesIn(golden_tape_list()),
                         [](const auto &with) {
                             std::string name = with.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

/* The words behind "ACTION:" in the list of commands that the program prints. */
std::vector<std::string> action_words()
{
    const std::string folder = golden_tape_folder("help"), path = folder + "/help.txt";
    std::vector<std::string> words;
    if (std::system(("'" GLAISE_PROGRAM "' --help >'" + path + "'").c_str()) == 0) {
        std::istringstream lines(golden_tape_text(path));
        for (std::string line; std::getline(lines, line);)
            if (const size_t at = line.find("ACTION: "); at != std::string::npos) {
                std::istringstream rest(line.substr(at + 8));
                for (std::string word; rest >> word;)
                    words.push_back(word);
            }
    }
    std::filesystem::remove_all(folder);
    return words;
}

TEST(golden_list, every_action_is_on_the_tape_of_actions)
{
    const std::string tape = golden_tape_text(SOURCE_ROOT "/tests/golden/actions.tape");
    const std::vector<std::string> words = action_words();
    EXPECT_GE(words.size(), 8u) << "the list of commands was not understood";
    for (const std::string &word : words)
        EXPECT_NE(tape.find(" action " + word + "\n"), std::string::npos) << word;
    for (const char *word : {"tool box", "tool ellipsoid", "tool freeform", "undo", "redo", "clear"})
        EXPECT_NE(tape.find(" " + std::string(word) + "\n"), std::string::npos) << word;
}

TEST(golden_list, lists_agree_and_are_not_empty)
{
    const std::vector<golden_tape> tapes = golden_tape_list();
    EXPECT_GE(tapes.size(), 5u);
    std::vector<std::string> listed, recorded;
    for (const golden_tape &tape : tapes)
        listed.push_back(tape.name);
    for (const golden_tape_digests &line : golden_tape_recorded())
        recorded.push_back(line.name);
    EXPECT_EQ(listed, recorded);
}

TEST(golden_list, the_digest_of_the_whole_is_read_and_no_dabs)
{
    const std::string json = "{\n\"field_digest\": \"00112233445566aa\", \"mesh_digest\": \"00112233445566bb\",\n"
                             "\"dab\": [\n{\"field_digest\": \"ff\", \"mesh_digest\": \"ee\"}]}\n";
    EXPECT_EQ(golden_tape_digests_of("a", json), (golden_tape_digests{"a", "00112233445566aa", "00112233445566bb"}));
    EXPECT_EQ(golden_tape_digests_of("a", json.substr(json.find("\"dab\""))), (golden_tape_digests{"a", "", ""}));
}

} // namespace
