// The keys of lamp control, each struct described once.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/fields/field.h"

namespace fernlicht {

inline constexpr std::size_t most_control_lamps = 64, most_plugins = 16;
inline constexpr std::string_view bend_laws[] = {"steering", "yaw-rate", "route"};
inline constexpr std::string_view mode_classes[] = {"c", "v", "e", "w"};

const Fields<ControlParameters>& law_fields();           ///< all but `modes`, which has files
const Fields<ActuatorParameters>& law_actuator_fields(); ///< the laws' period holds for their actuators
const Fields<BendParameters>& bend_fields();
const Fields<CorneringParameters>& cornering_fields();
const Fields<BeamModeSettings>& mode_fields();    ///< of one class, without its file
const Fields<ModeParameters>& threshold_fields(); ///< when which class
const Fields<HighBeamParameters>& high_beam_fields();
const Fields<GlareFreeParameters>& glare_free_fields();
const Fields<PluginParameters>& plugin_fields();

/// Each of them with its keys' path below `control`.
void for_each_law(const std::function<void(const std::string&, const Group&)>& visit);

} // namespace fernlicht
