#include "metrics/statistics/statistics.h"
#include "runner/experiments/reference/reference_result.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

plots::Axis pixel_axis(const char* label, double from, double to) { return {.label = label, .unit = "px", .from = from, .to = to}; }

/// A picture in false colours with its key.
plots::Figure in_false_colours(const Image<float>& values, const plots::Axis& axis, const std::string& title, const std::string& subtitle) {
    plots::Figure figure;
    figure.title = title;
    figure.subtitle = subtitle;
    const double width = values.width(), height = values.height();
    figure.width_px = 1000.0;
    figure.height_px = std::clamp(140.0 + 800.0 * height / width, 320.0, 1600.0);
    figure.x = pixel_axis("column", 0.0, width);
    figure.y = pixel_axis("row", height, 0.0);
    figure.equal_units = true;
    figure.grid = false;
    figure.rasters = {{plots::heat_map(values, axis), 0.0, width, 0.0, height}};
    figure.colour_bar = plots::ColourBar{axis};
    return figure;
}

Image<float> relative_error_percent(const Estimate& estimate, double floor) {
    Image<float> out = estimate.standard_error;
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] *= 100.0F / std::max(estimate.mean.pixels()[i], static_cast<float>(floor));
    return out;
}

std::string preparation_words(const Preparation& p) {
    if (p.patches > 0)
        return fmt::format("solved before: {} patches in {:.2f} s, {} sweeps, residual {:.1e}", p.patches, p.seconds, p.sweeps, p.residual);
    return fmt::format("solved before: {} photons left on surfaces in {:.2f} s", p.photons_stored, p.seconds);
}

std::string place_of(const ReferenceResult& r) {
    return fmt::format("{}, {}, after {:.3f} s", r.title.empty() ? r.drive : r.title, r.lamp_set, r.moment.time_s);
}

} // namespace

Document document(const ReferenceResult& r) {
    Section section;
    section.blocks.emplace_back(fmt::format("{}, {} {} x {}, {}, standard error wanted {:.3g} %", place_of(r), r.view.name, r.view.width_px,
                                            r.view.height_px, integrator_name(r.settings.integrator), 100.0 * r.settings.target_error));
    const auto tell = [&](const char* name, bool has_output, const std::optional<ErrorReached>& e) {
        if (e)
            section.blocks.emplace_back(fmt::format(
                "{:<12} of the {} lit pixels half have an error of at most {:.3g} %, 95 % of at most {:.3g} %, the worst {:.3g} %; "
                "{:.2f} % of the lit pixels reached it",
                name, e->lit_pixels, 100.0 * e->median, 100.0 * e->p95, 100.0 * e->worst, 100.0 * e->share_reached));
        else if (has_output)
            section.blocks.emplace_back(fmt::format("{:<12} no computed pixel is lit", name));
    };
    tell("illuminance", r.outputs.illuminance, r.illuminance());
    tell("target", r.outputs.target, r.target());
    tell("luminance", r.outputs.luminance, r.luminance());
    if (r.image.preparation.patches > 0 || r.image.preparation.photons_stored > 0)
        section.blocks.emplace_back(preparation_words(r.image.preparation));
    const double samples = spread_of({r.image.samples.pixels().begin(), r.image.samples.pixels().end()}).value_or(Spread{}).mean;
    section.blocks.emplace_back(
        fmt::format("{:.1f} samples a pixel, {:.1f} million rays in {:.2f} s, {:.2f} million rays a second, {} triangles", samples,
                    1e-6 * static_cast<double>(r.image.rays), r.image.seconds,
                    1e-6 * static_cast<double>(r.image.rays) / std::max(r.image.seconds, 1e-9), r.triangles));
    return {"Ray-traced: " + place_of(r), {section}};
}

std::vector<Plot> false_colours(const ReferenceResult& r) {
    const plots::Axis lux{.label = "illuminance", .unit = "lx", .from = 0.1, .to = 100.0, .scale = plots::Scale::logarithmic},
        percent{.label = "standard error", .unit = "%", .from = 0.001, .to = 10.0, .scale = plots::Scale::logarithmic};
    return {{.name = "illuminance",
             .figure = in_false_colours(r.image.illuminance_lx.mean, lux, "Illuminance on the surfaces seen", place_of(r)),
             .png_alone = true},
            {.name = "error",
             .figure = in_false_colours(relative_error_percent(r.image.illuminance_lx, r.settings.floor_lx), percent,
                                        "Standard error of the illuminance",
                                        place_of(r) + fmt::format("; of the mean or of {} lx", r.settings.floor_lx)),
             .png_alone = true}};
}

} // namespace fernlicht
