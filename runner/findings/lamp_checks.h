// The lamp files that a run or a study plays with, each looked at once before the first frame.
#pragma once

#include "metrics/beam/intake.h"
#include "runner/findings/document.h"
#include "scenarios/drives/drive.h"

#include <map>
#include <string>
#include <vector>

namespace fernlicht {

struct CheckedLampFile {
    std::string file;                 ///< its name
    std::vector<std::string> used_as; ///< "halogen: left", "traffic: oncoming"
    BeamFunction function = BeamFunction::other;
    bool function_stated = false;
    bool filament = true;                ///< the light goes with the voltage
    std::optional<double> measured_at_v; ///< nullopt: not stated
    std::vector<IntakeFinding> findings;
};

class LampFileChecks {
  public:
    /// The lamps of all lamp sets with the files of their changes, and headlamps of other road users. A mount may lower what a file has too
    /// high; one that raises it is meant so. With `turned_up_deg` all low beams are turned by that instead. Of the own car's lamps left,
    /// right and low ones are low beams' mounts, high ones high beams', unless a change brings them another file.
    void add(const Drive& drive, bool left_hand_traffic, std::optional<double> turned_up_deg = {});

    const std::vector<CheckedLampFile>& files() const { return files_; }
    /// For --strict: throws InputError where readings with a file say nothing of the lamp; tells all such findings of all files.
    void refuse_meaningless() const;

  private:
    struct Use;
    CheckedLampFile& checked(const Use& use);
    void check_pair(const Drive& drive, const LampSet& lamp_set, const std::string& left, const std::string& right);
    std::map<std::string, std::size_t> places_; ///< by file and what is known of it
    std::vector<CheckedLampFile> files_;
    std::vector<std::filesystem::path> paths_; ///< of `files_`
};

/// For --strict: throws InputError naming `file` where any of the findings makes readings meaningless; tells all that do.
void refuse_meaningless(const std::filesystem::path& file, const std::vector<IntakeFinding>& findings, const char* without);

/// One sentence for each finding that makes readings meaningless, and for each file that is no headlamp's on a headlamp's mount.
std::vector<std::string> lamp_warnings(const std::vector<CheckedLampFile>& files);
/// The same of the lamps of one lamp set alone.
std::vector<std::string> lamp_warnings(const Drive& drive, const LampSet& lamp_set, bool left_hand_traffic);
/// What was found and how each file was understood, with what the voltage leaves open; without rows where there is no file.
Table lamp_files_table(const std::vector<CheckedLampFile>& files);
/// "not stated: taken as 13.2 V; measured at 12.8 V (FMVSS 108) it would be 0.90 of that"; what does not depend on it says so.
std::string voltage_text(bool filament, const std::optional<double>& measured_at_v);
std::string function_text(BeamFunction function, bool stated); ///< "low (recognised)"

} // namespace fernlicht
