#include "runner/experiments/accuracy/technique_sweep.h"

#include "runner/experiments/accuracy/picture_errors.h"
#include "runner/experiments/bench/bench_run.h"
#include "runner/play/preparation.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>
#include <tuple>

namespace fernlicht {
namespace {

using Size = std::pair<int, int>;

/// Those asked for, the first of them for everything; else the usual one and parts or multiples of it.
std::vector<Size> sizes_of(const std::vector<Size>& asked, Size usual, std::initializer_list<double> factors) {
    std::vector<Size> sizes;
    const auto add = [&](Size size) {
        if (std::ranges::find(sizes, size) == sizes.end())
            sizes.push_back(size);
    };
    for (const Size& size : asked)
        add(size);
    if (asked.empty()) {
        add(usual);
        for (const double factor : factors)
            add({std::max(1, static_cast<int>(usual.first * factor)), std::max(1, static_cast<int>(usual.second * factor))});
    }
    return sizes;
}

const View& view_to_compare(const Drive& drive) {
    if (const View* const view = driver_view(drive))
        return *view;
    throw InputError({drive.file, 0, 0, "views"}, "found only maps", "a perspective view whose pictures are compared");
}

std::vector<std::optional<BeamTexels>> beams_of(const SweepRequest& request, const Drive& drive) {
    std::vector<std::optional<BeamTexels>> beams = request.beams;
    if (beams.empty())
        beams = {drive.beams, eight_bit_texels, BeamTexels{512, 128, 32}, BeamTexels{1024, 512, 8}, BeamTexels{2048, 1024, 16}};
    std::vector<std::optional<BeamTexels>> distinct;
    for (const auto& texels : beams)
        if (std::ranges::find(distinct, texels) == distinct.end())
            distinct.push_back(texels);
    return distinct;
}

/// The drive with the reaches that are compared: at 1 and 5 lx.
Drive measured_drive(const Drive& drive) {
    Drive measured = drive;
    ExtentParameters extent = drive.extent.value_or(ExtentParameters{});
    extent.thresholds_lx = measured_thresholds_lx;
    measured.extent = extent;
    return measured;
}

struct TimedTechniques {
    std::deque<Renderer> renderers;
    std::deque<View> views;
    std::vector<std::string> names;
    std::set<Size> sizes; ///< of the views
};

ReferenceSettings reference_settings(const Drive& drive, const SweepRequest& request) {
    ReferenceSettings settings;
    settings.target_error = request.target_error;
    settings.max_samples = request.max_samples;
    settings.shadows = drive.shadows.objects_cast || request.shadow_methods;
    settings.seed = request.seed;
    settings.target_height_m = drive.extent->target_height_m;
    return settings;
}

Draw drawn_by(Renderer& renderer) {
    return
        [&renderer](const Moment& moment, const View& at, const FrameOutputs& pictures) { return renderer.submit(moment, at, pictures); };
}

/// Without those whose shadow method refuses the scene, which the result names.
std::vector<Configuration> drawable(std::vector<Configuration> configurations, const Stage& stage, const Drive& drive, Device& device,
                                    const std::vector<Moment>& moments, DriveAccuracy& result) {
    std::erase_if(configurations, [&](const Configuration& c) {
        if (c.varied != "shadow method")
            return false;
        try {
            Renderer renderer(device, stage.scene, settings_of(drive, c));
            for (const Moment& moment : moments)
                renderer.draw(moment, at_size(view_to_compare(drive), 64, 48), {.illuminance = true});
            return false;
        } catch (const InputError& why) {
            result.refused.emplace_back(c, why.what());
            return true;
        }
    });
    return configurations;
}

void add_timed_techniques(TimedTechniques& timed_techniques, std::vector<ConfigurationErrors>& errors, const ReferencePictures& references,
                          const Stage& stage, const Drive& drive, Device& device, const std::vector<Configuration>& configurations) {
    const int finest_px = std::ranges::max(configurations, {}, &Configuration::width_px).width_px;
    for (const Configuration& c : configurations) {
        Renderer& renderer = timed_techniques.renderers.emplace_back(device, stage.scene, settings_of(drive, c));
        timed_techniques.views.push_back(at_size(view_to_compare(drive), c.width_px, c.height_px));
        timed_techniques.names.push_back(name_of(c));
        timed_techniques.sizes.emplace(c.width_px, c.height_px);
        errors.emplace_back(references, renderer.technique(), c, timed_techniques.views.back(),
                            static_cast<double>(c.width_px) / finest_px);
    }
}

/// After `compared` comparisons, all of a moment's before the next one's.
std::vector<std::string> missing_errors(std::size_t compared, std::size_t ways, std::size_t moments) {
    const std::size_t whole = compared / ways, rest = compared % ways;
    if (whole == moments)
        return {};
    std::string text = fmt::format("errors: {} of {} moments were compared", whole, moments);
    if (rest > 0)
        text += fmt::format(", and {} of {} ways in the next", rest, ways);
    return {text};
}

/// Of photometric as the drive draws it, and at edges by each of its ways at that size; nothing where it took no part, and where it was
/// stopped.
void add_agreement(const ReferencePictures& references, const Stage& stage, const std::vector<Moment>& moments,
                   TimedTechniques& timed_techniques, const StopAsked& stop, DriveAccuracy& result) {
    const auto by_photometric = [](const ConfigurationResult& r) { return r.configuration.technique == "photometric"; };
    const auto ours = std::ranges::find_if(
        result.configurations, [&](const ConfigurationResult& r) { return by_photometric(r) && r.configuration.varied.empty(); });
    if (ours == result.configurations.end())
        return;
    const std::size_t own = static_cast<std::size_t>(ours - result.configurations.begin());
    const View& view = timed_techniques.views[own];
    const Reference reference(stage.scene);
    ReferenceSettings settings = references.settings();
    TwinAgreementFold fold(settings.floor_lx);
    std::vector<EdgeErrorFold> edges{{"the one exact ray", settings.floor_lx}};
    std::vector<std::size_t> ways;
    for (std::size_t i = 0; i < result.configurations.size(); ++i)
        if (by_photometric(result.configurations[i]) && timed_techniques.views[i].width_px == view.width_px &&
            timed_techniques.views[i].height_px == view.height_px) {
            ways.push_back(i);
            edges.emplace_back(timed_techniques.names[i], settings.floor_lx);
        }
    for (std::size_t m = 0; m < moments.size(); ++m) {
        settings.footprint = Footprint::centre;
        const ReferenceImage ray = reference.render(moments[m], view, {.illuminance = true}, settings);
        settings.footprint =
            Footprint::pixel; // of illuminance alone: shadows on targets above the surface are marked, too, where these are wanted
        const ReferenceImage areas = reference.render(moments[m], view, {.illuminance = true}, settings, {}, {}, stop);
        if (!areas.complete) {
            result.missing.emplace_back("agreement with the double twin, and errors at edges");
            return;
        }
        edges[0].add(ray.illuminance_lx.mean, ray.illuminance_lx.mean, areas);
        for (std::size_t k = 0; k < ways.size(); ++k) {
            const Frame frame =
                timed_techniques.renderers[ways[k]].draw(moments[m], view, {.illuminance = true, .depth = true, .ids = true});
            edges[k + 1].add(frame.illuminance_lx, ray.illuminance_lx.mean, areas);
            if (ways[k] == own)
                fold.add(moments[m], view, frame, ray, references.driver(m, view).reference, static_cast<int>(m));
        }
    }
    result.twin = fold.finish();
    for (const EdgeErrorFold& way : edges)
        result.edges.push_back(way.finish());
}

/// Renderers with a place in the result only: all of them here, since the errors are whole.
void take_times(TimedTechniques& timed_techniques, const std::vector<Moment>& moments, const SweepRequest& request,
                const std::function<bool(const std::string&)>& step, const StopAsked& stop, DriveAccuracy& result) {
    std::vector<TimedTechnique> all;
    for (std::size_t i = 0; i < timed_techniques.renderers.size(); ++i)
        all.push_back(timed_frames(timed_techniques.renderers[i], moments, timed_techniques.views[i], result.configurations[i].work));
    TimingOptions options;
    options.moments = moments.size();
    options.rounds = static_cast<std::size_t>(request.rounds);
    options.frame_by_frame = false;
    options.seed = request.seed;
    options.go_on = [&](std::size_t) { return step("times"); };
    options.stop = [&] { return stop && stop(); };
    InterleavedTimes timing = time_interleaved(all, options, real_clocks());
    const std::size_t rounds = timing.orders.size();
    if (rounds < options.rounds)
        result.missing.push_back(fmt::format("times: {} of {} rounds were taken", rounds, options.rounds));
    for (std::size_t i = 0; i < result.configurations.size(); ++i)
        result.configurations[i].samples = std::move(timing.samples[i]);
}

} // namespace

std::string name_of(const Configuration& c) {
    std::string name = c.technique;
    if (c.varied.find("resolution") != std::string::npos)
        name += fmt::format(", {}x{}", c.width_px, c.height_px);
    if (c.varied.find("shadow maps") != std::string::npos)
        name += fmt::format(", shadow maps {}x{}", c.shadows.width, c.shadows.height);
    if (c.varied == "shadow method")
        name += fmt::format(", shadows {}", fernlicht::name(c.shadows.method));
    if (c.varied.find("beams") != std::string::npos)
        name += ", beams " + beams_text(c.beams);
    return name;
}

RendererSettings settings_of(const Drive& drive, const Configuration& configuration) {
    RendererSettings settings = settings_for(drive, {});
    settings.technique = configuration.technique;
    settings.beams = configuration.beams;
    settings.shadows = configuration.shadows;
    return settings;
}

std::vector<Configuration> configurations_of(const SweepRequest& request, const Drive& drive) {
    const View& driver = view_to_compare(drive);
    const std::vector<Size> resolutions = sizes_of(request.resolutions, {driver.width_px, driver.height_px}, {0.5, 0.25});
    const std::vector<Size> maps = sizes_of(request.shadow_maps, {drive.shadows.width, drive.shadows.height}, {2.0, 0.5, 0.25});
    const std::vector<std::optional<BeamTexels>> beams = beams_of(request, drive);
    std::vector<Technique> rows;
    for (const Technique& row : chosen_techniques(request.techniques))
        if (request.techniques.empty() || std::ranges::find(request.techniques, row.name) != request.techniques.end())
            rows.push_back(row);
    std::vector<Configuration> all;
    const auto add = [&](const Technique& row, std::size_t r, std::size_t m, std::size_t b) {
        std::string varied;
        for (const auto& [index, name] : {std::pair(r, "resolution"), std::pair(m, "shadow maps"), std::pair(b, "beams")})
            if (index > 0)
                varied += (varied.empty() ? "" : ", ") + std::string(name);
        ShadowSettings shadows = drive.shadows;
        std::tie(shadows.width, shadows.height) = maps[m];
        all.push_back({std::string(row.name), resolutions[r].first, resolutions[r].second, shadows, beams[b], varied});
    };
    for (const Technique& row : rows)
        add(row, 0, 0, 0);
    for (const Technique& row : rows)
        if (request.shadow_methods && row.name == "photometric")
            for (const ShadowMethodName& other : shadow_method_names())
                if (other.method != drive.shadows.method) {
                    add(row, 0, 0, 0);
                    all.back().shadows.method = other.method;
                    all.back().varied = "shadow method";
                }
    for (const Technique& row : rows) {
        const bool ours = row.kind == TechniqueKind::ours, textures = ours || row.features.find("PROJECTED") != std::string_view::npos,
                   varied = row.name == "photometric" || row.name == "full";
        for (std::size_t r = 0; r < resolutions.size(); ++r)
            for (std::size_t m = 0; m < maps.size(); ++m)
                for (std::size_t b = 0; b < beams.size(); ++b) {
                    const int differences = (r > 0 ? 1 : 0) + (m > 0 ? 1 : 0) + (b > 0 ? 1 : 0);
                    if (differences > 0 && (ours || m == 0) && (textures || b == 0) && (request.full || (differences == 1 && varied)))
                        add(row, r, m, b);
                }
    }
    return all;
}

void check_sweep(const SweepRequest& request, const Stage& stage) {
    lamp_set_of(stage.drive, request.lamp_set);
    configurations_of(request, stage.drive);
    const int moments = tick_count(stage.drive);
    if (request.moments < 1 || request.moments > moments)
        throw InputError({stage.drive.file, 0, 0, "--count"}, fmt::format("found {}", request.moments),
                         fmt::format("1 to {}, the drive's moments", moments));
}

DriveAccuracy sweep_techniques(const Stage& stage, Device& device, const SweepRequest& request, const StepsDone& go_on,
                               const StopAsked& stop) {
    const Drive drive = measured_drive(stage.drive);
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set);
    const std::vector<Moment> moments = without_faces(moments_at(ticks_over(tick_count(stage.drive), request.moments), stage, lamp_set));
    DriveAccuracy result{stage.drive.name, stage.drive.title, lamp_set.name, {}, {}, {}, {}, {}, {}};
    result.others_shine = !stage.drive.street_lamps.empty() ||
                          std::ranges::any_of(stage.drive.traffic, [](const RoadUser& user) { return !user.lamps.empty(); });
    for (const Moment& moment : moments)
        result.moments.emplace_back(moment.tick, moment.time_s);
    ReferencePictures references(stage, drive, device, moments, reference_settings(drive, request));
    TimedTechniques timed_techniques;
    std::vector<ConfigurationErrors> errors;
    add_timed_techniques(timed_techniques, errors, references, stage, drive, device,
                         drawable(configurations_of(request, stage.drive), stage, drive, device, moments, result));

