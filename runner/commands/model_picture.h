// A model on a level road at night, before a car of ours.
#pragma once

#include "runner/commands/model_command.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// Asphalt (albedo 0.07) and the model on it, turned and as far ahead as the request says; the frame is that of the car with the lamps,
/// which stand at x = 3.6 m.
Scene model_scene(const Model& model, const ModelRequest& request);

/// Two lamps of the request, 1.2 m apart and 0.65 m above the road; no sky.
Moment lit_moment(const ModelRequest& request);

/// From the driver's eye, as wide as the model and its surroundings need.
View towards(const Model& model, const ModelRequest& request);

} // namespace fernlicht
