#include "runner/findings/gazes.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {

void add_gaze(Gazes& gazes, const std::string& drive, const SeeingSeries& eye, const std::vector<double>& at_m,
              const std::vector<double>& theta_deg) {
    constexpr double within_m = 120.0, beside_m = 1.2;
    if (!eye.over.ends_with("to the observer"))
        return;
    for (std::size_t i = 0; i < theta_deg.size(); ++i)
        if (at_m[i] <= within_m && at_m[i] * std::sin(radians(theta_deg[i])) < beside_m) {
            double& nearest = gazes.try_emplace({drive, eye.title}, theta_deg[i]).first->second;
            nearest = std::min(nearest, theta_deg[i]);
        }
}

std::vector<std::string> gaze_warnings(const Gazes& gazes) {
    std::vector<std::string> warnings;
    for (const auto& [eye, theta_deg] : gazes)
        warnings.push_back(fmt::format("{}: {}: the line of sight passes the lamps at {:.2f}°: veil, threshold increment and de Boer's "
                                       "rating are of one who looks into them",
                                       eye.first, eye.second, theta_deg));
    return warnings;
}

} // namespace fernlicht
