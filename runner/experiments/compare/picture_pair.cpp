#include "runner/experiments/compare/picture_pair.h"

#include "runner/files/other_picture.h"
#include "runner/files/same_display.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <oneapi/tbb/parallel_invoke.h>

namespace fernlicht {
namespace {

enum class Format { png, exr, other, none };

Format format_of(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored))
        throw InputError({path, 0, 0, {}}, "does not exist");
    std::array<char, 4> bytes{};
    std::ifstream stream(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path, ignored) || !stream)
        throw InputError({path, 0, 0, {}}, "is no file that can be read");
    stream.read(bytes.data(), bytes.size());
    const std::string_view start(bytes.data(), bytes.size());
    if (start == "\x89PNG")
        return Format::png;
    if (start == "\x76\x2f\x31\x01")
        return Format::exr;
    return is_other_picture(path) ? Format::other : Format::none;
}

OtherPicture read_picture(const std::filesystem::path& path) {
    switch (format_of(path)) {
    case Format::png:
        return {read_png(path), {}};
    case Format::exr:
        return {{}, read_exr(path)};
    case Format::other:
        return read_other_picture(path);
    case Format::none:
        break;
    }
    throw InputError({path, 0, 0, {}}, "is neither a PNG nor an EXR picture, nor named as another", "two pictures of one kind");
}

std::string size_text(int width, int height) { return fmt::format("{} x {} pixels", width, height); }

void check_sizes(const PicturePair& pair, int width, int height) {
    if (width != pair.width || height != pair.height)
        throw InputError({pair.tested, 0, 0, {}}, "has " + size_text(width, height),
                         size_text(pair.width, pair.height) + " as the reference");
}

std::string unit_of(const std::string& channel) {
    const std::size_t point = channel.rfind('.');
    const std::string end = point == std::string::npos ? "" : channel.substr(point + 1);
    return end == "cdm2" ? "cd/m2" : end;
}

void check_finite(const std::filesystem::path& file, const PictureChannel& channel) {
    for (int y = 0; y < channel.values.height(); ++y)
        for (int x = 0; x < channel.values.width(); ++x)
            if (!std::isfinite(channel.values.at(x, y)))
                throw InputError({file, 0, 0, channel.name}, fmt::format("pixel {}, {} is {}", x, y, channel.values.at(x, y)), "a number");
}

std::string names_of(const std::vector<PictureChannel>& channels) {
    std::vector<std::string> names;
    for (const PictureChannel& channel : channels)
        names.push_back(printable(channel.name));
    std::ranges::sort(names);
    return fmt::format("{}", fmt::join(names, ", "));
}

void take_linear(PicturePair& pair, std::vector<PictureChannel> reference, std::vector<PictureChannel> tested, bool common_alone) {
    pair.width = reference[0].values.width();
    pair.height = reference[0].values.height();
    check_sizes(pair, tested[0].values.width(), tested[0].values.height());
    if (!common_alone && names_of(reference) != names_of(tested))
        throw InputError({pair.tested, 0, 0, {}}, "has the channels " + names_of(tested), names_of(reference) + " as the reference");
    for (PictureChannel& channel : reference) {
        const auto found = std::ranges::find(tested, channel.name, &PictureChannel::name);
        if (found == tested.end()) {
            pair.alone.push_back(channel.name);
            continue;
        }
        PictureChannel& other = *found;
        check_finite(pair.reference, channel);
        check_finite(pair.tested, other);
        pair.linear.push_back({channel.name, unit_of(channel.name), std::move(channel.values), std::move(other.values)});
    }
    for (const PictureChannel& channel : tested)
        if (std::ranges::find(reference, channel.name, &PictureChannel::name) == reference.end())
            pair.alone.push_back(channel.name);
}

} // namespace

PicturePair read_picture_pair(const std::filesystem::path& reference, const std::filesystem::path& tested, bool common_alone) {
    PicturePair pair;
    pair.reference = reference;
    pair.tested = tested;
    OtherPicture a, b;
    std::exception_ptr bad; // of the second: of two bad pictures the first is told
    oneapi::tbb::parallel_invoke(
        [&] {
            try {
                b = read_picture(tested);
            } catch (...) {
                bad = std::current_exception();
            }
        },
        [&] { a = read_picture(reference); });
    if (bad)
        std::rethrow_exception(bad);
    const auto kind = [](const OtherPicture& picture) {
        return picture.display.empty() ? "an EXR picture or another one of numbers" : "a PNG or another picture of 8 bits";
    };
    if (a.display.empty() != b.display.empty())
        throw InputError({tested, 0, 0, {}}, std::string("is ") + kind(b), std::string(kind(a)) + " as the reference");
    if (a.display.empty()) {
        take_linear(pair, std::move(a.linear), std::move(b.linear), common_alone);
        return pair;
    }
    if (format_of(reference) == Format::png && format_of(tested) == Format::png)
        if (const std::string note = check_shown_alike({reference, "A"}, {tested, "B"}, "the reference"); !note.empty())
            pair.notes.push_back(note);
    pair.reference_display = std::move(a.display);
    pair.tested_display = std::move(b.display);
    pair.width = pair.reference_display.width();
    pair.height = pair.reference_display.height();
    check_sizes(pair, pair.tested_display.width(), pair.tested_display.height());
    return pair;
}

bool is_picture(const std::filesystem::path& path) { return format_of(path) != Format::none; }

} // namespace fernlicht
