#include "runner/play/probe_fold.h"

#include "renderer/camera.h"
#include "scenarios/light/light.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double patch_m = 0.03; // three pixels of a centimetre, the probe in the middle one

} // namespace

View map_around(const glm::dvec3& point_m, const Moment& moment) {
    View view;
    view.name = "probe";
    view.projection = Projection::map;
    view.width_px = view.height_px = 3;
    const Camera axes = camera_of(moment, view);
    const glm::dvec3 p = point_m - moment.ego.position_m;
    const double ahead = glm::dot(p, axes.up), right = glm::dot(p, axes.right);
    view.map_ahead_m = ahead + 0.5 * patch_m;
    view.map_behind_m = 0.5 * patch_m - ahead;
    view.map_right_m = right + 0.5 * patch_m;
    view.map_left_m = 0.5 * patch_m - right;
    return view;
}

void ProbeFold::add(const Moment& moment, const Draw& draw) {
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Probe& probe = drive_.probes[i];
        const Pose surface = route_.pose(moment.distance_m + probe.ahead_m, probe.left_m);
        const glm::dvec3 point = surface.position_m + glm::dvec3(0.0, 0.0, probe.above_m);
        const bool on_surface = probe.above_m == 0.0;
        for (const LitLamp& lamp : moment.lamps)
            found_[i].near_field = found_[i].near_field || glm::length(point - lamp.pose.position_m) < lamp.photometric_distance_m;
        const CrossSection across = route_.cross_section(moment.distance_m + probe.ahead_m);
        found_[i].beside_road =
            found_[i].beside_road || (on_surface && (probe.left_m > across.paved_left_m || probe.left_m < across.paved_right_m));
        found_[i].twin.push_back(on_surface ? surface_illuminance_lx(moment, point, surface.up()) : target_illuminance_lx(moment, point));
        if (!on_surface)
            continue;
        const Frame frame = draw(moment, map_around(surface.position_m, moment), {.illuminance = true})();
        found_[i].not_drawn = frame.illuminance_lx.empty();
        if (!found_[i].not_drawn)
            found_[i].drawn.push_back(static_cast<double>(frame.illuminance_lx.at(1, 1)));
    }
}

Readings ProbeFold::finish() const {
    Readings readings;
    for (std::size_t i = 0; i < found_.size(); ++i) {
        const Probe& probe = drive_.probes[i];
        const std::string where = fmt::format("{} m ahead, {} m left, {} m above the road{}", probe.ahead_m, probe.left_m, probe.above_m,
                                              found_[i].near_field ? ", near-field: nearer than a lamp's photometric distance" : "");
        const auto say = [&](Statistic statistic, Aspect aspect, std::optional<double> value, const std::string& why_not) {
            const ReadingKey key{.quantity = Quantity::probe_illuminance, .subject = probe.name, .aspect = aspect, .statistic = statistic};
            readings.push_back({key, Value::of(value, why_not), where});
        };
        const std::optional<Spread> drawn = spread_of(found_[i].drawn), twin = spread_of(found_[i].twin);
        const std::string unseen = probe.above_m != 0.0  ? "the point is not on a surface that is drawn"
                                   : found_[i].not_drawn ? no_illuminance(drive_.technique)
                                                         : "no moment was played";
        say(Statistic::median, Aspect::value, drawn ? std::optional(drawn->median) : std::nullopt, unseen);
        say(Statistic::minimum, Aspect::value, drawn ? std::optional(drawn->minimum) : std::nullopt, unseen);
        say(Statistic::maximum, Aspect::value, drawn ? std::optional(drawn->maximum) : std::nullopt, unseen);
        const bool known = twin && !found_[i].beside_road;
        say(Statistic::median, Aspect::twin, known ? std::optional(twin->median) : std::nullopt,
            twin ? "the point lies beside the pavement: the twin knows the road's surface, not the verge" : "no moment was played");
    }
    return readings;
}

} // namespace fernlicht
