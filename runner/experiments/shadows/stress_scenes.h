// Scenes that are hard for shadow methods, made in code and drawn in the same way as drives.
#pragma once

#include "renderer/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace fernlicht {

/// What shadows are drawn of.
struct ShadowScene {
    std::string name, title;
    bool of_drive = false;
    std::shared_ptr<const Scene> scene;
    std::vector<Moment> moments;
    View view;              ///< the driver's, or whoever sees it
    RendererSettings light; ///< how it is drawn; the method differs
};

/// The lamps stand 3.4 m before the car's origin, 0.65 m high and 1.2 m apart, both with this beam, unturned. A road that is a plane, but
/// for the crest; things stand so far from the lamps as the name says.
/// Views are 4:3; 0 < fov < pi.
std::vector<ShadowScene> stress_scenes(const std::shared_ptr<const LampFile>& beam, double vertical_fov_rad = View{}.vertical_fov_rad);

/// The same car `ahead_m` farther along its heading: lamps, body and all that is its own.
Moment moved_ahead(Moment moment, double ahead_m);
/// The light of the first lamp that shines alone: no lamps of others, no sky, the car's other lamps dimmed to a millionth. They still
/// shine: one map for all stands where it stands with them.
Moment first_lamp_alone(Moment moment);

} // namespace fernlicht
