#include "runner/experiments/aliasing/sequence_frames.h"

#include "metrics/images/srgb.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/files/picture_file.h"
#include "runner/files/shown_alike.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr int least_frame_px = 32;
constexpr const char* what_is_expected = "PNG or EXR files with numbers in their names, e.g. frame-0001.png";

/// The last run of digits in a name; nullopt where there is none, or it is longer than nine.
std::optional<int> number_in(const std::string& stem) {
    const std::size_t last = stem.find_last_of("0123456789");
    if (last == std::string::npos)
        return std::nullopt;
    const std::size_t before = stem.find_last_not_of("0123456789", last), first = before == std::string::npos ? 0 : before + 1;
    return last - first < 9 ? std::optional(std::stoi(stem.substr(first, last - first + 1))) : std::nullopt;
}

/// A folder, or in its last part a pattern with one '*'.
struct Which {
    std::filesystem::path folder;
    std::string before, after; ///< how names begin and end

    explicit Which(const std::filesystem::path& path) : folder(path) {
        const std::string name = path.filename().string();
        const std::size_t star = name.find('*');
        if (star == std::string::npos)
            return;
        folder = path.has_parent_path() ? path.parent_path() : ".";
        before = name.substr(0, star);
        after = name.substr(star + 1);
    }
    bool takes(const std::string& name) const {
        return name.size() >= before.size() + after.size() && name.starts_with(before) && name.ends_with(after);
    }
};

std::map<int, std::filesystem::path> numbered_files(const Which& which) {
    const std::filesystem::path& folder = which.folder;
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw InputError({folder, 0, 0, {}}, "is no folder", std::string("a folder of ") + what_is_expected);
    std::map<int, std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const std::filesystem::path& path = entry.path();
        if ((path.extension() != ".png" && path.extension() != ".exr") || !which.takes(path.filename().string()))
            continue;
        const auto number = number_in(path.stem().string());
        if (!number)
            continue;
        const auto [other, added] = files.emplace(*number, path);
        if (!added) {
            const bool later = other->second.filename() < path.filename(); // the order of a folder's entries is nobody's
            throw InputError({folder, 0, 0, {}},
                             fmt::format("frame {} is there twice: {} and {}", *number,
                                         printable((later ? other->second : path).filename().string()),
                                         printable((later ? path : other->second).filename().string())),
                             "each number once; FOLDER/BEGIN*END takes those files alone");
        }
    }
    if (error)
        throw InputError({folder, 0, 0, {}}, "cannot be read: " + error.message());
    return files;
}

void check_numbers(const std::filesystem::path& folder, std::map<int, std::filesystem::path>& files,
                   const std::optional<std::pair<int, int>>& range) {
    if (range) {
        std::erase_if(files, [&](const auto& file) { return file.first < range->first || file.first > range->second; });
        for (int number = range->first; number <= range->second; ++number)
            if (!files.contains(number))
                throw InputError({folder, 0, 0, "--frames"}, fmt::format("has no frame {}", number),
                                 fmt::format("every frame from {} to {}", range->first, range->second));
    }
    const auto count = static_cast<int>(files.size());
    if (count < fewest_sequence_frames || count > most_sequence_frames)
        throw InputError({folder, 0, 0, {}}, fmt::format("found {} numbered frames", count),
                         fmt::format("{} to {} {}; --frames FIRST:LAST takes a part of them", fewest_sequence_frames, most_sequence_frames,
                                     what_is_expected));
    int expected = files.begin()->first;
    for (const auto& [number, path] : files) {
        if (number != expected++)
            throw InputError({folder, 0, 0, {}}, fmt::format("frame {} is missing", expected - 1), "frames whose numbers rise by 1");
        if (path.extension() != files.begin()->second.extension())
            throw InputError({path, 0, 0, {}}, "is " + path.extension().string().substr(1) + " among others",
                             "all frames PNG or all EXR, as " + printable(files.begin()->second.filename().string()) +
                                 "; FOLDER/BEGIN*END takes some files alone");
    }
}

Image<float> displayed_luminance(const Image<Rgb8>& picture) {
    Image<float> out(picture.width(), picture.height());
    std::ranges::transform(picture.pixels(), out.pixels().begin(), displayed_cdm2);
    return out;
}

Image<float> linear_luminance(const std::filesystem::path& path) {
    const std::vector<PictureChannel> channels = read_exr(path);
    const auto named = [&](const char* name) -> const Image<float>* {
        const auto at = std::ranges::find(channels, name, &PictureChannel::name);
        return at == channels.end() ? nullptr : &at->values;
    };
    const Image<float>*r = named("R"), *g = named("G"), *b = named("B");
    const Image<float>* whole = named("luminance.cdm2") ? named("luminance.cdm2") : named("Y");
    if (!whole && !(r && g && b))
        throw InputError({path, 0, 0, {}}, "has no channel of brightness", "luminance.cdm2, Y, or R, G and B");
    Image<float> out(channels.front().values.width(), channels.front().values.height());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const auto of = [i](const Image<float>* channel) { return static_cast<double>(channel->pixels()[i]); };
        const double value = whole ? of(whole) : 0.2126 * of(r) + 0.7152 * of(g) + 0.0722 * of(b);
        if (!std::isfinite(value))
            throw InputError({path, 0, 0, {}}, fmt::format("pixel {} is {}", i, value), "numbers");
        out.pixels()[i] = static_cast<float>(std::max(0.0, value));
    }
    return out;
}

} // namespace

SequenceFrames read_sequence(const std::filesystem::path& path_or_pattern, const std::optional<std::pair<int, int>>& range) {
    std::map<int, std::filesystem::path> files = numbered_files(Which(path_or_pattern));
    check_numbers(path_or_pattern, files, range);
    SequenceFrames frames;
    frames.first = files.begin()->second;
    frames.displayed = files.begin()->second.extension() == ".png";
    for (const auto& [number, path] : files) {
        read_file(path, frames.opened); // for the record of what was read
        frames.numbers.push_back(number);
        frames.luminance_cdm2.push_back(frames.displayed ? displayed_luminance(read_png(path)) : linear_luminance(path));
        if (frames.displayed) {
            const std::string note =
                check_shown_alike({frames.first, frames.first.filename().string()}, {path, path.filename().string()}, "the first frame");
            if (!note.empty() && frames.notes.empty())
                frames.notes.push_back(note);
        }
        const Image<float>&first = frames.luminance_cdm2.front(), &last = frames.luminance_cdm2.back();
        if (last.width() != first.width() || last.height() != first.height())
            throw InputError({path, 0, 0, {}}, fmt::format("has {} x {} pixels", last.width(), last.height()),
                             fmt::format("{} x {}, as the first frame", first.width(), first.height()));
        if (std::min(last.width(), last.height()) < least_frame_px)
            throw InputError({path, 0, 0, {}}, fmt::format("has {} x {} pixels", last.width(), last.height()),
                             fmt::format("{} pixels each way at least", least_frame_px));
    }
    return frames;
}

} // namespace fernlicht
