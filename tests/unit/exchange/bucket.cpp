/* SPDX-License-Identifier: Apache-2.0 */
#include "bucket.h"

#include <algorithm>

status bucket_put(void *self, const void *bytes, size_t n)
{
    bucket &b = *static_cast<bucket *>(self);
    b.calls_after_failure += b.failed;
    const size_t taken = std::min(n, b.room - b.bytes.size());
    b.bytes.append(static_cast<const char *>(bytes), taken);
    b.failed = b.failed || taken < n;
    return b.failed ? STATUS_IO : STATUS_OK;
}

status bucket_get(void *self, uint64_t offset, void *bytes, size_t n, size_t *got_out)
{
    const bucket &b = *static_cast<bucket *>(self);
    if (b.failed)
        return STATUS_IO;
    *got_out = offset >= b.bytes.size() ? 0 : b.bytes.copy(static_cast<char *>(bytes), n, offset);
    return STATUS_OK;
}
