// A verdict as a line of text for the terminal.
#pragma once

#include "runner/findings/report.h"

namespace fernlicht {

/// "FAIL straight, halogen: reach_5lx_road_own_m: 58 m, limit at least 60 m\n" with `subject` between word and name; "" for what is plainly
/// green and not worth a line. A pass that was judged by other device classes is (baselines.h).
std::string verdict_line(const Verdict& verdict, const std::string& subject);

} // namespace fernlicht
