// Frames of a bus with their signals as JSON, one object a line, such that what was written can be read and sent again.
#pragma once

#include "scenarios/can/candump_log.h"
#include "scenarios/can/signal_codec.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

/// Text in JSON's quotes; bytes that are no UTF-8 become U+FFFD.
void append_json_text(std::string& out, std::string_view text);

/// {"time":1.000000,"channel":"can0","id":"123","data":"1122","message":"Name","signals":{"A":1.5},"labels":{"B":"On"},"units":{...}}
/// without line end. Keys that say nothing are left out; `message` nullptr: none describes the frame.
void append_frame_json(std::string& out, const CandumpLine& line, const CanMessage* message, std::span<const CanValue> values);

/// One such line, read back. Numbers stay as they stood, so that no digit is lost.
struct FrameJson {
    CandumpLine line; ///< what is not named stays as it is in a new frame
    bool has_id = false, has_time = false, has_data = false;
    std::string message;                                      ///< "": none named
    std::vector<std::pair<std::string, std::string>> signals; ///< name, number or label; numbers as they stood
    bool has_signals = false;
    bool is_frame = true; ///< false: it tells of frames that were lost
};
/// Throws InputError with `where` for what is no such object.
FrameJson parse_frame_json(std::string_view text, const InputError::Where& where);

} // namespace fernlicht
