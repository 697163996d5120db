// The device has no room for a shadow method's maps: other methods may still be drawn.
#pragma once

#include "scenarios/values/errors.h"

namespace fernlicht {

/// Says what was asked for and which keys of `shadows` make it smaller. The device goes on drawing.
class ShadowMemoryError : public DeviceError {
  public:
    using DeviceError::DeviceError;
};

} // namespace fernlicht
