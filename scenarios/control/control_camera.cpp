#include "scenarios/control/control_camera.h"

#include <cmath>
#include <random>

namespace fernlicht {
namespace {

constexpr double camera_rounding_s = 1.0e-9; ///< of ticks added up

/// FNV-1a.
std::uint64_t hash_of(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return hash;
}

} // namespace

double camera_reach_m(const ControlCameraParameters& camera, const OtherUser& other) {
    const bool good = camera.grade == CameraGrade::good;
    if (other.bicycle)
        return camera.bicycle_m.value_or(good ? 150.0 : 75.0);
    return other.oncoming() ? camera.oncoming_m.value_or(good ? 800.0 : 400.0) : camera.preceding_m.value_or(good ? 400.0 : 100.0);
}

const std::vector<OtherUser>& ControlCamera::step(double time_s, const std::vector<OtherUser>& there) {
    if (time_s >= static_cast<double>(frames_) / parameters_.rate_hz - camera_rounding_s) {
        on_their_way_.push_back({time_s + parameters_.latency_s, seen(there)});
        frames_ = static_cast<std::uint64_t>(std::floor(time_s * parameters_.rate_hz + 1.0e-6)) + 1;
    }
    for (; !on_their_way_.empty() && on_their_way_.front().arrives_s <= time_s + camera_rounding_s; on_their_way_.pop_front())
        told_ = std::move(on_their_way_.front().seen);
    return told_;
}

std::vector<OtherUser> ControlCamera::seen(const std::vector<OtherUser>& there) const {
    std::vector<OtherUser> found;
    for (OtherUser other : there) {
        const double distance_m = std::hypot(other.ahead_m, other.left_m), bearing_rad = std::atan2(other.left_m, other.ahead_m);
        if (!other.lamps_on || (other.hidden && parameters_.hides) || distance_m > camera_reach_m(parameters_, other) ||
            std::abs(bearing_rad) > 0.5 * parameters_.field_rad)
            continue;
        std::seed_seq seeds{static_cast<std::uint64_t>(parameters_.seed), frames_, hash_of(other.name) & 0xffffffffU,
                            hash_of(other.name) >> 32U};
        std::mt19937_64 random(seeds);
        if (std::uniform_real_distribution<double>(0.0, 1.0)(random) < parameters_.missed)
            continue;
        if (parameters_.noise_rad > 0.0) {
            const double off_rad = std::normal_distribution<double>(0.0, parameters_.noise_rad)(random);
            other.ahead_m = distance_m * std::cos(bearing_rad + off_rad);
            other.left_m = distance_m * std::sin(bearing_rad + off_rad);
        }
        found.push_back(std::move(other));
    }
    return found;
}

} // namespace fernlicht
