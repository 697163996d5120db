// One scene in all shadow methods: errors against rays, then times in turns.
#pragma once

#include "runner/experiments/shadows/shadow_result.h"
#include "runner/experiments/shadows/stress_scenes.h"

#include <functional>

namespace fernlicht {

struct SceneStudyOptions {
    std::vector<ShadowMethod> methods;
    int width = 1024, height = 512;                        ///< texels
    double lamp_radius_m = ShadowSettings{}.lamp_radius_m; ///< of discs, of soft methods and of the truth; 0: the truth is not measured
    double floor_lx = shadow_floor_lx;                     ///< below this without shadows nothing counts
    int rounds = 7;
    std::pair<int, int> timed_px{512, 384};
    std::uint64_t seed = 1;
};

/// Steps that study_scene() tells of.
inline std::size_t steps_of(const SceneStudyOptions& options) { return options.methods.size() + 2; }

/// `step` is called after each step. When `stop` says so the study ends: methods that were not reached are missing, times of all are. A
/// method that refuses the scene gets a row that says why. Throws DeviceError.
ShadowSceneResult study_scene(const ShadowScene& scene, Device& device, const SceneStudyOptions& options, const std::function<void()>& step,
                              const std::function<bool()>& stop);

/// Filled by `measure`; where the method refuses the scene, or its maps find no room, a row that says why.
ShadowRow row_of_method(ShadowMethod method, const std::function<void(ShadowRow&)>& measure);

} // namespace fernlicht
