#include "runner/experiments/aliasing/aliasing_run.h"

#include "renderer/renderer.h"
#include "runner/experiments/accuracy/technique_sweep.h"
#include "runner/experiments/aliasing/motion.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/preparation.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/photometry.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <numbers>
#include <set>

namespace fernlicht {
namespace {

constexpr int fewest_frames = 8, max_frames = 64, max_drawn_px = 16384, min_px = 32, track_stride_px = 2;

/// The mean of each group of n x n pixels.
Image<float> averaged(const Image<float>& fine, int n) {
    if (n == 1)
        return fine;
    Image<float> out(fine.width() / n, fine.height() / n);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x) {
            double sum = 0.0;
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    sum += static_cast<double>(fine.at(x * n + i, y * n + j));
            out.at(x, y) = static_cast<float>(sum / (n * n));
        }
    return out;
}

struct Pictures {
    Image<float> luminance_cdm2, illuminance_lx; ///< the second only where asked for and known
};

/// A view drawn n times as fine each way and averaged down by `average`. What is brighter than white is white: no display shows more.
Pictures pictures_of(Renderer& renderer, const Moment& moment, const View& view, int n, int average, bool displayed, bool illuminance,
                     float white_cdm2) {
    const Frame frame = renderer.draw(moment, at_size(view, n * view.width_px, n * view.height_px),
                                      {.colour = displayed, .illuminance = illuminance, .luminance = !displayed});
    Pictures pictures;
    if (displayed) {
        pictures.luminance_cdm2 = mapped(frame.colour, displayed_cdm2);
    } else {
        pictures.luminance_cdm2 = frame.luminance_cdm2;
        for (float& value : pictures.luminance_cdm2.pixels())
            value = std::min(value, white_cdm2);
    }
    pictures.luminance_cdm2 = averaged(pictures.luminance_cdm2, average);
    if (illuminance)
        pictures.illuminance_lx = averaged(frame.illuminance_lx, average);
    return pictures;
}

RendererSettings settings_of(const Drive& drive, const AliasingConfiguration& configuration) {
    Configuration same;
    same.technique = configuration.technique;
    same.beams = configuration.beams;
    same.shadows = drive.shadows;
    return settings_of(drive, same);
}

/// What a technique's pictures are held against: itself, with float beams, drawn `supersample` times as fine, trilinear.
struct References {
    std::string technique;
    std::vector<BandSplit> splits; ///< by moment
    EdgeReference edges;           ///< of the moment shown
};

struct Session {
    const AliasingRequest& request;
    const Stage& stage;
    Device& device;
    std::vector<Moment> moments;
    AliasingResult& result;
    std::vector<Frame> shapes; ///< depth and ids of each moment, where there are several
    std::vector<PixelTrack> tracks;
    References references;
    Progress& progress;
    int done = 0;

