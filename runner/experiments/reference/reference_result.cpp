#include "runner/experiments/reference/reference_result.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace fernlicht {

static constexpr std::pair<Integrator, std::string_view> integrators[]{{Integrator::direct, "direct"},
                                                                       {Integrator::path, "path"},
                                                                       {Integrator::whitted, "whitted"},
                                                                       {Integrator::radiosity, "radiosity"},
                                                                       {Integrator::photon_map, "photon-map"}};

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
    return std::string(std::ranges::find(integrators, integrator, [](const auto& one) { return one.first; })->second);
}

std::optional<Integrator> integrator_of(const std::string& name) {
    const auto found = std::ranges::find(integrators, name, [](const auto& one) { return one.second; });
    return found == std::end(integrators) ? std::nullopt : std::optional(found->first);
}

} // namespace fernlicht
