// The table of quantities for people.
#pragma once

#include <string>

namespace fernlicht {

/// A paragraph for each quantity: its names, unit, which way is better, what it is.
std::string readings_text();
/// The table of docs/readings.md, with equation and source.
std::string readings_markdown();

} // namespace fernlicht
