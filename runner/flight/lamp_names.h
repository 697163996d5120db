// What a modeller's name for a lamp means.
#pragma once

#include <optional>
#include <string>

namespace fernlicht {

struct NamedLamp {
    std::string function; ///< "low", "high", "fog", "tail", "brake", "indicator-front", "indicator-rear", "reverse", "position"
    bool rear = false;
    std::optional<bool> left; ///< nullopt: the name does not say
};

/// nullopt for names that are no lamp's. Case does not matter; left and right are "left", "right", or l, r, lh, rh, lt, rt set apart by
/// anything but letters.
std::optional<NamedLamp> lamp_named(const std::string& name);

} // namespace fernlicht
