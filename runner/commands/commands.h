// The commands of `fernlicht`, a source file each.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Runs the chosen command; gives the program's exit code.
int command_line(int argc, char** argv);

/// Adds a command with its flags. When it is chosen, `chosen` becomes what does it and gives the exit code. `command` is the whole command
/// line as typed, for the results.
using AddCommand = void(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

AddCommand add_run_command;          // plays drives and writes a report
AddCommand add_live_command;         // a drive against the clock, on a CAN bus
AddCommand add_study_command;        // lamps x drives x techniques x conditions, compared
AddCommand add_bench_command;        // times the techniques against one another
AddCommand add_compare_command;      // what differs between two pictures, lamps or runs; 1 when a class of strictness is not kept
AddCommand add_accuracy_command;     // error against run time
AddCommand add_aliasing_command;     // how much of what a picture shows is not there, by how it is drawn
AddCommand add_film_command;         // drives as a film, lamp sets beside one another
AddCommand add_fit_command;          // aim, flux and height of lamps that explain measured lux points
AddCommand add_importance_command;   // where in the beam a reading of a drive is decided
AddCommand add_masks_command;        // what masks of an adaptive beam cost the driver, against what they spare others
AddCommand add_rate_command;         // one lamp set judged by a rating: drives, limits over distance, points
AddCommand add_installation_command; // a drive's low beams against UN R48: loads, bend light; 1 when one breaks it
AddCommand add_improve_command;      // the smallest change of a lamp that gains what is asked of readings
AddCommand add_shadows_command;      // how wrong each shadow method is, and what it costs
AddCommand add_reference_command;    // one moment by rays, each pixel with its standard error
AddCommand add_list_commands;        // list the ways to light a scene, what is read of a drive, what lamp control reads and writes
AddCommand add_can_command;          // small tools for logs and frames of a CAN bus (runner/commands/can)
AddCommand add_lamp_command;         // what a lamp file holds; scaled, mirrored, summed, converted, held against a regulation
AddCommand add_model_command;        // what a model file holds, as text, JSON or picture
AddCommand add_import_command;       // old databases once into a format that is read everywhere
AddCommand add_storyboard_command;   // plays OpenSCENARIO files without drawing
AddCommand add_doctor_command;       // what this machine can draw with
AddCommand add_stability_command;    // extreme and degenerate inputs as a table of cases; 1 when one fails
AddCommand add_accept_command;       // takes a run's results as what later runs are compared with
AddCommand add_baselines_command;    // lists, shows, compares and removes what was accepted
AddCommand add_store_command;        // lists, verifies and prunes the cells that studies keep
AddCommand add_history_command;      // what nights of a study read, over months: what changed, when and why
AddCommand add_new_command;          // a commented file to start from: a lamp, a drive or a study
AddCommand add_check_command;        // all that is wrong with files of any kind; 2 when there is an error
AddCommand add_open_command;         // a report in the browser
AddCommand add_migrate_command;      // files of version 0.1 with the names of today
AddCommand add_manual_commands;      // hidden: man pages and completions of shells, out of this table

} // namespace fernlicht
