// A verdict as a line of text, for the terminal and for a CI server.
#pragma once

#include "runner/findings/report.h"
#include "scenarios/values/errors.h"

namespace fernlicht {

/// "FAIL straight, halogen: reach_5lx_road_own_m: 58 m, limit at least 60 m\n" with `subject` between word and name; "" for what is plainly
/// green and not worth a line. A pass that was judged by other device classes is (baselines.h).
std::string verdict_line(const Verdict& verdict, const std::string& subject);

/// What is red as an annotation for a CI server's pages (files/log.h), with the command that repeats it; nothing for what is not.
void annotate_red(const Verdict& verdict, const std::string& subject, const InputError::Where& where);

} // namespace fernlicht
