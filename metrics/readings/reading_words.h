// Names of readings as people say them.
#pragma once

#include "metrics/readings/value.h"

#include <string>

namespace fernlicht {

/// "reach_5lx_target_own_m": "reach at 5 lx on a target, own lane". Names of other forms stay as they are.
std::string reading_in_words(const std::string& name);

/// "glare_mirrors_at_15m": "mirrors of a car 15 m ahead"; "glare_opposite": "eyes of oncoming driver opposite".
std::string eyes_in_words(const std::string& subject);

/// The figure's text with what bounds it: "> 200" for a value of at least 200.
std::string with_bound(const Value& value, const std::string& figure);

} // namespace fernlicht
