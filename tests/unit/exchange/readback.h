/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What:    Strict readers of just what exchange writes, so that unit tests need no other program.
 * Is not:  General readers (tests/peers asks programs that are).
 * Errors:  std::runtime_error naming the place and what was expected.
 */
#ifndef GLAISE_EXCHANGE_READBACK_H
#define GLAISE_EXCHANGE_READBACK_H

#include "soup.h"

#include <string_view>

/* Three vertices a facet, normals per facet. */
soup readback_stl(std::string_view bytes);
soup readback_ply(std::string_view bytes);
/* Alpha reads 255. */
soup readback_obj(std::string_view bytes);
/* `nodes_out` (may be null): the names of the Separator's children, in order. */
soup readback_inventor(std::string_view bytes, std::vector<std::string> *nodes_out = nullptr);

#endif
