#include "scenarios/drives/keys/lamp_mounts.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/read_fields.h"

#include <algorithm>
#include <glm/common.hpp>

namespace fernlicht {
namespace {

Pose in_car(double yaw_rad) { return {{}, axes_from_angles(yaw_rad, 0.0, 0.0)}; }

} // namespace

const Fields<LampMount>& mount_fields() {
    static const Fields<LampMount> fields{
        field("position_m", 1, &LampMount::position_m, range(-100.0, 100.0), "x forward, y left, z up from the road under the rear axle")
            .required(),
        inlined(2, &LampMount::turn, turn_fields()),
    };
    return fields;
}

std::vector<Mount> turned_mounts(const Model& model, double yaw_rad, double scale) {
    std::vector<Mount> mounts = model.mounts;
    if (yaw_rad == 0.0 && scale == 1.0)
        return mounts;
    for (Mount& mount : mounts) {
        mount.pose.position_m *= scale;
        mount.pose = compose(in_car(yaw_rad), mount.pose);
    }
    return mounts;
}

std::vector<LampMount> lamp_mounts(const std::vector<Mount>& mounts) {
    std::vector<LampMount> out;
    for (const Mount& mount : mounts) {
        const std::string_view rest = std::string_view(mount.name).substr(std::string_view("lamp.").size());
        const std::size_t dot = rest.find('.');
        const std::string function(rest.substr(0, dot)), side(dot == std::string_view::npos ? "" : rest.substr(dot + 1));
        const bool low = function == "low" && !side.empty();
        const std::string name = low ? side : side.empty() ? function : function + '-' + side;
        if (std::ranges::none_of(out, [&](const LampMount& known) { return known.name == name; }))
            out.push_back({name, mount.pose.position_m, turn_of(mount.pose.axes), low});
    }
    return out;
}

std::optional<PlacedModel> read_car_model(const YamlMap& keys) {
    const auto file = keys.find("model");
    if (!file) {
        for (const std::string_view key : {"yaw_deg", "yaw_rad", "scale"})
            if (const auto given = keys.find(key))
                given->refuse("a model's turn or size without a model", "model beside it");
        return std::nullopt;
    }
    PlacedModel placed;
    placed.file = file->path();
    check_file(placed.file, *file);
    placed.model = std::make_shared<const Model>(read_model(placed.file));
    read_field(body_fields(), "yaw", keys, &placed);
    read_field(body_fields(), "scale", keys, &placed);
    return placed;
}

std::pair<glm::dvec3, glm::dvec3> turned_box_m(const PlacedModel& placed) {
    const glm::dvec3 ends[2] = {placed.scale * placed.model->low_m, placed.scale * placed.model->high_m};
    const Pose frame = in_car(placed.yaw_rad);
    glm::dvec3 low(to_parent(frame, ends[0])), high(low);
    for (int corner = 1; corner < 8; ++corner) {
        const glm::dvec3 p = to_parent(frame, {ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2].z});
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return {low, high};
}

} // namespace fernlicht
