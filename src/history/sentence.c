/* SPDX-License-Identifier: Apache-2.0 */
#include "history/sentence.h"

enum { DIGITS_MAX = 20 };

sentence sentence_begin(char *text, size_t room)
{
    sentence s = {text, room, 0};
    text[0] = '\0';
    return s;
}

void sentence_add(sentence *s, const char *piece)
{
    for (; *piece != '\0' && s->length + 1 < s->room; piece++)
        s->text[s->length++] = *piece;
    s->text[s->length] = '\0';
}

void sentence_add_number(sentence *s, uint64_t number, int digits_min)
{
    char digits[DIGITS_MAX + 1];
    int at = DIGITS_MAX;
    digits[at] = '\0';
    for (; at > 0 && (number > 0 || DIGITS_MAX - at < digits_min || at == DIGITS_MAX); number /= 10)
        digits[--at] = (char)('0' + number % 10);
    sentence_add(s, digits + at);
}