    float white_cdm2() const { return static_cast<float>(stage.drive.tone_mapper.l_max_cdm2); }
    bool step() {
        progress.done(done++);
        return !Interruption::requested();
    }
};

/// What of the moment shown is road or mark, and its light without shadows: what tells edges apart by what they are.
void draw_edges(Session& s, const Technique& technique, const AliasingConfiguration& finest) {
    const Moment& moment = s.moments[s.result.shown];
    const View fine =
        at_size(s.result.view, s.request.supersample * s.result.view.width_px, s.request.supersample * s.result.view.height_px);
    s.references.edges.ground = ground_of(s.device, s.stage.scene, moment, fine);
    if (!technique.illuminance)
        return;
    RendererSettings settings = settings_of(s.stage.drive, finest);
    settings.shadows.method = ShadowMethod::none;
    s.references.edges.unshadowed_lx = Renderer(s.device, s.stage.scene, settings).draw(moment, fine, {.illuminance = true}).illuminance_lx;
}

bool draw_references(Session& s, const Technique& technique) {
    if (s.references.technique == technique.name)
        return true;
    AliasingConfiguration finest;
    finest.technique = technique.name;
    use_surface_filter(s.device, SurfaceFilter::trilinear);
    Renderer renderer(s.device, s.stage.scene, settings_of(s.stage.drive, finest));
    s.references = {};
    for (std::size_t m = 0; m < s.moments.size(); ++m) {
        if (!s.step())
            return false;
        Pictures fine = pictures_of(renderer, s.moments[m], s.result.view, s.request.supersample, 1, s.request.displayed,
                                    technique.illuminance && m == s.result.shown, s.white_cdm2());
        s.references.splits.push_back(split_bands(fine.luminance_cdm2, s.request.supersample));
        if (m == s.result.shown)
            s.references.edges = {s.request.supersample, std::move(fine.luminance_cdm2), std::move(fine.illuminance_lx), {}, {}};
    }
    draw_edges(s, technique, finest);
    s.references.technique = technique.name;
    return true;
}

void measure_jaggedness_of(Session& s, AliasingRow& row, const Pictures& drawn) {
    const EdgeReference& edges = s.references.edges;
    if (drawn.illuminance_lx.empty()) {
        row.no_cut_off = fmt::format("technique {} computes no illuminance", row.configuration.technique);
    } else {
        row.cut_off = cut_off_jaggedness(drawn.illuminance_lx, edges, s.request.level_lx);
        if (!row.cut_off)
            row.no_cut_off = fmt::format("no line of {} lx on the road, or too short", s.request.level_lx);
    }
    row.marks = mark_jaggedness(drawn.luminance_cdm2, edges);
    if (!row.marks)
        row.no_marks = "no lit mark two pixels wide on the road, or too short";
}

void keep_pictures(FlowComparison& compared, const FlowPair& pair) {
    compared.known_px = Image<float>(pair.kept.width(), pair.kept.height(), -1.0F);
    compared.estimated_px = compared.off_px = compared.known_px;
    for (std::size_t i = 0; i < pair.kept.size(); ++i) {
        const float dx = pair.estimated.dx_px.pixels()[i], dy = pair.estimated.dy_px.pixels()[i];
        const float known_dx = pair.known.dx_px.pixels()[i], known_dy = pair.known.dy_px.pixels()[i];
        const bool known = pair.known_at.pixels()[i] != 0, kept = pair.kept.pixels()[i] != 0;
        if (known)
            compared.known_px.pixels()[i] = std::hypot(known_dx, known_dy);
        if (kept)
            compared.estimated_px.pixels()[i] = std::hypot(dx, dy);
        if (known && kept)
            compared.off_px.pixels()[i] = std::hypot(dx - known_dx, dy - known_dy);
    }
}

/// Both methods on both pictures; false when interrupted.
bool compare_flows(Session& s, const std::vector<Image<float>>& drawn, const std::vector<Image<double>>& residues,
                   const std::vector<Image<double>>& levels) {
    std::vector<Image<float>> ideal;
    for (const BandSplit& split : s.references.splits)
        ideal.push_back(floats_of(split.ideal));
    std::vector<KnownFlow> known;
    for (std::size_t m = 0; m + 1 < s.moments.size(); ++m)
        known.push_back(known_flow(s.moments, s.result.view, s.shapes, m, m + 1));
    for (const bool as_drawn : {false, true})
        for (const FlowMethod method : {FlowMethod::dis, FlowMethod::farneback}) {
            if (Interruption::requested())
                return false;
            const std::vector<Image<float>>& pictures = as_drawn ? drawn : ideal;
            FlowComparison compared{as_drawn ? "as rendered" : "what the display could show", method, {}, {}, {}, {}, {}, {}};
            std::vector<FlowPair> pairs;
            for (std::size_t m = 0; m < known.size(); ++m) {
                const Flow there = optical_flow(pictures[m], pictures[m + 1], method);
                const Flow back = optical_flow(pictures[m + 1], pictures[m], method);
                pairs.push_back({there, found_again(there, back, max_return_px), known[m].flow, known[m].known});
            }
            compared.error = flow_error(pairs);
            if (s.result.flows.empty())
                keep_pictures(compared, pairs[std::min(s.result.shown, pairs.size() - 1)]);
            const FlowPaths followed = paths_by_flow(pictures, s.result.shown, track_stride_px, method);
            compared.temporal = as_drawn ? flicker_along(followed, pictures, s.result.rate_hz, s.result.pixels_per_degree)
                                         : aliasing_along(followed, residues, levels, s.result.rate_hz, s.result.pixels_per_degree);
            std::set<std::int32_t> starts;
            for (const Path& path : followed.paths)
                starts.insert(track_of(path, s.result.view.width_px, s.result.view.height_px)[s.result.shown]);
            std::vector<PixelTrack> same;
            std::ranges::copy_if(s.tracks, std::back_inserter(same),
                                 [&](const PixelTrack& track) { return starts.contains(track[s.result.shown]); });
            if (!same.empty())
                compared.known = measure_temporal_aliasing(residues, levels, same, s.result.rate_hz, s.result.pixels_per_degree);
            s.result.flows.push_back(std::move(compared));
        }
    return true;
}

/// False when interrupted: the row is then incomplete.
bool measure_row(Session& s, AliasingRow& row) {
    const Technique& technique = technique_named(row.configuration.technique);
    if (!s.request.displayed && !technique.luminance) {
        row.why_not = fmt::format("technique {} computes no luminance; --values display measures what it shows", technique.name);
        return true;
    }
    if (!draw_references(s, technique))
        return false;
    use_surface_filter(s.device, row.configuration.filter);
    Renderer renderer(s.device, s.stage.scene, settings_of(s.stage.drive, row.configuration));
    const int side = static_cast<int>(std::lround(std::sqrt(row.configuration.samples)));
    std::vector<SpatialAliasing> found;
    std::vector<Image<double>> residues, levels;
    std::vector<Image<float>> drawn_pictures; // kept for optical flow alone
    const bool flow = s.request.flow && s.result.flows.empty() && s.moments.size() > 1;
    for (std::size_t m = 0; m < s.moments.size(); ++m) {
        if (!s.step())
            return false;
        const bool shown = m == s.result.shown;
        Pictures drawn = pictures_of(renderer, s.moments[m], s.result.view, side, side, s.request.displayed, technique.illuminance && shown,
                                     s.white_cdm2());
        found.push_back(measure_spatial_aliasing(drawn.luminance_cdm2, s.references.splits[m], s.result.pixels_per_degree));
        if (shown) {
            measure_jaggedness_of(s, row, drawn);
            row.picture = drawn.luminance_cdm2;
            row.ideal = floats_of(s.references.splits[m].ideal);
        }
        if (flow)
            drawn_pictures.push_back(std::move(drawn.luminance_cdm2));
        if (s.moments.size() > 1) {
            residues.push_back(shown ? found.back().aliasing_picture : std::move(found.back().aliasing_picture));
            levels.push_back(shown ? found.back().level_picture : std::move(found.back().level_picture));
        }
    }
    row.spatial = over_moments(found, s.result.shown);
    if (s.moments.size() == 1)
        row.no_temporal = "one moment; --frames measures over time";
    else if (s.tracks.empty())
        row.no_temporal = "no point of the scene is seen in all frames";
    else
        row.temporal = measure_temporal_aliasing(residues, levels, s.tracks, s.result.rate_hz, s.result.pixels_per_degree);
    if (flow && !compare_flows(s, drawn_pictures, residues, levels))
        return false;
    return true;
}

std::vector<int> ticks_of(const AliasingRequest& request) {
    if (request.flow && !request.frames)
        throw InputError({request.drive.file, 0, 0, "--flow"}, "found no --frames", "frames to follow motion through");
    const int count = tick_count(request.drive), middle = count / 2;
    if (!request.frames) {
        const double time_s = request.moment_s.value_or(middle * request.drive.step_s), tick = std::round(time_s / request.drive.step_s);
        if (!(tick >= 0.0 && tick < count))
            throw InputError({request.drive.file, 0, 0, "--moment"}, fmt::format("found {} s", time_s),
                             fmt::format("0 to {:.3f} s, the drive's moments", (count - 1) * request.drive.step_s));
        return {static_cast<int>(tick)};
    }
    const auto [first, last] = *request.frames;
    if (first < 0 || last >= count || last - first + 1 < fewest_frames || last - first + 1 > max_frames)
        throw InputError({request.drive.file, 0, 0, "--frames"}, fmt::format("found {}:{}", first, last),
                         fmt::format("{} to {} frames in a row out of 0:{}", fewest_frames, max_frames, count - 1));
    std::vector<int> ticks;
    for (int tick = first; tick <= last; ++tick)
        ticks.push_back(tick);
    return ticks;
}

const View& checked_view(const AliasingRequest& request) {
    const View* const view = driver_view(request.drive);
    if (!view)
        throw InputError({request.drive.file, 0, 0, "views"}, "found only maps", "a perspective view");
    int finest = request.supersample;
    for (const int samples : request.samples)
        finest = std::max(finest, static_cast<int>(std::lround(std::sqrt(samples))));
    if (std::min(view->width_px, view->height_px) < min_px)
        throw InputError({request.drive.file, 0, 0, "--resolution"}, fmt::format("found {}x{}", view->width_px, view->height_px),
                         "32 pixels each way at least");
    if (finest * std::max(view->width_px, view->height_px) > max_drawn_px)
        throw InputError({request.drive.file, 0, 0, "--supersample"},
                         fmt::format("found {} times {}x{}", finest, view->width_px, view->height_px),
                         fmt::format("at most {} pixels each way; a smaller --resolution or --supersample", max_drawn_px));
    return *view;
}

std::vector<Frame> shapes_of(const Stage& stage, Device& device, const std::vector<Moment>& moments, const View& view) {
    Renderer renderer(device, stage.scene, {});
    std::vector<Frame> frames;
    for (const Moment& moment : moments)
        frames.push_back(renderer.draw(moment, view, {.depth = true, .ids = true}));
    return frames;
}

} // namespace

