// Places for lamps on a car: by name in the drive file, or those of a model.
#pragma once

#include "scenarios/lamps/mounted_lamp.h"
#include "scenarios/models/model.h"
#include "scenarios/yaml/yaml_entry.h"

#include <vector>

namespace fernlicht {

struct LampMount {
    std::string name;
    glm::dvec3 position_m{0.0}; ///< in the car's frame: x forward, y left, z up
    Turn turn;                  ///< of the beam's axis at aim 0
    bool usual = true;          ///< gets a lamp where the drive names none
};

template <class Struct> struct Fields;
const Fields<LampMount>& mount_fields();

/// The mounts of a model in the frame that it is turned (yaw) and scaled in.
std::vector<Mount> turned_mounts(const Model& model, double yaw_rad, double scale);
/// Places by the names lamps have in a drive: "lamp.low.left" is left, "lamp.high.left" is high-left. Low beams are usual.
std::vector<LampMount> lamp_mounts(const std::vector<Mount>& mounts);

/// `model`, `yaw_deg` or `yaw_rad`, and `scale` of a map, the model read: nullopt without `model`. Refuses yaw and scale without it.
std::optional<PlacedModel> read_car_model(const YamlMap& keys);
/// The box round the model in its turned and scaled frame.
std::pair<glm::dvec3, glm::dvec3> turned_box_m(const PlacedModel& placed);

} // namespace fernlicht
