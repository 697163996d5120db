// One moment of a drive in every shadow method beside the picture by rays: the shadow part of its contact sheets.
#pragma once

#include "runner/experiments/shadows/shadow_result.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// The driver's view, drawn small; errors in the view, no times. A method that refuses the scene has a row that says why. Throws
/// DeviceError. The drive has a perspective view.
ShadowSceneResult shadow_moment(const Stage& stage, const LampSet& lamp_set, const Moment& moment, Device& device,
                                const RendererSettings& settings);

} // namespace fernlicht
