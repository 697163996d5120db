// What an error frame says, in candump's words.
#pragma once

#include "scenarios/can/can_frame.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Of bits 0-9 of an error frame's identifier (include/uapi/linux/can/error.h).
inline constexpr std::array<std::string_view, 10> can_error_classes = {
    "tx-timeout", "lost-arbitration", "controller-problem",      "protocol-violation", "transceiver-status", "no-acknowledgement-on-tx",
    "bus-off",    "bus-error",        "restarted-after-bus-off", "error-counter-tx-rx"};

/// A text for each class of the frame with what its data add, as `candump -e` prints one to a line:
/// "controller-problem{rx-error-passive}". Nothing for frames that are no error frames, and for classes beyond these.
std::vector<std::string> error_words(const CanFrame& frame);

} // namespace fernlicht
