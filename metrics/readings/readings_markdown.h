// The table of docs/readings.md.
#pragma once

#include <string>

namespace fernlicht {

/// One line for each quantity: its names, unit, which way is better, what it is, equation, source.
std::string readings_markdown();

} // namespace fernlicht
