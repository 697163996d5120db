// An OpenFlight database, read by OpenSceneGraph, as one of our models. Nothing else knows OpenSceneGraph.
#pragma once

#include "scenarios/models/model.h"

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

} // namespace fernlicht