std::vector<AliasingConfiguration> aliasing_configurations(const AliasingRequest& request) {
    std::vector<std::string> techniques = request.techniques;
    if (techniques.empty())
        techniques.push_back(request.drive.technique);
    std::vector<AliasingConfiguration> all;
    for (std::size_t i = 0; i < techniques.size(); ++i) {
        technique_named(techniques[i], {}, "--techniques");
        if (std::find(techniques.begin(), techniques.begin() + static_cast<std::ptrdiff_t>(i), techniques[i]) !=
            techniques.begin() + static_cast<std::ptrdiff_t>(i))
            throw InputError({{}, 0, 0, "--techniques"}, "found " + techniques[i] + " twice", "each technique once");
        AliasingConfiguration base{techniques[i], request.beams.front(), request.filters.front(), request.samples.front(), "", ""};
        all.push_back(base);
        const auto vary = [&](const char* what, auto member, const auto& values) {
            for (std::size_t v = 1; v < values.size(); ++v) {
                all.push_back(base);
                all.back().*member = values[v];
                all.back().varied = what;
            }
        };
        vary("beams", &AliasingConfiguration::beams, request.beams);
        vary("filter", &AliasingConfiguration::filter, request.filters);
        vary("samples", &AliasingConfiguration::samples, request.samples);
    }
    return all;
}

