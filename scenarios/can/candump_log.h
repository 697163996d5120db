// Logs of candump (can-utils): as `candump -L` writes them for machines, and as it prints them on a screen.
// Colours of candump -c: what switches them on, in its order, and off.
#pragma once

#include "scenarios/can/can_frame.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// How a line was written, so that it can be written back byte by byte. A default one is as `candump -L` writes.
struct CandumpStyle {
    enum class Form : std::uint8_t { log, screen } form = Form::log;
    bool date = false;                ///< stamp as "2026-11-22 12:38:19.000000", by the UTC offset it is read and written with
    std::uint8_t stamp_digits = 6;    ///< behind the point: 6 or 9; 0: no stamp (screen)
    std::uint8_t second_digits = 10;  ///< at least so many before the point; delta and zero stamps: 3
    std::uint8_t channel_columns = 0; ///< the channel stands at the right of so many columns; 0: as wide as its name
    std::optional<bool> sent;         ///< " T" or " R" behind the data (log), "TX" or "RX" columns (screen); nullopt: not written
    std::uint8_t more_fd_flags = 0;   ///< of CAN FD in a log: bits beyond BRS (1) and ESI (2); newer candump sets FDF (4)
    bool dotted = false;              ///< log: points between the bytes

    // Of the screen form alone, by candump's options.
    bool narrow = false;          ///< no blank in front, as log2long writes
    bool indented = false;        ///< identifiers of 11 bits at the right of those with 29, as after the first of these
    bool binary = false;          ///< -i
    bool ascii = false;           ///< -a
    bool swapped = false;         ///< -S: last byte first
    bool shows_dlc = false;       ///< -8: {F} in place of [8]
    std::uint8_t colour_mode = 0; ///< -c given so many times: 0-3
    std::uint8_t colour = 0;      ///< of candump's six, by channel: 0-5
    bool colour_stays_on = false; ///< the line does not switch it off: an explanation of an error frame follows

    bool operator==(const CandumpStyle&) const = default;
};

struct CandumpLine {
    CanFrame frame;
    CandumpStyle style;
};

/// One line without its end; a carriage return at its end does not count. Stamps are taken as they stand: absolute, delta and zero stamps
/// look alike (candump_stream.h tells them apart), dates are taken as UTC. Without a stamp `time_ns` is 0.
/// Throws InputError with `where` and the column for what is no frame.
CandumpLine parse_candump_line(std::string_view line, const InputError::Where& where);
void parse_candump_line(std::string_view line, const InputError::Where& where, CandumpLine& out);

/// The frame as candump writes it, without line end; by default as `candump -L`: "(1436509052.249713) vcan0 044#2A366C2BBA".
/// What the form does not show is left out: digits of the stamp (cut off), flags of CAN FD on a screen without `sent`, DLC codes above 8
/// on a screen without `shows_dlc`. Throws std::invalid_argument for a time before 0.
std::string candump_line(const CanFrame& frame, const CandumpStyle& style = {});
void append_candump_line(std::string& out, const CanFrame& frame, const CandumpStyle& style = {});

/// All frames of a file, in its order, with absolute times (delta stamps added up). Blank lines, lines that begin with # or ;, and what
/// candump adds to frames (DROPCOUNT, explanations of error frames) are skipped.
/// Throws InputError with file and line of the first that is no frame.
std::vector<CanFrame> read_candump(const std::filesystem::path& path, FilesRead& opened);

inline constexpr std::array<std::string_view, 6> candump_colours = {"\33[1m\33[34m", "\33[1m\33[31m", "\33[1m\33[32m",
                                                                    "\33[1m",        "\33[1m\33[35m", "\33[1m\33[36m"};
inline constexpr std::string_view candump_colour_off = "\33[0m";

} // namespace fernlicht
