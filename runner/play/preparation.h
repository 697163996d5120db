// Makes a drive and its renderer ready: everything that can be compiled is compiled before the first frame that is timed, and numbers of
// the tone mapper that the drive's own pictures decide are decided.
#pragma once

#include "renderer/renderer.h"
#include "runner/play/display_step.h"
#include "runner/play/play.h"
#include "runner/play/stage.h"

namespace fernlicht {

/// What suits the device, found out by trying it. `profile`: each pass is finished and timed.
RendererSettings settings_for(Device& device, bool profile);
/// The same with what the drive asks for.
RendererSettings settings_for(const Drive& drive, RendererSettings settings);

/// Every kind of picture that play() asks for: the drive's views, plain and stored, and the maps of extents and probes.
std::vector<std::pair<View, FrameOutputs>> pictures_of(const Drive& drive);

/// Moments of the ticks to be played, one for each set of lamps that shine together under each sky: what variants follow from.
std::vector<Moment> distinct_moments(const Drive& drive, const Route& route, const LampSet& lamp_set, TickRange ticks);

/// The drive's views that play() draws at a tick: all where it is captured, else the driver's, and without times that alone which the eye
/// adapts to.
std::vector<std::pair<const View*, FrameOutputs>> pictures_at(const Drive& drive, const DisplayStep& display, int tick, bool timed);

/// What is known of the pictures that are to be drawn.
enum class Foreseen { nothing, timed_pictures, stored_pictures };

/// Compiles for all of these. Nothing compiles afterwards while the lamp set is played as foreseen. With `nothing` it may stand wherever it
/// likes, for several times the variants where others have lamps, or there is weather or a sun.
void prepare(Renderer& renderer, const Drive& drive, const Route& route, const LampSet& lamp_set, TickRange ticks,
             Foreseen foreseen = Foreseen::timed_pictures);

/// Draws the driver's view of moments evenly spread over the drive, small, with each of its lamp sets, and closes the drive's tone mapper
/// by what is seen there: one exposure for all its pictures. Adds a note with the numbers. Nothing for a mapper that is closed. Throws
/// InputError where the technique computes no luminance or there is no driver's view.
void fit_tone_mapper(Stage& stage, Device& device, const RendererSettings& settings);

/// For programs that draw moments one by one and fit nothing. Throws InputError for a mapper that is open.
void refuse_unfitted_tone_mapper(const Drive& drive);

} // namespace fernlicht
