// Frames of a bus with their signals as JSON, one object a line.
#pragma once

#include "scenarios/can/candump_log.h"
#include "scenarios/can/signal_codec.h"

#include <span>
#include <string>
#include <string_view>

namespace fernlicht {

/// Text in JSON's quotes; bytes that are no UTF-8 become U+FFFD.
void append_json_text(std::string& out, std::string_view text);

/// {"time":1.000000,"channel":"can0","id":"123","data":"1122","message":"Name","signals":{"A":1.5},"labels":{"B":"On"},"units":{...}}
/// without line end. Keys that say nothing are left out; `message` nullptr: none describes the frame.
void append_frame_json(std::string& out, const CandumpLine& line, const CanMessage* message, std::span<const CanValue> values);

} // namespace fernlicht
