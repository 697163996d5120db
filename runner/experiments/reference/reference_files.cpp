#include "runner/experiments/reference/reference_result.h"
#include "runner/files/picture_file.h"
#include "runner/findings/context_json.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/photometry.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>

namespace fernlicht {
namespace {

/// The square of a standard error as a float image.
Image<float> variance_of(const Image<float>& standard_error) {
    Image<float> out = standard_error;
    for (float& value : out.pixels())
        value *= value;
    return out;
}

template <class T> Image<float> as_floats(const Image<T>& image) {
    Image<float> out(image.width(), image.height());
    std::ranges::transform(image.pixels(), out.data(), [](T value) { return static_cast<float>(value); });
    return out;
}

std::vector<PictureChannel> channels_of(const ReferenceImage& image) {
    std::vector<PictureChannel> channels;
    const auto add = [&](const Estimate& estimate, const char* mean, const char* variance) {
        if (estimate.mean.empty())
            return;
        channels.push_back({mean, estimate.mean});
        channels.push_back({variance, variance_of(estimate.standard_error)});
    };
    add(image.illuminance_lx, "illuminance.lx", "illuminance.variance_lx2");
    add(image.target_lx, "target.lx", "target.variance_lx2");
    add(image.luminance_cdm2, "luminance.cdm2", "luminance.variance_cd2m4");
    channels.push_back({"ids", as_floats(image.ids)});
    channels.push_back({"samples", as_floats(image.samples)});
    channels.push_back({"mixed", as_floats(image.mixed)});
    return channels;
}

/// Luminance alone, in grey: the reference estimates no colours.
Image<Rgb8> grey_picture(const Image<float>& cdm2, const ToneMapper& mapper) {
    Image<Rgb8> out(cdm2.width(), cdm2.height());
    for (std::size_t i = 0; i < cdm2.size(); ++i) {
        const double shown = photometry::srgb_encoded(toned(mapper, static_cast<double>(cdm2.pixels()[i])));
        const auto level = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shown, 0.0, 1.0)));
        out.pixels()[i] = {level, level, level};
    }
    return out;
}

JsonMembers error_reached_members(ErrorReached& error) {
    return {{"lit_pixels", error.lit_pixels},
            {"median", error.median},
            {"p95", error.p95},
            {"worst", error.worst},
            {"share_reached", error.share_reached}};
}

/// Of solvers that which was used alone has.
JsonMembers reference_settings_members(ReferenceSettings& s) {
    SolverSettings& v = s.solver;
    const bool patches = s.integrator == Integrator::radiosity, photons = s.integrator == Integrator::photon_map;
    return {{"integrator", one_of(s.integrator, names_of<Integrator>(integrator_name, 5))},
            {"target_error", s.target_error},
            {"floor_lx", s.floor_lx},
            {"floor_cdm2", s.floor_cdm2},
            {"min_samples", s.min_samples},
            {"max_samples", s.max_samples},
            {"max_bounces", s.max_bounces},
            {"lamp_radius_m", s.lamp_radius_m},
            {"target_height_m", s.target_height_m},
            {"shadows", s.shadows},
            {"max_smooth", s.max_smooth},
            {"solver",
             null_unless(patches || photons,
                         joined({{"reach_m", v.reach_m}},
                                when(patches, {{"patch_m", v.patch_m}, {"form_factor_rays", v.form_factor_rays}, {"residual", v.residual}}),
                                when(photons, {{"photons", static_cast<std::uint64_t>(v.photons)}, {"radius_m", v.radius_m}}),
                                JsonMembers{{"final_gather", v.final_gather}}))},
            {"seed", s.seed}};
}

JsonPart preparation_part(ReferenceResult& r) {
    Preparation& p = r.image.preparation;
    const bool patches = r.settings.integrator == Integrator::radiosity, photons = r.settings.integrator == Integrator::photon_map;
    return null_unless(patches || photons, joined({{"seconds", p.seconds}, {"rays", p.rays}},
                                                  when(patches, {{"patches", p.patches}, {"sweeps", p.sweeps}, {"residual", p.residual}}),
                                                  when(photons, {{"photons_stored", p.photons_stored}})));
}

/// No seed and no driver: rays need none of them.
JsonMembers ray_context_members(RunContext& context) {
    return {{"command", context.command}, {"started_utc", context.started_utc}, {"cpu", context.cpu},
            {"os", context.os},           {"versions", context.versions},       {"inputs", context.inputs, file_members}};
}

JsonMembers reference_result_members(ReferenceResult& r) {
    const auto& counts = r.image.samples.pixels();
    return {{"schema", json_constant("fernlicht-reference")},
            {"version", json_constant(2)},
            {"drive", r.drive},
            {"title", r.title},
            {"lamp_set", r.lamp_set},
            {"view", r.view.name},
            {"width_px", r.view.width_px},
            {"height_px", r.view.height_px},
            {"tick", r.moment.tick},
            {"time_s", r.moment.time_s},
            {"complete", r.image.complete},
            {"settings", reference_settings_members(r.settings)},
            {"inputs_hash", r.inputs_hash},
            {"relative_standard_error",
             {{"illuminance", r.illuminance(), error_reached_members},
              {"target", r.target(), error_reached_members},
              {"luminance", r.luminance(), error_reached_members}}},
            {"preparation", preparation_part(r)},
            {"triangles", r.triangles},
            {"samples", std::accumulate(counts.begin(), counts.end(), std::uint64_t{0})},
            {"rays", r.image.rays},
            {"seconds", r.image.seconds},
            {"rays_per_second", static_cast<double>(r.image.rays) / std::max(r.image.seconds, 1e-9)},
            {"context", ray_context_members(r.context)}};
}

} // namespace

std::string reference_json_schema() { return json_schema(reference_result_members); }

void write_reference(const ReferenceResult& r, const ToneMapper& tone_mapper, const std::filesystem::path& folder) {
    write_channels(channels_of(r.image), r.moment, r.view,
                   {{"fernlicht:drive", r.drive},
                    {"fernlicht:lamp_set", r.lamp_set},
                    {"fernlicht:integrator", integrator_name(r.settings.integrator)},
                    {"fernlicht:target_error", fmt::format("{}", r.settings.target_error)},
                    {"fernlicht:seed", fmt::format("{}", r.settings.seed)},
                    {"fernlicht:inputs_hash", r.inputs_hash},
                    {"fernlicht:variance", "of the pixel's mean: the square of its standard error"}},
                   folder / "reference.exr");
    if (!r.image.luminance_cdm2.mean.empty())
        write_png(grey_picture(r.image.luminance_cdm2.mean, tone_mapper), folder / "reference.png");
    write_file(folder / "reference.json", json_text(as_json(r, reference_result_members)));
}

} // namespace fernlicht
