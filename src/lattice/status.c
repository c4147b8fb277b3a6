/* SPDX-License-Identifier: Apache-2.0 */
#include "lattice/status.h"

const char *status_text(status s)
{
    switch (s) {
    case STATUS_OK: return "all is well";
    case STATUS_POOL_FULL: return "the sculpture has reached its limit of stored clay";
    case STATUS_NO_MEMORY: return "the machine has no memory left";
    case STATUS_BAD_POSE: return "the tool's pose is not usable (not a number, flat, or of absurd size)";
    case STATUS_BAD_PARAMETER: return "a setting is outside its range";
    case STATUS_OUT_OF_RANGE: return "the tool reaches beyond the end of the lattice";
    case STATUS_TOO_LARGE: return "the tool covers more clay than one dab may";
    case STATUS_HISTORY_ENDS: return "history ends here";
    case STATUS_IO: return "the storage failed";
    case STATUS_NO_SPACE: return "the storage is full";
    case STATUS_BUSY: return "the storage has not caught up yet";
    case STATUS_CORRUPT: return "the bytes are damaged";
    case STATUS_NEWER: return "written by a newer version";
    }
    return "unknown status";
}
