// `fernlicht accuracy`: error against run time.
// fernlicht aliasing: how much of what a picture shows is not there, by how it is drawn.
// `fernlicht bench`: times the techniques against one another.
// `fernlicht compare A B`: what differs between two pictures.
// `fernlicht doctor`: what this machine can draw with.
// `fernlicht live`: a drive against the clock, on a CAN bus.
// `fernlicht readings`: lists what is read of a drive.
// `fernlicht reference`: one moment by rays, each pixel with its standard error.
// `fernlicht references list|show|diff|remove`: what was accepted, and how it differs.
// fernlicht shadows: how wrong each shadow method is, and what it costs.
// `fernlicht signals`: lists what lamp control reads and writes.
// `fernlicht stability`: extreme and degenerate inputs as a table of cases, each measured and judged.
// `fernlicht storyboard`: plays OpenSCENARIO files without drawing.
// `fernlicht study`: lamps x drives x techniques x conditions, compared.
// `fernlicht techniques`: lists the ways to light a scene.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// `command` is the whole command line as typed, for the result.
void add_accuracy_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

/// Adds the command; when it is chosen, `chosen` becomes what does it. `command` is the command line, for the results.
void add_aliasing_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

/// `command` is the whole command line as typed, for the result.
void add_bench_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

/// Adds the subcommand; chosen, it sets `chosen`, which gives 1 when a class of strictness was asked for and not kept.
void add_compare_command(CLI::App& app, std::function<int()>& chosen);

void add_doctor_command(CLI::App& app, std::function<int()>& chosen);

void add_live_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

void add_readings_command(CLI::App& app, std::function<int()>& chosen);

/// `command` is the whole command line as typed, for the result.
void add_reference_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

void add_references_command(CLI::App& app, std::function<int()>& chosen);

/// Adds the command; when it is chosen, `chosen` becomes what does it. `command` is the command line, for the results.
void add_shadows_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

void add_signals_command(CLI::App& app, std::function<int()>& chosen);

/// Adds the subcommand; chosen, it sets `chosen`, which gives 1 when a case fails.
void add_stability_command(CLI::App& app, std::function<int()>& chosen);

void add_storyboard_command(CLI::App& app, std::function<int()>& chosen);

/// `command` is the whole command line as typed, for the report.
void add_study_command(CLI::App& app, const std::vector<std::string>& command, std::function<int()>& chosen);

void add_techniques_command(CLI::App& app, std::function<int()>& chosen);

} // namespace fernlicht
