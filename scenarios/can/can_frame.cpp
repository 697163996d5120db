#include "scenarios/can/can_frame.h"

#include <fmt/format.h>
#include <sstream>

namespace fernlicht {
namespace {

constexpr std::array<std::string_view, 10> can_error_classes = {
    "tx-timeout", "lost-arbitration", "controller-problem",      "protocol-violation", "transceiver-status", "no-acknowledgement-on-tx",
    "bus-off",    "bus-error",        "restarted-after-bus-off", "error-counter-tx-rx"};
constexpr std::array<std::string_view, 7> can_controller_problems = {
    "rx-overflow", "tx-overflow", "rx-error-warning", "tx-error-warning", "rx-error-passive", "tx-error-passive", "back-to-error-active"};
constexpr std::array<std::string_view, 8> can_protocol_violations = {
    "single-bit-error",       "frame-format-error", "bit-stuffing-error", "tx-dominant-bit-error",
    "tx-recessive-bit-error", "bus-overload",       "active-error",       "error-on-tx"};

/// By the place in the frame, 1 to 31, that data[3] gives.
std::string violation_place(std::uint8_t wanted) {
    std::istringstream places(
        "unspecified id.28-to-id.21 start-of-frame bit-srtr bit-ide id.20-to-id.18 id.17-to-id.13 crc-sequence reserved-bit-0 data-field "
        "data-length-code bit-rtr reserved-bit-1 id.4-to-id.0 id.12-to-id.5 unspecified active-error-flag intermission "
        "tolerate-dominant-bits unspecified unspecified passive-error-flag error-delimiter crc-delimiter acknowledge-slot end-of-frame "
        "acknowledge-delimiter overload-flag unspecified unspecified unspecified");
    std::string place;
    for (std::uint8_t i = 0; i < wanted; ++i)
        if (!(places >> place))
            return {};
    return place;
}

template <class Words> std::string words_of_bits(std::uint8_t bits, const Words& words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (bits >> i & 1)
            text += fmt::format("{}{}", text.empty() ? "" : ",", words[i]);
    return text;
}

} // namespace

std::vector<std::string> error_words(const CanFrame& frame) {
    std::vector<std::string> all;
    if (!frame.error || frame.id > 1U << can_error_classes.size())
        return all;
    const auto& data = frame.data;
    const std::string counters = fmt::format("{{{{{}}}{{{}}}}}", data[6], data[7]);
    for (std::size_t i = 0; i < can_error_classes.size(); ++i) {
        if (!(frame.id >> i & 1))
            continue;
        std::string text(can_error_classes[i]);
        if (i == 1)
            text += fmt::format("{{at bit {}}}", data[0]);
        else if (i == 2)
            text += "{" + words_of_bits(data[1], can_controller_problems) + "}";
        else if (i == 3)
            text += fmt::format("{{{{{}}}{{{}}}}}", words_of_bits(data[2], can_protocol_violations), violation_place(data[3]));
        else if (i == 9)
            text += counters;
        all.push_back(std::move(text));
    }
    if (!(frame.id >> 9 & 1) && (data[6] || data[7]))
        all.push_back("error-counter-tx-rx" + counters);
    return all;
}

} // namespace fernlicht
