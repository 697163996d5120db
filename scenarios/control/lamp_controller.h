// All laws of a lamp set, moved on tick by tick: signals in, commands out, in one table.
#pragma once

#include "scenarios/control/beam_modes.h"
#include "scenarios/control/bend_light.h"
#include "scenarios/control/cornering_light.h"
#include "scenarios/control/high_beam.h"
#include "scenarios/control/surroundings.h"

#include <glm/vec3.hpp>

namespace fernlicht {

struct ControlledLamp {
    std::string name;
    glm::dvec3 position_m{0.0};                              ///< in the car's frame
    double yaw_rad = 0.0;                                    ///< its aim, left positive
    std::vector<std::pair<double, double>> windows_deg = {}; ///< of its segments: from, to; right positive
};

class LampController {
  public:
    /// Names of lamps in `parameters` must be among `lamps`.
    LampController(const ControlParameters& parameters, std::vector<ControlledLamp> lamps, const ControlledCar& car);

    /// Reads what car, road, drive, traffic and actuators wrote into `table` and writes the laws' signals: the state `dt_s` after the last
    /// step. The first step starts all filters at its input. `segments`: levels of each lamp's windows.
    void step(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings, double dt_s);

  private:
    void bend(SignalTable& table, double dt_s);
    void level(SignalTable& table, double dt_s);
    void glare_free(SignalTable& table, std::vector<std::vector<double>>& segments, const Surroundings& surroundings, double dt_s);
    std::vector<std::size_t> places(const std::vector<std::string>& names) const;

    ControlParameters parameters_;
    std::vector<ControlledLamp> lamps_;
    std::optional<BendLight> bend_;
    std::optional<CorneringLight> cornering_;
    std::optional<BeamModes> modes_;
    std::optional<HighBeam> high_beam_;
    std::vector<std::pair<std::size_t, LampWindows>> windows_;                                   ///< lamp
    std::vector<std::size_t> swivelling_, left_corner_, right_corner_, mode_lamps_, high_lamps_; ///< into lamps_
    FirstOrder mean_pitch_{10.0}; ///< static levelling: slower than any swing of the body, quicker than loading
};

} // namespace fernlicht
