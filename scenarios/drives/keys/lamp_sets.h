// The lamps of a drive file: mounts on the car, lamp sets, changes over time.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/drives/keys/lamp_mounts.h"
#include "scenarios/yaml/yaml_entry.h"

#include <map>

namespace fernlicht {

inline constexpr std::size_t max_lamp_sets = 32, max_lamps = 64, max_lamp_changes = 10'000;

/// Reads lamp and spectrum files for a drive, each once, and keeps what was opened.
class LampCache {
  public:
    /// `asked_by` is the place in the YAML that names a missing file.
    std::shared_ptr<const LampFile> lamp(const std::filesystem::path& path, const LampReadOptions& options,
                                         const YamlEntry* asked_by = nullptr);
    LampColour spectrum(const std::filesystem::path& path, const YamlEntry& asked_by);
    /// Of the lamp's pixels, by its levels_file; one track for each lamp.
    std::shared_ptr<const LevelTrack> levels(const MountedLamp& lamp, const YamlEntry& asked_by);

    const std::vector<LampSource>& sources() const { return sources_; }
    const FilesRead& opened() const { return opened_; }

  private:
    std::vector<LampSource> sources_;
    std::map<std::filesystem::path, LampColour> spectra_;
    FilesRead opened_;
};

/// Throws InputError at the entry unless the file is there, regular and readable.
void check_file(const std::filesystem::path& path, const YamlEntry& asked_by);

struct Car {
    std::vector<LampMount> mounts;  ///< of its body where `mounts` does not name them
    std::optional<YamlEntry> lamps; ///< `car.lamps`: the one lamp set of a drive without lamp sets
};

std::vector<std::string> lamp_names(const LampSet& lamp_set);
/// A name, which a lamp of the lamp set must have.
std::string lamp_name(const YamlEntry& entry, const LampSet& lamp_set);

/// `lamps`, or one lamp on each mount with the `file` of `keys`; then their `changes`, sorted by time.
LampSet read_lamp_set(const std::string& name, const YamlMap& keys, const Car& car, LampCache& cache);

template <class Struct> struct Fields;
const Fields<Drive>& car_fields();
const Fields<LampSet>& lamp_set_fields();
/// Bumper, wheelbase and body become the drive's own.
Car read_car(const YamlMap& drive_keys, Drive& drive);
/// `lamp_sets`, or `car.lamps` as the one lamp set; then `changes`, of the drive first and of each lamp set after it, sorted by time.
std::vector<LampSet> read_lamp_sets(const YamlMap& drive, const Car& car, LampCache& cache);

} // namespace fernlicht
