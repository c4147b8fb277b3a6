/* SPDX-License-Identifier: Apache-2.0 */
#include "station/shelf_copy.h"

#include "station/shelf.h"

#include <algorithm>

namespace {

constexpr size_t BLOCK_BYTES = 1 << 20, THUMBNAIL_BYTES_MAX = 1 << 20;

struct meter {
    const shelf_copy_told &told;
    double expected;
    double done = 0;
    void add(size_t bytes)
    {
        done += static_cast<double>(bytes);
        if (told)
            told(std::min(1.0, done / std::max(1.0, expected)));
    }
};

std::string sentence(const std::string &folder, const std::string &file, status s)
{
    return s == STATUS_OK ? "" : folder + "/" + file + ": " + status_text(s);
}

std::string file_copy(const std::string &from, const byte_store &source, const std::string &to,
                      const byte_store &store, const std::string &file, meter *progress)
{
    std::vector<uint8_t> block(BLOCK_BYTES);
    const char *name = file.c_str();
    uint64_t offset = 0;
    for (size_t got = 1; got > 0; offset += got) {
        status s = source.read(source.self, name, offset, block.data(), block.size(), &got);
        if (s != STATUS_OK)
            return sentence(from, file, s);
        s = store.write(store.self, name, offset, block.data(), got);
        if (s != STATUS_OK)
            return sentence(to, file, s);
        progress->add(got);
    }
    return sentence(to, file, store.sync(store.self, name));
}

struct field_file {
    const byte_store &store;
    uint64_t offset;
    meter progress;
};

status field_write(void *self, const void *bytes, size_t n)
{
    auto *f = static_cast<field_file *>(self);
    const status s = f->store.write(f->store.self, HISTORY_FIELD_NAME, f->offset, bytes, n);
    f->offset += n;
    f->progress.add(n);
    return s;
}

} // namespace

std::string shelf_copy_files(const shelf_port &port, const std::string &from, uint64_t bytes, const std::string &to,
                             const byte_store &store, const shelf_copy_told &told)
{
    byte_store source;
    std::string text = port.open(from, &source);
    if (!text.empty())
        return text;
    std::vector<std::string> files;
    const auto take = [](void *into, const char *name) {
        const std::string_view file(name);
        if (file[0] != '.' && file != SHELF_ABOUT_NAME && file != RESERVE_NAME)
            static_cast<std::vector<std::string> *>(into)->emplace_back(name);
    };
    text = sentence(from, "", source.list(source.self, take, &files));
    meter progress = {told, static_cast<double>(bytes)};
    for (const std::string &file : files)
        if (text.empty())
            text = file_copy(from, source, to, store, file, &progress);
    port.close(source);
    return text;
}

std::string shelf_copy_moment(const shelf_port &port, const std::string &from, still *moment, const std::string &to,
                              const byte_store &store, const shelf_copy_told &told)
{
    field_file field = {store, 0, {told, static_cast<double>(shelf_copy_bytes(*moment))}};
    status s = still_write(moment, field_write, &field);
    if (s == STATUS_OK)
        s = store.sync(store.self, HISTORY_FIELD_NAME);
    if (s != STATUS_OK)
        return sentence(to, HISTORY_FIELD_NAME, s);
    std::optional<std::string> picture;
    if (port.read(from, SHELF_THUMBNAIL_NAME, THUMBNAIL_BYTES_MAX + 1, &picture).empty() && picture &&
        picture->size() <= THUMBNAIL_BYTES_MAX)
        (void)port.replace(to, SHELF_THUMBNAIL_NAME, *picture);
    return "";
}

uint64_t shelf_copy_bytes(const still &moment)
{
    constexpr uint64_t brick_bytes = 8 * 512 + 88; /* all its corners stored (history/checkpoint.h) */
    return CHECKPOINT_HEADER_BYTES + brick_bytes * clay_brick_count(&moment.field.still);
}
