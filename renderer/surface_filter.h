// How the pictures of surfaces are looked up.
#pragma once

#include "renderer/device.h"

namespace fernlicht {

/// mipmapped: linear within the nearest mipmap level. none: the nearest texel of the finest. trilinear: linear between two levels, too.
enum class SurfaceFilter { mipmapped, none, trilinear };

/// For all renderers that are made on this device from now on. Without it: mipmapped.
void use_surface_filter(Device& device, SurfaceFilter filter);

} // namespace fernlicht
