// The keys of lamp control, each struct described once, and the reader of that part of a drive file.
#pragma once

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/lamp_sets.h"
#include "scenarios/fields/field.h"

namespace fernlicht {

inline constexpr std::size_t max_control_lamps = 64, max_plugins = 16, max_failures = 1000, max_inputs = 100, max_input_values = 100'000;
inline constexpr std::string_view bend_laws[] = {"steering", "yaw-rate", "route"};

const Fields<ControlParameters>& law_fields();
inline constexpr std::string_view control_schema = R"({"anyOf": [{"enum": ["none"]}, {"$ref": "#/definitions/control"}]})";
const Fields<ActuatorParameters>& law_actuator_fields(); ///< the laws' period holds for their actuators
const Fields<BendParameters>& bend_fields();
const Fields<CorneringParameters>& cornering_fields();
const Fields<BeamModeSettings>& mode_fields(); ///< of one class
const Fields<ModeParameters>& modes_fields();
const Fields<HighBeamParameters>& high_beam_fields();
const Fields<GlareFreeParameters>& glare_free_fields();
const Fields<PluginParameters>& plugin_fields();
const Fields<ControlFailure>& failure_fields();

/// `control` of the lamp set's keys, else of the drive: the laws that move and dim the lamp set's lamps. `none`: nothing is controlled.
/// Lamps and signals that are named must be there. Throws InputError (yaml_entry.h).
void read_control(const YamlMap& drive, const YamlMap* keys, LampSet& lamp_set, LampCache& cache);

} // namespace fernlicht
