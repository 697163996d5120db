// A town made by others, at night: a car in a model that has no road, lit by two lamps.
#pragma once

#include "runner/findings/report.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/models/model.h"

#include <optional>

namespace fernlicht {

struct TownRequest {
    std::optional<glm::dvec2> at_m;    ///< the rear axle, in the model's frame; nullopt: where the free way is longest
    std::optional<double> heading_rad; ///< left of the model's x; nullopt: as above, or the longest free way there
    double yaw_rad = 0.0, scale = 1.0; ///< of the model
    std::string lamp = "halogen-low";  ///< two_lamps.h
    std::string technique = "photometric", backend = "auto";
    int width_px = 1280, height_px = 720;
};

struct TownFound {
    Pose car; ///< in the model's frame, turned and scaled
    double heading_rad = 0.0, free_way_m = 0.0;
    std::string doubt; ///< a sentence where this looks like no street; else empty
    struct Row {
        double ahead_m;                                 ///< of the lamps
        std::array<std::optional<double>, 3> ground_lx; ///< 3 m to the left, straight ahead, 3 m to the right; nullopt: no ground there
    };
    std::vector<Row> rows; ///< by the twin, in double precision, with shadows
    LuxMap map;            ///< of the ground about the car
    Image<Rgb8> view;      ///< from the driver's eye
};

/// Throws InputError where no car can stand, or none there; DeviceError.
TownFound look_at_town(const Model& model, const TownRequest& request);

} // namespace fernlicht
