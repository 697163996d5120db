// Errors of pixels, shadow methods and beams as JSON: the same in every file that holds them.
#pragma once

#include "metrics/images/pixel_errors.h"
#include "runner/experiments/bench/bench_result.h"
#include "runner/files/described_json.h"
#include "runner/findings/reach_error.h"
#include "scenarios/drives/shadow_settings.h"
#include "scenarios/lamps/beam_texels.h"

namespace fernlicht {

using Ticks = std::function<std::vector<int>()>;
/// Of moments, when it is asked.
Ticks ticks_of(const std::vector<std::pair<int, double>>& moments);

/// Without pixels: why not, which comes back into `back`. `frames`: the tick of each picture.
JsonPart errors_part(std::optional<PixelErrors>& errors, const std::string& why_not, std::string* back, const Ticks& frames);
JsonMembers reach_members(ReachError& error);
JsonPart shadow_method_part(ShadowMethod& method);
JsonPart beams_part(std::optional<BeamTexels>& beams); ///< as beams_text() writes them
/// typical_work(), which comes back as the work of one moment.
template <class Inner> JsonPart typical_work_part(std::vector<Work>& work, Inner inner) {
    return through([&] { return typical_work(work); },
                   [&](const std::optional<Work>& typical) { work.assign(typical ? 1 : 0, typical.value_or(Work{})); }, inner);
}

} // namespace fernlicht
