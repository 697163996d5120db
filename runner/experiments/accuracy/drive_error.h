// The line of error against run time in every report: a few moments of what was played, compared with the reference.
#pragma once

#include "renderer/renderer.h"
#include "runner/findings/report.h"
#include "runner/play/stage.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Why the error is not measured for what was played; "" where it can be: by a technique that believes in an illuminance, from a
/// perspective view.
std::string no_drive_error(const Drive& drive, const PlayedCell& played);

/// How well the errors that 95 % of the pixels do not exceed are known at least, as a share of them, with 95 % confidence.
inline constexpr double error_precision = 0.25;

/// The middles of at most three equal parts of the ticks played, from `first_tick` on, from the driver's seat with at most 192 x 144
/// pixels, held against 16 to 64 samples a pixel of the reference: tiles at random, until the errors of illuminance on the road and of
/// targets, and of luminance, are known to `error_precision` or to the reference's noise, at most a third of all. Reach as the run measured
/// it in these moments, against maps of the reference's. The renderer is of the stage's scene. The same errors each time, by the drive's
/// seed. Throws DeviceError.
DriveError measure_drive_error(const Stage& stage, const LampSet& lamp_set, const PlayedCell& played, int first_tick, Renderer& renderer);

/// Metres: of the discs that the drive's technique draws lamps as, by `soft-map`; 0: points, as everything else draws them. `auto` is to be
/// chosen before.
double lamp_disc_radius_m(const Drive& drive);

} // namespace fernlicht
