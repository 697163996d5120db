#include "runner/accuracy/technique_sweep.h"

#include "runner/accuracy/picture_errors.h"
#include "runner/accuracy/simplifications.h"
#include "runner/accuracy/twin_agreement.h"
#include "runner/bench/bench_run.h"
#include "scenarios/drives/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <deque>
#include <fmt/format.h>
#include <map>

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
    extent.limits_lx = {1.0, 5.0};
    measured.extent = extent;
    return measured;
}

struct Contestants {
    std::deque<Renderer> renderers;
    std::deque<View> views;
    std::vector<Contestant> all;
};

/// Of photometric as the drive draws it; nullopt where it took no part.
std::optional<TwinAgreement> twin_agreement(const References& references, const Stage& stage, Device& device,
                                            const std::vector<Moment>& moments, const std::vector<ConfigurationResult>& found) {
    const auto ours = std::ranges::find_if(
        found, [](const ConfigurationResult& r) { return r.configuration.technique == "photometric" && r.configuration.varied.empty(); });
    if (ours == found.end())
        return std::nullopt;
    const View view = resized(view_to_compare(stage.drive), ours->configuration.width_px, ours->configuration.height_px);
    Renderer renderer(device, stage.scene, settings_of(stage.drive, ours->configuration));
    const Reference reference(stage.scene);
    ReferenceSettings settings = references.settings();
    settings.footprint = Footprint::centre;
    TwinAgreementFold fold(settings.floor_lx);
    for (std::size_t m = 0; m < moments.size(); ++m)
        fold.add(moments[m], view, renderer.draw(moments[m], view, {.illuminance = true, .depth = true, .ids = true}),
                 reference.render(moments[m], view, {.illuminance = true}, settings), references.driver(m, view).reference,
                 static_cast<int>(m));
    return fold.finish();
}

void add_contestant(Contestants& contestants, Renderer& renderer, const View& view, const std::vector<Moment>& moments) {
    static constexpr Wanted wanted{.colour = true};
    const View* const kept = &contestants.views.emplace_back(view);
    Renderer* const drawing = &renderer;
    drawing->prepare(moments, *kept, wanted);
    contestants.all.push_back(
        {[=, &moments](std::size_t moment) { drawing->render(moments[moment], *kept, wanted); }, [=] { drawing->finish(); }});
}

} // namespace

std::string beams_text(const std::optional<BeamTexels>& beams) {
    return beams ? fmt::format("{}x{}x{}", beams->width, beams->height, beams->bits) : "float";
}

std::string name_of(const Configuration& c) {
    std::string name = c.technique;
    if (c.varied.find("resolution") != std::string::npos)
        name += fmt::format(", {}x{}", c.width_px, c.height_px);
    if (c.varied.find("shadow maps") != std::string::npos)
        name += fmt::format(", shadow maps {}x{}", c.shadow_width, c.shadow_height);
    if (c.varied.find("beams") != std::string::npos)
        name += ", beams " + beams_text(c.beams);
    return name;
}

RendererSettings settings_of(const Drive& drive, const Configuration& configuration) {
    RendererSettings settings;
    settings.technique = configuration.technique;
    settings.tone_mapper = drive.tone_mapper;
    settings.beams = configuration.beams;
    settings.shadows = drive.shadows;
    settings.shadow_width = configuration.shadow_width;
    settings.shadow_height = configuration.shadow_height;
    if (drive.extent)
        settings.target_height_m = drive.extent->target_height_m;
    return settings;
}

const Variant& variant_of(const Drive& drive, const std::string& name) {
    if (name.empty())
        return drive.variants.front();
    std::vector<std::string> names;
    for (const Variant& variant : drive.variants) {
        if (variant.name == name)
            return variant;
        names.push_back(variant.name);
    }
    throw InputError({drive.file, 0, 0, "--variant"}, "found '" + printable(name) + "'", fmt::format("one of {}", fmt::join(names, ", ")));
}

