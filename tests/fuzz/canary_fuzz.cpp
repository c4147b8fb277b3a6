/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Goal    Prove that fuzzing finds bugs: this program has one, and its test fails unless the fuzzer finds it.
 * Method  A length-prefixed record behind a two-byte tag, whose length is believed. Coverage feedback must lead through
 *         the tag byte by byte, and AddressSanitizer must see the one byte read behind an exact-size copy.
 */
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace {

int believe_the_length(const uint8_t *record, size_t size)
{
    int sum = 0;
    if (size > 2 && record[0] == 'c') {
        if (record[1] == 'y') {
            for (size_t i = 0; i < record[2]; i++) {
                sum += record[3 + i];
            }
        }
    }
    return sum;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *copy = static_cast<uint8_t *>(std::malloc(size));
    if (size > 0) {
        std::memcpy(copy, data, size);
    }
    volatile int sum = believe_the_length(copy, size);
    (void)sum;
    std::free(copy);
    return 0;
}
