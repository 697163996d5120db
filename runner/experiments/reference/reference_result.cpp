#include "runner/experiments/reference/reference_result.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <iterator>

namespace fernlicht {

static constexpr const char* integrators[]{"direct", "path", "whitted", "radiosity", "photon-map"};

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

std::string integrator_name(Integrator integrator) { return integrators[static_cast<std::size_t>(integrator)]; }

std::optional<Integrator> integrator_of(const std::string& name) {
    const auto found = std::ranges::find(integrators, name);
    return found == std::end(integrators) ? std::nullopt : std::optional(static_cast<Integrator>(found - integrators));
}

} // namespace fernlicht
