// Error against run time of what is not a way to light a scene: each study varies one thing and holds it against a much finer one.
#pragma once

#include "renderer/device.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/play/stage.h"

#include <functional>

namespace fernlicht {

/// Asked before each row; false: no more rows.
using StudyGoesOn = std::function<bool()>;

/// Size and depth of a texture of the lamp set's first lamp: error of the intensity against the candela table, over the time to make it.
WorkPrecision beam_study(const Stage& stage, const Variant& variant, const StudyGoesOn& go_on);

/// Cell of the extent grid: error of reach on the own lane's centre against cells of 1/16 m, over the time a moment, by the twin.
WorkPrecision extent_study(const Stage& stage, const Variant& variant, const StudyGoesOn& go_on);

/// Time step of the drive: error of the median, 5 % and 95 % of reach over the drive against 256 moments, over the time for the drive.
WorkPrecision step_study(const Stage& stage, const Variant& variant, const StudyGoesOn& go_on);

/// Samples of the reference, direct and path traced: error of a pixel's mean against many more samples of another seed, over the time of a
/// picture of 64 x 48 pixels, a diagram each. The slope over the samples stands in the notes.
std::vector<WorkPrecision> reference_study(const Stage& stage, const Variant& variant, std::uint64_t seed, const StudyGoesOn& go_on);

/// Comparing pictures on every n-th pixel: error of root mean square and of the share of pixels beyond 1 %, over the time.
WorkPrecision metrics_study(const Stage& stage, const Variant& variant, Device& device, const StudyGoesOn& go_on);

/// Period of lamp control: error of the swivel against a period of 0.25 ms, over the time of the run. Of no drive.
WorkPrecision control_study(const StudyGoesOn& go_on);

/// Times `work` so often that it takes a tenth of a second, at least three and at most 25 times.
Interval timed(const std::function<void()>& work);

} // namespace fernlicht
