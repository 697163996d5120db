#include "runner/experiments/aliasing/aliasing_run.h"

#include "metrics/images/flip.h"
#include "metrics/images/image_difference.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/experiments/aliasing/motion.h"
#include "runner/files/output_folder.h"
#include "runner/files/picture_file.h"
#include "runner/files/same_display.h"
#include "runner/findings/run_context.h"
#include "runner/play/progress.h"
#include "runner/play/stage.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace fernlicht {
namespace {

/// Frames that others drew, as luminance: PNG or EXR files with numbers in their names.
struct SequenceFrames {
    std::vector<int> numbers;                 ///< rising by 1
    std::vector<Image<float>> luminance_cdm2; ///< of one size, finite, at least 0
    bool displayed = false;                   ///< PNG: on the reference display of sRGB, white 80 cd/m2. EXR: as the file has it
    FilesRead opened;
    std::filesystem::path first;    ///< its file
    std::vector<std::string> notes; ///< what is not known of how PNGs were shown, one sentence
};

constexpr int fewest_sequence_frames = 8, max_sequence_frames = 64;
constexpr int min_frame_px = 32;
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
    if (count < fewest_sequence_frames || count > max_sequence_frames)
        throw InputError({folder, 0, 0, {}}, fmt::format("found {} numbered frames", count),
                         fmt::format("{} to {} {}; --frames FIRST:LAST takes a part of them", fewest_sequence_frames, max_sequence_frames,
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

/// The frames of a folder, or of its files whose names fit a last part with one '*' (frames/driver-*.exr), from number `first` to `last`,
/// nullopt: all. A file's number is the last run of digits before its extension;
/// other files are left alone. PNG: 8 bits, grey or RGB, decoded by IEC 61966-2-1. EXR: luminance.cdm2, else Y, else R, G and B weighed by
/// BT.709; below 0, which sharpening filters leave, counts as 0. Throws InputError: no such folder, PNG and EXR mixed, a number twice or
/// missing, fewer than 8 or more than 64, other sizes, less than 32 pixels each way, no channel of brightness, values that are not finite,
/// PNGs that were shown in different ways or for another display than sRGB.
SequenceFrames read_sequence(const std::filesystem::path& path_or_pattern, const std::optional<std::pair<int, int>>& range) {
    std::map<int, std::filesystem::path> files = numbered_files(Which(path_or_pattern));
    check_numbers(path_or_pattern, files, range);
    SequenceFrames frames;
    frames.first = files.begin()->second;
    frames.displayed = files.begin()->second.extension() == ".png";
    for (const auto& [number, path] : files) {
        read_file(path, frames.opened); // for the record of what was read
        frames.numbers.push_back(number);
        frames.luminance_cdm2.push_back(frames.displayed ? mapped(read_png(path), displayed_cdm2) : linear_luminance(path));
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
        if (std::min(last.width(), last.height()) < min_frame_px)
            throw InputError({path, 0, 0, {}}, fmt::format("has {} x {} pixels", last.width(), last.height()),
                             fmt::format("{} pixels each way at least", min_frame_px));
    }
    return frames;
}

constexpr int stride_px = 2, largest_factor = 16;

/// How many times as fine the reference is.
int factor_of(const std::filesystem::path& folder, const SequenceFrames& drawn, const SequenceFrames& fine) {
    const Image<float>&small = drawn.luminance_cdm2.front(), &large = fine.luminance_cdm2.front();
    const int factor = large.width() / small.width();
    if (factor < 4 || factor > largest_factor || factor % 2 != 0 || large.width() != factor * small.width() ||
        large.height() != factor * small.height())
        throw InputError({folder, 0, 0, "--supersampled"}, fmt::format("found {} x {} pixels", large.width(), large.height()),
                         fmt::format("4, 6, 8 ... or {} times {} x {}", largest_factor, small.width(), small.height()));
    if (fine.displayed != drawn.displayed)
        throw InputError({folder, 0, 0, "--supersampled"}, fine.displayed ? "found PNG" : "found EXR",
                         drawn.displayed ? "PNG, as the sequence" : "EXR, as the sequence");
    if (fine.numbers != drawn.numbers)
        throw InputError({folder, 0, 0, "--supersampled"}, fmt::format("found frames {} to {}", fine.numbers.front(), fine.numbers.back()),
                         fmt::format("{} to {}, as in the sequence", drawn.numbers.front(), drawn.numbers.back()));
    return factor;
}

/// The folder's own; of a pattern with the folder before it.
std::string sequence_name(std::filesystem::path path) {
    if (path.filename().empty()) // a slash at the end
        path = path.parent_path();
    const std::string last = path.filename().string();
    return last.find('*') == std::string::npos ? last : (path.parent_path().filename() / last).string();
}

struct Measured {
    std::vector<SpatialAliasing> spatial;
    std::vector<Image<double>> residues, levels;
    std::vector<Image<float>> ideal;
};

/// Nothing when interrupted.
std::optional<Measured> measured_over_space(const SequenceFrames& drawn, const SequenceFrames& fine, int factor, double pixels_per_degree,
                                            Progress& progress) {
    Measured all;
    for (std::size_t t = 0; t < drawn.numbers.size(); ++t) {
        progress.done(static_cast<int>(t));
        if (Interruption::requested())
            return std::nullopt;
        const BandSplit split = split_bands(fine.luminance_cdm2[t], factor);
        all.spatial.push_back(measure_spatial_aliasing(drawn.luminance_cdm2[t], split, pixels_per_degree));
        all.residues.push_back(all.spatial.back().aliasing_picture);
        all.levels.push_back(all.spatial.back().level_picture);
        all.ideal.push_back(floats_of(split.ideal));
    }
    return all;
}

} // namespace

AliasingResult run_sequence_aliasing(const SequenceRequest& request) {
    const SequenceFrames drawn = read_sequence(request.sequence, request.frames); // all is read and checked before the folder is made
    const SequenceFrames fine =
        request.against ? read_sequence(*request.against, std::pair(drawn.numbers.front(), drawn.numbers.back())) : SequenceFrames{};
    const Image<float>& first = drawn.luminance_cdm2.front();
    AliasingResult result;
    result.supersample = request.against ? factor_of(*request.against, drawn, fine) : 0;
    result.notes = drawn.notes;
    result.notes.insert(result.notes.end(), fine.notes.begin(), fine.notes.end());
    if (request.against && drawn.displayed)
        if (const std::string note = check_shown_alike({drawn.first, "the sequence"}, {fine.first, "--supersampled"}, "the sequence");
            !note.empty())
            result.notes.push_back(note);
    result.pixels_per_degree =
        request.pixels_per_degree ? *request.pixels_per_degree : pixels_per_degree_of_view(radians(*request.view_fov_deg), first.height());
    OutputFolder folder(request.folder);
    result.context = make_context({}, request.command, 0);
    result.context.backend = result.context.gl_renderer = result.context.gl_version = "none, nothing was rendered";
    add_inputs(result.context.inputs, drawn.opened);
    add_inputs(result.context.inputs, fine.opened);
    const std::string name = sequence_name(request.sequence);
    result.drive = result.title = name;
    result.view.width_px = first.width();
    result.view.height_px = first.height();
    result.rate_hz = request.rate_hz;
    result.displayed = drawn.displayed;
    for (const int number : drawn.numbers)
        result.moments.emplace_back(number, (number - drawn.numbers.front()) / request.rate_hz);
    result.shown = result.moments.size() / 2;
    AliasingRow row;
    row.configuration.others = name;
    row.no_cut_off = row.no_marks = "which pixels show the road is not known";
    row.picture = drawn.luminance_cdm2[result.shown];
    const Interruption listening;
    Progress progress("aliasing of " + name, static_cast<int>(drawn.numbers.size()), request.quiet, "pictures");
    std::optional<Measured> measured;
    if (request.against) {
        measured = measured_over_space(drawn, fine, result.supersample, result.pixels_per_degree, progress);
        if (!measured)
            result.interrupted = Interruption::words();
    } else {
        row.no_spatial = "--against a folder of the same frames rendered finer is needed";
    }
    if (result.interrupted.empty()) {
        const std::vector<Image<float>>& pictures = measured ? measured->ideal : drawn.luminance_cdm2;
        const FlowPaths followed = paths_by_flow(pictures, result.shown, stride_px, FlowMethod::dis,
                                                 drawn.displayed && !measured ? display_step_cdm2(pictures[result.shown])
                                                                              : Image<float>{}); // the finer frames' mean has no steps
        row.by_flow = {followed.started, followed.paths.size(), followed.flat, followed.median_motion_px, followed.median_return_px};
        row.temporal = measured ? aliasing_along(followed, measured->residues, measured->levels, result.rate_hz, result.pixels_per_degree)
                                : flicker_along(followed, pictures, result.rate_hz, result.pixels_per_degree);
        if (!row.temporal)
            row.no_temporal =
                fmt::format("optical flow follows {} of {} points through all frames, and {:.0f} % at least are needed; {} have "
                            "no contrast to tell motion by",
                            followed.paths.size(), followed.started, 100.0 * min_followed, followed.flat);
        if (measured) {
            row.ideal = measured->ideal[result.shown];
            row.spatial = over_moments(measured->spatial, result.shown);
        }
        result.rows.push_back(std::move(row));
    }
    request.write(result);
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
