// Shadow methods by scenes on a real device, and the result written.
#pragma once

#include "runner/experiments/shadows/scene_study.h"

namespace fernlicht {

struct ShadowRequest : ExperimentRequest<ShadowResult> {
    std::vector<Drive> drives;
    std::string lamp_set;                              ///< "": each drive's first
    std::vector<std::string> scenes;                   ///< patterns of stress scenes' names; "none" for none of them
    std::filesystem::path lamp;                        ///< the stress scenes' beam; read where there are any
    std::filesystem::path recipe;                      ///< of that lamp where it is a text grid; "" for none
    double vertical_fov_rad = View{}.vertical_fov_rad; ///< of the stress scenes' views; 0 < fov < pi
    int moments = 3;                                   ///< of each drive
    SceneStudyOptions options;
};

/// Ends after the step at hand when interrupted, and writes what there is. Throws InputError and DeviceError.
ShadowResult run_shadow_study(const ShadowRequest& request);

} // namespace fernlicht
