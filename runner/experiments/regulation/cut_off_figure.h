// A low beam's cut-off as it was measured: the scans, what they found, and the elbow's fit over the isocandela diagram.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/beam/cut_off_elbow.h"
#include "runner/write/plots/svg.h"
#include "scenarios/lamps/lamp_file.h"

namespace fernlicht {

/// `mirrored`: the measurements are those of the lamp's mirror image; the figure shows the lamp.
plots::Figure cut_off_figure(const LampFile& lamp, const CutOffFigures& cut_off, const CutOffElbow& elbow, bool mirrored);

} // namespace fernlicht