    const std::size_t pictures = timed_techniques.sizes.size() + 1;
    const std::size_t steps = moments.size() * (pictures + errors.size()) + static_cast<std::size_t>(request.rounds);
    std::size_t done = 0, compared = 0;
    bool going_on = true;
    const auto step = [&](const std::string& at) { return going_on = going_on && go_on(done++, steps, at); };
    for (std::size_t m = 0; m < moments.size() && going_on; ++m) {
        going_on = step("reference from above") && references.add_map(m, stop);
        for (const Size& size : timed_techniques.sizes)
            going_on = step(fmt::format("reference {}x{}", size.first, size.second)) &&
                       references.add_driver(m, at_size(view_to_compare(drive), size.first, size.second), stop);
        for (std::size_t i = 0; i < errors.size() && step(timed_techniques.names[i]); ++i, ++compared)
            errors[i].add(m, drawn_by(timed_techniques.renderers[i]));
    }
    result.reference = references.cost();
    for (const ConfigurationErrors& found : errors)
        if (ConfigurationResult finished = found.finish(); finished.moments > 0)
            result.configurations.push_back(std::move(finished));
    if (!going_on) {
        result.missing = missing_errors(compared, errors.size(), moments.size());
        result.missing.emplace_back("all times, the price of each simplification, and the agreement with the double twin");
        return result;
    }
    result.simplifications = price_simplifications(stage, moments);
    add_agreement(references, stage, moments, timed_techniques, stop, result);
    take_times(timed_techniques, moments, request, step, stop, result);
    return result;
}

} // namespace fernlicht
