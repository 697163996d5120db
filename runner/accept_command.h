// `fernlicht accept RUN_FOLDER [--to FOLDER]`: take a run's results as what later runs are compared with. Judges nothing.
#pragma once

#include <filesystem>
#include <functional>

namespace CLI {
class App;
}

namespace fernlicht {

void add_accept_command(CLI::App& app, std::function<int()>& chosen);

struct Accepted {
    std::size_t drives = 0, frames = 0, readings = 0;
};
/// Readings (times left out) and captured EXR frames of every lamp set of every drive. Throws InputError for a folder without a complete
/// run, DeviceError when the references cannot be written; what was accepted before then still holds.
Accepted accept_run(const std::filesystem::path& run_folder, const std::filesystem::path& references_folder);

} // namespace fernlicht
