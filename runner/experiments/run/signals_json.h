// What a bus said and what became of it, as report.json stores it.
#pragma once

#include "scenarios/drives/play/bus_report.h"

#include <nlohmann/json.hpp>

namespace fernlicht {

nlohmann::ordered_json signals_json(const BusReport& bus);

} // namespace fernlicht