AliasingResult run_aliasing(const AliasingRequest& request) {
    const std::vector<int> ticks = ticks_of(request); // everything is read and checked before the first frame
    const std::vector<AliasingConfiguration> configurations = aliasing_configurations(request);
    AliasingResult result;
    result.view = checked_view(request);
    Stage stage(request.drive);
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set); // the stage's: simulated, and aimed
    refuse_unfitted_tone_mapper(stage.drive);
    Device device = open_device(request.backend);
    check_sanity(device);
    choose_shadows(stage, device, settings_for(device, false));
    check_planar_shadows(stage, device, moments_at(ticks, stage, lamp_set));
    OutputFolder folder(request.folder);
    result.context = make_context(device.info(), request.command, request.drive.seed);
    add_inputs(result.context.inputs, stage.drive.opened);
    add_inputs(result.context.inputs, stage.network.opened);
    result.drive = stage.drive.name;
    result.title = stage.drive.title;
    result.lamp_set = lamp_set.name;
    result.rate_hz = 1.0 / stage.drive.step_s;
    result.supersample = request.supersample;
    result.displayed = request.displayed;
    result.level_lx = request.level_lx;
    result.pixels_per_degree = 0.5 * result.view.height_px / std::tan(0.5 * result.view.vertical_fov_rad) * std::numbers::pi / 180.0;
    const Interruption listening;
    Progress progress("aliasing of " + stage.drive.name, static_cast<int>(ticks.size() * (configurations.size() + 1)), request.quiet,
                      "pictures");
    Session session{request, stage, device, moments_at(ticks, stage, lamp_set), result, {}, {}, {}, progress};
    for (const Moment& moment : session.moments)
        result.moments.emplace_back(moment.tick, moment.time_s);
    result.shown = session.moments.size() / 2;
    if (session.moments.size() > 1) {
        session.shapes = shapes_of(stage, device, session.moments, result.view);
        session.tracks = tracks_of(session.moments, result.view, session.shapes, result.shown, track_stride_px);
    }
    for (const AliasingConfiguration& configuration : configurations) {
        AliasingRow row;
        row.configuration = configuration;
        if (!measure_row(session, row))
            break;
        result.rows.push_back(std::move(row));
    }
    if (result.rows.size() < configurations.size())
        result.interrupted = Interruption::words();
    request.write(result);
    if (result.interrupted.empty())
        folder.finish();
    return result;
}

} // namespace fernlicht
