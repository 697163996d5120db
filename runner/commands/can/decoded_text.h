// A frame's signals as text for a terminal and as a row of a table.
// Frames of a bus with their signals as JSON, one object a line.
#pragma once

#include "scenarios/can/candump_log.h"
#include "scenarios/can/signal_codec.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// A number for eyes: whole numbers exactly, others with twelve digits, floats of 32 bits with their seven.
void append_readable(std::string& out, const CanValue& value);

/// Behind the frame's line: " ::" and "Name(", a signal a line, ")"; or all behind it on the same line. Without line end.
void append_decoded(std::string& out, const CanMessage& message, std::span<const CanValue> values, bool single_line, bool numbers);

/// A field of a table with commas, in quotes where it needs them.
void append_csv_text(std::string& out, const std::string& text);

/// Text in JSON's quotes; bytes that are no UTF-8 become U+FFFD.
void append_json_text(std::string& out, std::string_view text);

/// {"time":1.000000,"channel":"can0","id":"123","data":"1122","message":"Name","signals":{"A":1.5},"labels":{"B":"On"},"units":{...}}
/// without line end. Keys that say nothing are left out; `message` nullptr: none describes the frame.
void append_frame_json(std::string& out, const CandumpLine& line, const CanMessage* message, std::span<const CanValue> values);

} // namespace fernlicht
