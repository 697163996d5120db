#include "runner/play/level_fold.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

constexpr double beside_field_deg = 5.0; ///< farther out nobody is followed

/// Of his box, seen from the lamp; nullopt where a part of it lies behind the lamp.
std::optional<std::pair<double, double>> h_of(const RoadUser& user, const Pose& pose, const LitLamp& lamp) {
    std::pair<double, double> edges{180.0, -180.0};
    for (const double x_m : {user.rear_m, user.rear_m + user.size_m.x})
        for (const double left_m : {-0.5 * user.size_m.y, 0.5 * user.size_m.y})
            for (const double up_m : {0.0, user.size_m.z}) {
                const auto angles = angles_from(lamp, to_parent(pose, {x_m, left_m, up_m}));
                if (!angles)
                    return std::nullopt;
                edges = {std::min(edges.first, angles->h_deg), std::max(edges.second, angles->h_deg)};
            }
    return edges;
}

} // namespace

LevelFold::LevelFold(const Drive& drive, const LampSet& lamp_set) : drive_(drive), lamp_set_(lamp_set) {
    const ControlRun* const run = lamp_set.motion && lamp_set.motion->control ? &*lamp_set.motion->control : nullptr;
    for (std::size_t i = 0; i < lamp_set.lamps.size(); ++i) {
        const MountedLamp& lamp = lamp_set.lamps[i];
        const std::size_t controlled = run ? run->lamp(lamp.name) : 0;
        const LevelTrack* const track = lamp.levels                             ? lamp.levels.get()
                                        : run && controlled < run->lamps.size() ? run->runs[controlled].pixels.get()
                                                                                : nullptr;
        if (!track)
            continue;
        const double later_s = lamp.levels ? tick_tolerance * drive.step_s : 0.0; // as lamps_at() has it
        followed_.push_back({i, track, later_s, PixelStates(track->lamp()->pixels)});
        lamps_.push_back({lamp.name, track->lamp()->pixels->count(), followed_.back().states.columns_deg(), {}});
    }
}

void LevelFold::add(const Moment& moment) {
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Followed& followed = followed_[i];
        const LitLamp& shining = moment.lamps[followed.lamp];
        MountedLamp full = lamp_set_.lamps[followed.lamp];
        full.level = 1.0;
        PixelLevels::Row& row = lamps_[i].rows.emplace_back();
        row.time_s = moment.time_s;
        row.level = full.intensity_factor() > 0.0 ? shining.intensity_factor / full.intensity_factor() : 0.0;
        std::vector<float> levels = followed.track->levels(moment.time_s + followed.later_s);
        row.pixels = followed.states.of(levels);
        if (levels.size() <= most_told_levels)
            row.levels = std::move(levels);
        const auto& columns = lamps_[i].columns_deg;
        for (std::size_t user = 0; user < drive_.traffic.size() && user < moment.bodies.size(); ++user) {
            const Body& body = moment.bodies[user];
            const auto edges = body.visible ? h_of(drive_.traffic[user], body.pose, shining) : std::nullopt;
            if (edges && edges->second > columns.front().first - beside_field_deg &&
                edges->first < columns.back().second + beside_field_deg)
                row.others.push_back({body.name, glm::dot(body.pose.forward(), moment.ego.forward()) < 0.0, edges->first, edges->second});
        }
    }
}

} // namespace fernlicht
