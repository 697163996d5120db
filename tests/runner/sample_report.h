// A report with plausible numbers from two made-up beams, for the tests of the writers.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht::tests {

/// `moments` moments, 0.1 s apart, of two lamp sets ("halogen", "xenon") over a drive called "country road"; maps, but no picture files.
Report sample_report(int moments = 120);

/// What an oncoming eye saw at the first two moments.
SeeingSeries sample_seeing();

/// Small pictures for every frame that the report names below `folder`: the beam on a plane road as the driver would see it.
void write_sample_frames(const Report& report, const std::filesystem::path& folder);

} // namespace fernlicht::tests
