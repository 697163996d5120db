// The lamps of a drive file: mounts on the car, variants, changes over time.
#pragma once

#include "scenarios/drives/drive.h"
#include "scenarios/drives/keys/lamp_mounts.h"
#include "scenarios/yaml/yaml_entry.h"

#include <map>

namespace fernlicht {

inline constexpr std::size_t most_variants = 32, most_lamps = 64, most_lamp_changes = 10'000;

/// Reads lamp and spectrum files for a drive, each once, and keeps what was opened.
class LampShelf {
  public:
    /// `asked_by` is the place in the YAML that names a missing file.
    std::shared_ptr<const LampFile> lamp(const std::filesystem::path& path, const LampReadOptions& options,
                                         const YamlEntry* asked_by = nullptr);
    LampColour spectrum(const std::filesystem::path& path, const YamlEntry& asked_by);

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
    std::optional<YamlEntry> lamps; ///< `car.lamps`: the one lamp set of a drive without variants
};

std::vector<std::string> lamp_names(const Variant& variant);
/// A name, which a lamp of the variant must have.
std::string lamp_name(const YamlEntry& entry, const Variant& variant);

/// `lamps`, or one lamp on each mount with the `file` of `keys`; then their `changes`, sorted by time.
Variant read_lamp_set(const std::string& name, const YamlMap& keys, const Car& car, LampShelf& shelf);

template <class Struct> struct Fields;
const Fields<Drive>& car_fields();
const Fields<Variant>& variant_fields();
/// Bumper, wheelbase and body become the drive's own.
Car read_car(const YamlMap& drive_keys, Drive& drive);
/// `variants`, or `car.lamps` as the one variant; then `changes`, of the drive first and of each variant after it, sorted by time.
std::vector<Variant> read_variants(const YamlMap& drive, const Car& car, LampShelf& shelf);

} // namespace fernlicht
