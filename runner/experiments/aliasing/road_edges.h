// Which pixels of a view show road and which its marks, drawn without any light.
#pragma once

#include "metrics/aliasing/jaggedness.h"
#include "renderer/renderer.h"

namespace fernlicht {

/// Throws DeviceError.
Image<Ground> ground_of(Device& device, const Scene& scene, const Moment& moment, const View& view);

} // namespace fernlicht
