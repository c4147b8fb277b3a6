/* SPDX-License-Identifier: Apache-2.0 */
#include "wiring/sequence.h"

#include "station/angle.h"
#include "wiring/progress.h"

#include <algorithm>

namespace {

constexpr std::string_view ENDING = ".png";
constexpr size_t DIGITS_MIN = 3;

} // namespace

std::string sequence_path(const std::string &path, int n, int count)
{
    const std::string stem = path.ends_with(ENDING) ? path.substr(0, path.size() - ENDING.size()) : path;
    const size_t digits = std::max(DIGITS_MIN, std::to_string(count - 1).size());
    const std::string number = std::to_string(n);
    return stem + "-" + std::string(digits - number.size(), '0') + number + std::string(ENDING);
}

bool sequence_turntable(stage *s, const sculpture *piece, const snapshot &shown, const large_picture_size &size,
                        const std::string &path, int frames, const std::function<void(const std::string &)> &written,
                        std::string *text_out)
{
    const camera_boxes boxes = camera_boxes_of(piece);
    const motion_vector axis = boxes.empty() ? camera_looked_at(shown) : camera_middle(boxes);
    progress bar = progress_begin("turning");
    bool good = true;
    for (int n = 0; good && n < frames; n++) {
        const std::string file = sequence_path(path, n, frames);
        const auto told = [&](double part) { progress_show(&bar, (n + part) / frames, file, progress_now_ns()); };
        const snapshot turned = camera_turned(shown, axis, 2 * ANGLE_PI * n / frames);
        good = stage_picture(s, piece, turned, size, file, text_out, told);
        if (good)
            written(file);
    }
    if (good)
        progress_end(&bar, std::to_string(frames) + " pictures");
    return good;
}
