// A drive as it was played, one row for each tick and everything that moves or shines; read back, it plays again without what led to it.
#pragma once

#include "scenarios/drives/play/moment.h"

#include <map>

namespace fernlicht {

/// Rows of a drive's log. Numbers have the digits that bring them back, so that a replay draws the same bytes. Lamps that stand in the
/// world are not among them: nothing about them changes.
struct DriveLog {
    enum class Kind { ego, lamp, body, light }; ///< the own car and its lamps; others and theirs
    struct Row {
        Kind kind = Kind::ego;
        std::string name;
        Pose pose;
        double speed_mps = 0.0;
        double factor = 0.0; ///< lamps: intensity against the lamp's file (level, voltage, control)
        bool visible = true;
    };
    std::filesystem::path file;
    std::map<std::pair<std::string, int>, std::vector<Row>> rows; ///< by variant and tick
};

/// First line of the file.
extern const char* const drive_log_header;
/// The rows of a moment.
std::string logged_moment(const std::string& variant, const Moment& moment);

/// Throws InputError with the line of what is no row.
DriveLog read_drive_log(const std::filesystem::path& path, FilesRead& opened);

/// Puts the log's poses, speeds and lamps in the place of the moment's. Throws InputError where the log has not this tick or other lamps
/// and road users than the moment.
void replay(const DriveLog& log, const std::string& variant, Moment& moment);

} // namespace fernlicht
