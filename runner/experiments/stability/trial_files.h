// Files of a user, as the cases write them: lamps, a road, drives.
#pragma once

#include "runner/experiments/stability/stability_case.h"
#include "scenarios/drives/drive.h"

namespace fernlicht::stability {

/// A beam matrix in cd over goniometer angles.
std::string matrix_text(const CandelaTable& table);

/// One road of OpenDRIVE. `plan`: its geometry elements; `lanes`: of the right side; `profiles`: elevation and lateral profile.
std::string road_text(double length_m, const std::string& plan, const std::string& lanes, const std::string& profiles = {});
/// A driving lane of even width, with `more` inside.
std::string lane_text(int id, double width_m, const std::string& more = {});
inline const std::string line_of_600_m = R"(<geometry s="0" x="0" y="0" hdg="0" length="600"><line/></geometry>)";

/// A drive of one lamp on the straight road, at 60 km/h for 8 s in steps of 0.1 s, with `more` keys of YAML, one a line. `time` replaces
/// the three of speed, step and duration.
std::filesystem::path write_drive_file(StabilityBench& bench, const std::string& name, const std::string& more,
                                       const std::string& time = {});

/// What the readers say to an input that they refuse; "" when they take it. Anything but InputError is thrown on.
std::string refusal(const std::function<void()>& read);

} // namespace fernlicht::stability
