// Logs of candump (can-utils): as `candump -L` writes them for machines, and as it prints them on a screen.
#pragma once

#include "scenarios/can/can_frame.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <vector>

namespace fernlicht {

/// How a line was written, so that it can be written back byte by byte.
struct CandumpStyle {
    enum class Form { log, screen } form = Form::log;
    std::uint8_t stamp_digits = 6; ///< behind the point; 0: no stamp
    std::optional<bool> sent;      ///< " T" or " R" behind the data (log) or "TX"/"RX" columns (screen, -x); nullopt: not written
    bool operator==(const CandumpStyle&) const = default;
};

struct CandumpLine {
    CanFrame frame;
    CandumpStyle style;
};

/// One line without its end. Throws InputError with `where` for what is no frame.
CandumpLine parse_candump_line(const std::string& line, const InputError::Where& where);
/// The frame as `candump -L` writes it, without line end: "(1436509052.249713) vcan0 044#2A366C2BBA".
std::string candump_line(const CanFrame& frame, const CandumpStyle& style = {});

/// All frames of a file, in its order. Blank lines and lines that begin with # or ; are skipped.
/// Throws InputError with file and line of the first that is no frame.
std::vector<CanFrame> read_candump(const std::filesystem::path& path, FilesRead& opened);

} // namespace fernlicht
