// An OpenFlight database, read by OpenSceneGraph, as one of our models. Only here is OpenSceneGraph seen.
// What a modeller's name for a lamp means.
#pragma once

#include "scenarios/models/model.h"

#include <optional>
#include <string>

namespace fernlicht {

struct FlightModel {
    Model model;
    std::vector<std::string> pictures; ///< PNG, one for each of Model::textures
};

/// Which axis of the file looks forward: y for vehicles (x to the right), x where x is east and y north, as in databases of a place.
enum class FlightForward { y, x };

/// External references are followed, of levels of detail the finest is taken, of switches what is on; units become metres. Nodes and light
/// points that are named like lamps become mounts: head, low, high, fog, tail, brake or stop, indicator or turn, with left and right by
/// name or by place. Throws InputError.
FlightModel read_flight(const std::filesystem::path& path, FlightForward forward);

struct NamedLamp {
    std::string function; ///< "low", "high", "fog", "tail", "brake", "indicator-front", "indicator-rear", "reverse", "position"
    bool rear = false;
    std::optional<bool> left; ///< nullopt: the name does not say
};

/// nullopt for names that are no lamp's. Case does not matter; left and right are "left", "right", or l, r, lh, rh, lt, rt set apart by
/// anything but letters.
std::optional<NamedLamp> lamp_named(const std::string& name);

} // namespace fernlicht
