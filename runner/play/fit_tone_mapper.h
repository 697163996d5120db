// The numbers that a drive's own pictures decide about its tone mapper.
#pragma once

#include "renderer/renderer.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// Draws the driver's view of moments evenly spread over the drive, small, with each of its lamp sets, and closes the drive's tone mapper
/// by what is seen there: one exposure for all its pictures. Adds a note with the numbers. Nothing for a mapper that is closed. Throws
/// InputError where the technique computes no luminance or there is no driver's view.
void fit_tone_mapper(Stage& stage, Device& device, const RendererSettings& settings);

/// For programs that draw moments one by one and fit nothing. Throws InputError for a mapper that is open.
void refuse_open_tone_mapper(const Drive& drive);

} // namespace fernlicht
