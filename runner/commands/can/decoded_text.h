// A frame's signals as text for a terminal and as a row of a table.
#pragma once

#include "scenarios/can/signal_codec.h"

#include <span>
#include <string>
#include <vector>

namespace fernlicht {

/// A number for eyes: whole numbers exactly, others with twelve digits, floats of 32 bits with their seven.
void append_readable(std::string& out, const CanValue& value);

/// Behind the frame's line: " ::" and "Name(", a signal a line, ")"; or all behind it on the same line. Without line end.
void append_decoded(std::string& out, const CanMessage& message, std::span<const CanValue> values, bool single_line, bool numbers);

/// A field of a table with commas, in quotes where it needs them.
void append_csv_text(std::string& out, const std::string& text);

} // namespace fernlicht
