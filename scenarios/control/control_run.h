// Lamp control over a whole drive, before its first frame: afterwards each lamp's aim and level are functions of time.
#pragma once

#include "scenarios/control/control_loop.h"

namespace fernlicht {

struct ControlRun {
    std::vector<std::string> lamps;
    std::vector<LampRun> runs; ///< by lamp
    std::array<BeamModeSettings, 4> modes;
    std::vector<bool> has_modes; ///< by lamp
    /// By lamp: from when which file; of lamps whose file is cut into windows. nullptr: as it is.
    std::vector<std::vector<std::pair<double, std::shared_ptr<const LampFile>>>> masks;
    double body_pitch_rad = 0.0, rear_lift_m = 0.0; ///< what the load does to the body
    double period_s = 0.0;
    std::uint64_t ticks = 0;
    /// The signal table at the moments of the drive: the row that held, with the actuators where they are at that very time.
    std::vector<std::string> signals;
    std::vector<std::vector<double>> rows;
    std::vector<std::string> notes;

    std::size_t lamp(const std::string& name) const; ///< lamps.size(): none of this name
    double swivel_rad(std::size_t lamp, double time_s) const;
    double pitch_rad(std::size_t lamp, double time_s) const;
    double level(std::size_t lamp, double time_s) const;
    const BeamModeSettings& mode(std::size_t lamp, double time_s) const;         ///< nothing for a lamp without
    std::shared_ptr<const LampFile> file(std::size_t lamp, double time_s) const; ///< nullptr: the lamp's own
};

struct ControlSpan {
    double end_s = 0.0;
    double row_step_s = 0.0; ///< moments of the drive
};

/// Ticks at k * period from 0 to the end. Throws as ControlLoop does.
ControlRun run_control(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                       const std::function<ControlInputs(double time_s)>& inputs, const ControlSpan& span,
                       const SolverOptions& options = {});

} // namespace fernlicht
