// Makes a renderer ready for a drive: everything that can be compiled is compiled before the first frame that is timed.
#pragma once

#include "renderer/renderer.h"
#include "runner/play/play.h"

namespace fernlicht {

/// What suits the device, found out by trying it. `profile`: each pass is finished and timed.
RendererSettings settings_for(Device& device, bool profile);
/// The same with what the drive asks for.
RendererSettings settings_for(const Drive& drive, RendererSettings settings);

/// Every kind of picture that play() asks for: the drive's views, plain and stored, and the maps of extents and probes.
std::vector<std::pair<View, Wanted>> pictures_of(const Drive& drive);

/// Moments of the ticks to be played, one for each set of lamps that shine together under each sky: what variants follow from.
std::vector<Moment> distinct_moments(const Drive& drive, const Route& route, const Variant& variant, TickRange ticks);

/// Compiles for all of these. Nothing compiles afterwards while the variant is played.
void prepare(Renderer& renderer, const Drive& drive, const Route& route, const Variant& variant, TickRange ticks);

} // namespace fernlicht
