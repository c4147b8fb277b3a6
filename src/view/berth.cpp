/* SPDX-License-Identifier: Apache-2.0 */
#include "view/berth.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

namespace {

/* How many units from n on, in n's own word of 64, are like n; taken_out says which. */
int alike(const berth &b, int n, bool *taken_out)
{
    const uint64_t rest = b.taken[static_cast<size_t>(n / 64)] >> (n % 64);
    *taken_out = (rest & 1) != 0;
    return std::min(*taken_out ? std::countr_one(rest) : std::countr_zero(rest), 64 - n % 64);
}

void mark(berth *b, int first, int units, bool taken)
{
    for (int n = first; n < first + units; n++) {
        const uint64_t bit = uint64_t{1} << (n % 64);
        uint64_t &word = b->taken[static_cast<size_t>(n / 64)];
        assert(((word & bit) != 0) != taken);
        word ^= bit;
    }
    b->count += taken ? units : -units;
}

bool is_taken(const berth &b, int unit) { return b.taken[static_cast<size_t>(unit / 64)] >> (unit % 64) & 1; }

} // namespace

int berth_take(berth *b, int units)
{
    assert(units > 0);
    if (units > b->longest)
        return BERTH_NONE;
    int free = 0, most = 0;
    for (int n = 0, step; n < BERTH_UNITS; n += step) {
        bool taken;
        step = alike(*b, n, &taken);
        free = taken ? 0 : free + step;
        most = std::max(most, free);
        if (free >= units) {
            const int first = n + step - free;
            mark(b, first, units, true);
            b->top = std::max(b->top, first + units);
            return first;
        }
    }
    b->longest = most;
    return BERTH_NONE;
}

bool berth_take_at(berth *b, int first, int units)
{
    assert(first >= 0 && units > 0 && first + units <= BERTH_UNITS);
    for (int n = first; n < first + units; n++)
        if (is_taken(*b, n))
            return false;
    mark(b, first, units, true);
    b->top = std::max(b->top, first + units);
    return true;
}

void berth_give(berth *b, int first, int units)
{
    assert(first >= 0 && units > 0 && first + units <= BERTH_UNITS);
    mark(b, first, units, false);
    b->longest = BERTH_UNITS; /* not known: the next take that fails finds out */
    while (b->top > 0 && !is_taken(*b, b->top - 1))
        b->top--;
}
