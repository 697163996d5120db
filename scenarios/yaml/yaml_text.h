// Pieces of the YAML that resolved drives are written in.
#pragma once

#include <string>
#include <string_view>

namespace fernlicht {

/// Text in double quotes, as YAML and JSON both read it.
std::string quoted(const std::string& text);

/// `key`_deg where some number of degrees gives exactly these radians, else `key`_rad.
std::string angle_entry(std::string_view key, double angle_rad);

} // namespace fernlicht
