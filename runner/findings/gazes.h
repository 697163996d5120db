// Eyes of oncoming drivers that look into the lamps, as where a lane bends: equations of glare then tell of a light in the middle of their
// sight.
#pragma once

#include "metrics/folds/seeing_series.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

/// By drive and eye: the smallest angle between line of sight and lamp, degrees, of moments in which that line passes within 1.2 m of a
/// lamp that is at most 120 m away (of the next lane of a straight it passes some 2 m beside).
using Gazes = std::map<std::pair<std::string, std::string>, double>;

/// `theta_deg`: angles of one lamp, as many as `at_m`; NaN where there is none. Others than eyes that stand still are left out.
void add_gaze(Gazes& gazes, const std::string& drive, const SeeingSeries& eye, const std::vector<double>& at_m,
              const std::vector<double>& theta_deg);

/// One sentence each.
std::vector<std::string> gaze_warnings(const Gazes& gazes);

} // namespace fernlicht
