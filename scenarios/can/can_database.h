// What the frames of a bus mean: messages and signals, as a DBC file says it.
#pragma once

#include "scenarios/values/files.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht {

enum class CanValueKind { whole, float32, float64 };

struct CanSignal {
    std::string name;
    /// Position as DBC counts it: byte = bit / 8, from 0 = least significant bit of a byte. Intel (little endian): of the signal's least
    /// significant bit. Motorola (big endian): of its most significant bit.
    std::uint16_t start_bit = 0;
    std::uint16_t length = 0; ///< bits: 1-64; 32 and 64 for float32 and float64
    bool big_endian = false;
    bool is_signed = false;
    CanValueKind kind = CanValueKind::whole;
    double factor = 1.0, offset = 0.0;   ///< physical = raw * factor + offset
    double minimum = 0.0, maximum = 0.0; ///< physical; both 0: no limits
    std::string unit;
    std::map<std::int64_t, std::string> labels; ///< raw value to text (VAL_); those of unsigned 64-bit signals by their bit pattern
    std::optional<double> start_value;          ///< raw (GenSigStartValue); what an encoder sends before it is told better

    bool multiplexor = false;
    std::string multiplexed_by;                                            ///< name of the signal that switches this one; "": always there
    std::vector<std::pair<std::uint64_t, std::uint64_t>> multiplexed_when; ///< raw values of it, both ends included

    bool has_limits() const { return minimum != 0.0 || maximum != 0.0; }
    bool operator==(const CanSignal&) const = default;
};

struct CanMessage {
    std::uint32_t id = 0; ///< without the flag of extended identifiers
    bool extended = false;
    bool fd = false; ///< VFrameFormat says so, or it is longer than 8 bytes
    bool bit_rate_switch = false;
    std::string name;
    std::uint16_t length = 0;       ///< bytes
    std::optional<double> cycle_s;  ///< GenMsgCycleTime; nullopt or 0: not cyclic
    std::vector<CanSignal> signals; ///< in the order of the file

    const CanSignal* signal(const std::string& name) const; ///< nullptr: none
    bool operator==(const CanMessage&) const = default;
};

struct CanDatabase {
    std::filesystem::path file;
    std::vector<CanMessage> messages; ///< in the order of the file
    std::vector<std::string> notes;   ///< what was odd and how it was taken, one sentence each with the line

    const CanMessage* message(std::uint32_t id, bool extended) const; ///< nullptr: none
    const CanMessage* message(const std::string& name) const;         ///< nullptr: none
};

/// Reads a DBC file. Throws InputError with file, line, what was found and expected.
CanDatabase read_dbc(const std::filesystem::path& path, FilesRead& opened);

} // namespace fernlicht
