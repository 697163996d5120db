// The keys that describe one lamp, wherever they stand: in a lamp, in its variant, in a change.
#pragma once

#include "scenarios/drives/keys/lamp_sets.h"

namespace fernlicht {

/// Maps from the nearest to the farthest: the first that gives a key decides.
using Layers = std::vector<YamlMap>;
std::optional<YamlEntry> find_in(const Layers& layers, std::string_view key);

/// `file` with the keys that say how it is read; nullptr when no layer names one. `axis`: of a Type C file where no layer gives it.
std::shared_ptr<const LampFile> read_lamp_keys(const Layers& layers, LampShelf& shelf, TypeCAxis axis = TypeCAxis::automatic);

/// Lamps of the high beam are told by their names.
inline bool is_high_beam(const std::string& lamp) { return lamp.find("high") != std::string::npos; }

struct AimKeys {
    std::optional<double> pitch_rad, yaw_rad, roll_rad;
};
/// `aim`: pitch_deg or percent_down, yaw_deg, roll_deg; each also in radians.
AimKeys read_aim(const Layers& layers);

std::optional<SourceKind> read_source(const Layers& layers);
/// `temperature_k`, `spectrum` or `colour`; else by the source: halogen 3200 K, xenon 4300 K. An LED's must be given.
LampColour read_colour(const Layers& layers, SourceKind source, LampShelf& shelf, const YamlEntry& asked_by);
bool gives_colour(const Layers& layers);

} // namespace fernlicht
