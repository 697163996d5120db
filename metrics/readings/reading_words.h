// Readings as people say them.
#pragma once

#include "metrics/readings/reading_key.h"

namespace fernlicht {

/// "reach at 5 lx on a target, own lane, 5th percentile".
std::string reading_in_words(const ReadingKey& key);

/// Whose eyes a glare reading is of: "mirrors of a car 15 m ahead", "eyes of oncoming driver opposite".
std::string eyes_in_words(const ReadingKey& key);

} // namespace fernlicht
