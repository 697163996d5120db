#include "runner/experiments/aliasing/sequence_run.h"

#include "metrics/images/flip.h"
#include "runner/experiments/aliasing/flow_measures.h"
#include "runner/experiments/aliasing/over_moments.h"
#include "runner/experiments/aliasing/sequence_frames.h"
#include "runner/files/output_folder.h"
#include "runner/files/shown_alike.h"
#include "runner/findings/run_context.h"
#include "runner/play/interruption.h"
#include "runner/play/progress.h"
#include "runner/play/stage.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr int stride_px = 2, largest_factor = 16;

/// How many times as fine the reference is.
int factor_of(const std::filesystem::path& folder, const SequenceFrames& drawn, const SequenceFrames& fine) {
    const Image<float>&small = drawn.luminance_cdm2.front(), &large = fine.luminance_cdm2.front();
    const int factor = large.width() / small.width();
    if (factor < 4 || factor > largest_factor || factor % 2 != 0 || large.width() != factor * small.width() ||
        large.height() != factor * small.height())
        throw InputError({folder, 0, 0, "--against"}, fmt::format("found {} x {} pixels", large.width(), large.height()),
                         fmt::format("4, 6, 8 ... or {} times {} x {}", largest_factor, small.width(), small.height()));
    if (fine.displayed != drawn.displayed)
        throw InputError({folder, 0, 0, "--against"}, fine.displayed ? "found PNG" : "found EXR",
                         drawn.displayed ? "PNG, as the sequence" : "EXR, as the sequence");
    if (fine.numbers != drawn.numbers)
        throw InputError({folder, 0, 0, "--against"}, fmt::format("found frames {} to {}", fine.numbers.front(), fine.numbers.back()),
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
        if (Interruption::asked())
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
        if (const std::string note = check_shown_alike({drawn.first, "the sequence"}, {fine.first, "--against"}, "the sequence");
            !note.empty())
            result.notes.push_back(note);
    result.pixels_per_degree =
        request.pixels_per_degree ? *request.pixels_per_degree : pixels_per_degree_of_view(radians(*request.view_fov_deg), first.height());
    OutputFolder folder(request.folder);
    result.context = make_context({}, request.command, 0);
    result.context.backend = result.context.gl_renderer = result.context.gl_version = "none, nothing was drawn";
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
            result.interrupted = "interrupted by the user";
    } else {
        row.no_spatial = "--against a folder of the same frames drawn finer is needed";
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
                            followed.paths.size(), followed.started, 100.0 * least_followed, followed.flat);
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
