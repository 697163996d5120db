// What a bus would carry if a drive's own script were the car: the recording that a drive with `can` is played by.
// What a run's lamp controller sent, as candump would have logged it.
#pragma once

#include "scenarios/drives/drive.h"

#include <string>

namespace fernlicht {

struct CanFrame;

/// The inputs of the drive's mapping the other way round: at each tick of control the values that the drive's own world and script give the
/// signal table, encoded into the messages that the inputs come from (`also` too), at the messages' cycle times, or at the control period.
/// Stamped from the drive's 0 s, in order of time. `drive`: staged with `can` played by the script (BusMapping::scripted); the lamp set has
/// been simulated with it. Throws InputError for a drive without inputs and what mapping and databases lack. `notes` gets what was cut to
/// the range of a signal.
std::vector<CanFrame> recorded_inputs(const Drive& drive, const Route& route, const LampSet& lamp_set, FilesRead& opened,
                                      std::vector<std::string>& notes);

/// Lines of `candump -L`, stamped as the recording is that the drive was played by (0 s without one), so that both can be merged. "" for a
/// lamp set that sent nothing.
std::string output_log(const Drive& drive, const LampSet& lamp_set);

} // namespace fernlicht