std::vector<Configuration> configurations_of(const SweepRequest& request, const Drive& drive) {
    const View& driver = view_to_compare(drive);
    const std::vector<Size> resolutions = sizes_of(request.resolutions, {driver.width_px, driver.height_px}, {0.5, 0.25});
    const RendererSettings usual;
    const std::vector<Size> maps = sizes_of(request.shadow_maps, {usual.shadow_width, usual.shadow_height}, {2.0, 0.5, 0.25});
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
        all.push_back(
            {std::string(row.name), resolutions[r].first, resolutions[r].second, maps[m].first, maps[m].second, beams[b], varied});
    };
    for (const Technique& row : rows)
        add(row, 0, 0, 0);
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
    variant_of(stage.drive, request.variant);
    configurations_of(request, stage.drive);
    const int moments = tick_count(stage.drive);
    if (request.moments < 1 || request.moments > moments)
        throw InputError({stage.drive.file, 0, 0, "--moments"}, fmt::format("found {}", request.moments),
                         fmt::format("1 to {}, the drive's moments", moments));
}

DriveAccuracy sweep_techniques(const Stage& stage, Device& device, const SweepRequest& request, const StepsDone& go_on) {
    const Drive drive = measured_drive(stage.drive);
    const Variant& variant = variant_of(stage.drive, request.variant);
    const View& driver = view_to_compare(stage.drive);
    const std::vector<Configuration> configurations = configurations_of(request, stage.drive);
    const std::vector<Moment> moments = moments_at(ticks_over(tick_count(stage.drive), request.moments), stage, variant);
    DriveAccuracy result{stage.drive.name, stage.drive.title, variant.name, {}, {}, {}, {}, {}};
    for (const Moment& moment : moments)
        result.moments.emplace_back(moment.tick, moment.time_s);

    ReferenceSettings wanted;
    wanted.target_error = request.target_error;
    wanted.most_samples = request.most_samples;
    wanted.shadows = drive.shadows;
    wanted.seed = request.seed;
    wanted.target_height_m = drive.extent->target_height_m;
    References references(stage, drive, device, moments, wanted);
    const int finest_px = std::ranges::max(configurations, {}, &Configuration::width_px).width_px;
    std::set<Size> sizes;
    for (const Configuration& c : configurations)
        sizes.emplace(c.width_px, c.height_px);
    const std::size_t steps = moments.size() * (sizes.size() + 1) + configurations.size() + static_cast<std::size_t>(request.rounds);
    std::size_t done = 0;
    const auto step = [&](const std::string& at) { return go_on(done++, steps, at); };
    for (std::size_t m = 0; m < moments.size(); ++m) {
        if (!step("reference from above"))
            return result;
        references.add_map(m);
        for (const Size& size : sizes) {
            if (!step(fmt::format("reference {}x{}", size.first, size.second)))
                return result;
            references.add_driver(m, resized(driver, size.first, size.second));
        }
    }
    result.reference = references.cost();

    Contestants contestants;
    for (const Configuration& configuration : configurations) {
        if (!step(name_of(configuration)))
            break;
        Renderer& renderer = contestants.renderers.emplace_back(device, stage.scene, settings_of(drive, configuration));
        const View view = resized(driver, configuration.width_px, configuration.height_px);
        const Draw draw = [&](const Moment& moment, const View& at, const Wanted& pictures) {
            return renderer.submit(moment, at, pictures);
        };
        result.configurations.push_back(errors_of(references, draw, renderer.technique(), configuration, view,
                                                  static_cast<double>(configuration.width_px) / finest_px));
        add_contestant(contestants, renderer, view, moments);
        for (const Moment& moment : moments)
            result.configurations.back().work.push_back(renderer.count(moment, view, {.colour = true}));
    }
    result.simplifications = price_simplifications(stage, moments);
    result.twin = twin_agreement(references, stage, device, moments, result.configurations);
    ContestOptions options;
    options.moments = moments.size();
    options.rounds = static_cast<std::size_t>(request.rounds);
    options.frame_by_frame = false;
    options.seed = request.seed;
    options.go_on = [&](std::size_t) { return step("times"); };
    Contest contest = hold_contest(contestants.all, options, real_clocks());
    for (std::size_t i = 0; i < result.configurations.size(); ++i)
        result.configurations[i].samples = std::move(contest.samples[i]);
    return result;
}

} // namespace fernlicht
