#include "runner/experiments/reference/reference_result.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {

std::optional<ErrorReached> error_reached(const Estimate& estimate, const Image<std::uint32_t>& samples, double target_error,
                                          double floor) {
    if (estimate.mean.empty())
        return std::nullopt;
    std::vector<double> relative;
    std::size_t reached = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples.pixels()[i] == 0 || !(estimate.mean.pixels()[i] > 0.0F))
            continue;
        const double error =
            static_cast<double>(estimate.standard_error.pixels()[i]) / std::max(static_cast<double>(estimate.mean.pixels()[i]), floor);
        relative.push_back(error);
        reached += error <= target_error ? 1 : 0;
    }
    const std::size_t lit = relative.size();
    const std::optional<Spread> spread = spread_of(std::move(relative));
    if (!spread)
        return std::nullopt;
    return ErrorReached{lit, spread->median, spread->p95, spread->maximum, static_cast<double>(reached) / static_cast<double>(lit)};
}

std::optional<ErrorReached> ReferenceResult::illuminance() const {
    return error_reached(image.illuminance_lx, image.samples, settings.target_error, settings.floor_lx);
}
std::optional<ErrorReached> ReferenceResult::target() const {
    return error_reached(image.target_lx, image.samples, settings.target_error, settings.floor_lx);
}
std::optional<ErrorReached> ReferenceResult::luminance() const {
    return error_reached(image.luminance_cdm2, image.samples, settings.target_error, settings.floor_cdm2);
}

std::string integrator_name(Integrator integrator) {
    switch (integrator) {
    case Integrator::direct:
        return "direct";
    case Integrator::path:
        return "path";
    case Integrator::whitted:
        return "whitted";
    case Integrator::radiosity:
        return "radiosity";
    case Integrator::photon_map:
        return "photon-map";
    }
    return "unknown";
}

std::optional<Integrator> integrator_of(const std::string& name) {
    for (const Integrator integrator :
         {Integrator::direct, Integrator::path, Integrator::whitted, Integrator::radiosity, Integrator::photon_map})
        if (integrator_name(integrator) == name)
            return integrator;
    return std::nullopt;
}

namespace {

std::string preparation_text(const Preparation& p) {
    if (p.patches > 0)
        return fmt::format("solved before: {} patches in {:.2f} s, {} sweeps, residual {:.1e}\n", p.patches, p.seconds, p.sweeps,
                           p.residual);
    if (p.photons_stored > 0)
        return fmt::format("solved before: {} photons left on surfaces in {:.2f} s\n", p.photons_stored, p.seconds);
    return {};
}

} // namespace

std::string reference_text(const ReferenceResult& r) {
    std::string text = fmt::format("{}, {}, after {:.3f} s, {} {} x {}, {}, standard error wanted {:.3g} %\n",
                                   r.title.empty() ? r.drive : r.title, r.variant, r.moment.time_s, r.view.name, r.view.width_px,
                                   r.view.height_px, integrator_name(r.settings.integrator), 100.0 * r.settings.target_error);
    const auto line = [&](const char* name, bool is_wanted, const std::optional<ErrorReached>& e) {
        if (e)
            text += fmt::format(
                "{:<12} of the {} lit pixels half have an error of at most {:.3g} %, 95 % of at most {:.3g} %, the worst {:.3g} %; "
                "{:.2f} % of the lit pixels reached it\n",
                name, e->lit_pixels, 100.0 * e->median, 100.0 * e->p95, 100.0 * e->worst, 100.0 * e->share_reached);
        else if (is_wanted)
            text += fmt::format("{:<12} no pixel that is drawn is lit\n", name);
    };
    line("illuminance", r.wanted.illuminance, r.illuminance());
    line("target", r.wanted.target, r.target());
    line("luminance", r.wanted.luminance, r.luminance());
    text += preparation_text(r.image.preparation);
    const double samples = spread_of({r.image.samples.pixels().begin(), r.image.samples.pixels().end()}).value_or(Spread{}).mean;
    text += fmt::format("{:.1f} samples a pixel, {:.1f} million rays in {:.2f} s, {:.2f} million rays a second, {} triangles\n", samples,
                        1e-6 * static_cast<double>(r.image.rays), r.image.seconds,
                        1e-6 * static_cast<double>(r.image.rays) / std::max(r.image.seconds, 1e-9), r.triangles);
    return text;
}

} // namespace fernlicht
