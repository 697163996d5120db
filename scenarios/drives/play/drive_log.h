// A drive as it was played, one row for each tick and everything that moves or shines; read back, it plays again without what led to it.
// The signal table over a drive as a CSV file: one row per moment.
#pragma once

#include "scenarios/control/control_run.h"
#include "scenarios/drives/drive.h"
#include "scenarios/drives/play/moment.h"

#include <map>
#include <string>

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
    std::map<std::pair<std::string, int>, std::vector<Row>> rows; ///< by lamp set and tick
};

/// First line of the file.
extern const char* const drive_log_header;
/// The rows of a moment.
std::string logged_moment(const std::string& lamp_set, const Moment& moment);

/// Throws InputError with the line of what is no row.
DriveLog read_drive_log(const std::filesystem::path& path, FilesRead& opened);

/// Puts the log's poses, speeds and lamps in the place of the moment's. Throws InputError where the log has not this tick or other lamps
/// and road users than the moment.
void replay(const DriveLog& log, const std::string& lamp_set, Moment& moment);

/// Columns: frame, then each signal by name; a signal that is lost is empty, a distance to nothing "inf". Behind them, of each input from a
/// bus, NAME.state (fresh, stale, missing, out_of_range, contradictory) and NAME.age_s. Of the ticks first..last.
std::string signals_csv(const Drive& drive, const ControlRun& run, int first, int last);

} // namespace fernlicht
