#include "metrics/road/lane_ahead.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace fernlicht {

LaneAhead::LaneAhead(const Route& route, double from_m, double length_m, double step_m) {
    const double room_m = std::min(length_m, route.length_m() - from_m);
    for (int k = 0; k * step_m <= room_m; ++k)
        surface_.push_back(route.pose(from_m + k * step_m));
}

/// Height over the lane's tangent plane where the line passes the cross-section of a place, and how far along `direction` that is. NaN
/// where it runs along the cross-section.
double LaneAhead::height_m(std::size_t place, const glm::dvec3& from, const glm::dvec3& direction, double& share) const {
    const Pose& pose = surface_[place];
    const double along = glm::dot(direction, pose.forward());
    share = along > 0.0 ? glm::dot(pose.position_m - from, pose.forward()) / along : std::numeric_limits<double>::quiet_NaN();
    return glm::dot(from + share * direction - pose.position_m, pose.up());
}

bool LaneAhead::hides(const glm::dvec3& from, const glm::dvec3& to) const {
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        double share = 0.0;
        const double height = height_m(place, from, to - from, share);
        if (share > 0.0 && share < 1.0 && height < 0.0)
            return true;
        if (share >= 1.0)
            return false; // the next ones are farther still
    }
    return false;
}

std::optional<Pose> LaneAhead::behind(const glm::dvec3& eye, const glm::dvec3& point) const {
    const glm::dvec3 direction = point - eye;
    double before = -1.0, share_before = 0.0;
    for (std::size_t place = 0; place < surface_.size(); ++place) {
        double share = 0.0;
        const double height = height_m(place, eye, direction, share);
        if (!(share > 1.0))
            continue;
        if (height <= 0.0) {
            // The ground between two places is straight: where the line's height over it passes 0.
            const double part = before > 0.0 ? before / (before - height) : 1.0;
            const double met = before > 0.0 ? share_before + part * (share - share_before) : share;
            Pose pose = surface_[place];
            pose.position_m = eye + met * direction;
            return pose;
        }
        before = height;
        share_before = share;
    }
    return std::nullopt;
}

} // namespace fernlicht
