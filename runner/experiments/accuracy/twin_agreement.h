// How far the GPU's floats lie from the double twin: the reference by the one ray through each pixel's centre, which a rasteriser takes.
#pragma once

#include "runner/experiments/accuracy/picture_errors.h"

namespace fernlicht {

/// Adds a picture. `edges`: the same view by the pixels' areas, whose marks say where shadows and surfaces end. The frame has illuminance,
/// depth and ids. Pixels that several surfaces share, or whose mesh differs, or without light to speak of, are left out and counted.
class TwinAgreementFold {
  public:
    explicit TwinAgreementFold(double least_lx) : least_lx_(least_lx) {}

    void add(const Moment& moment, const View& view, const Frame& frame, const ReferenceImage& twin, const ReferenceImage& edges,
             int picture);
    TwinAgreement finish() const;

  private:
    double least_lx_;
    PixelErrorFold flat_, of_bound_; ///< of_bound_: error over what gradient and angle error allow
    TwinAgreement counts_;
    std::size_t within_ = 0;
};

} // namespace fernlicht
