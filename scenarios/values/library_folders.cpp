#include "scenarios/values/library_folders.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <sstream>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name, const std::string& otherwise = {}) {
    const char* const value = std::getenv(name);
    return value && *value ? value : otherwise;
}

/// scenarios/library in the nearest folder above that has it.
void add_above(fs::path folder, std::vector<fs::path>& found) {
    std::error_code ignored;
    for (; !folder.empty(); folder = folder.parent_path()) {
        if (fs::is_directory(folder / "scenarios/library", ignored)) {
            found.push_back(folder / "scenarios/library");
            return;
        }
        if (folder == folder.parent_path())
            return;
    }
}

} // namespace

std::vector<fs::path> library_folders() {
    std::error_code ignored;
    std::vector<fs::path> folders;
    if (const std::string named = variable("FERNLICHT_DATA"); !named.empty()) {
        if (!fs::is_directory(named, ignored))
            throw InputError({{}, 0, 0, "FERNLICHT_DATA"}, "found '" + printable(named, 400) + "', which is no folder",
                             "a folder with drives, lamps and roads, as scenarios/library");
        folders.push_back(fs::absolute(named).lexically_normal());
    }
    const fs::path program = program_folder();
    folders.push_back(program.parent_path() / "share/fernlicht");
    add_above(program, folders);
    add_above(fs::current_path(ignored), folders);
    const std::string home = variable("HOME");
    std::istringstream shared(variable("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share") + ":" +
                              variable("XDG_DATA_DIRS", "/usr/local/share:/usr/share"));
    for (std::string folder; std::getline(shared, folder, ':');)
        if (folder.starts_with('/')) // the XDG specification has relative ones ignored
            folders.push_back((fs::path(folder) / "fernlicht").lexically_normal());
    std::vector<fs::path> each;
    for (fs::path& folder : folders)
        if (std::ranges::find(each, folder) == each.end())
            each.push_back(std::move(folder));
    return each;
}

fs::path shipped_path(const fs::path& name) {
    std::error_code ignored;
    for (const fs::path& folder : library_folders())
        if (fs::exists(folder / name, ignored))
            return folder / name;
    return {};
}

fs::path shipped_file(const fs::path& name, const std::string& flag) {
    if (fs::path found = shipped_path(name); !found.empty())
        return found;
    if (const fs::path beside = shipped_path(name.parent_path()); name.has_parent_path() && !beside.empty()) {
        const std::string nearest = nearest_shipped(name);
        throw InputError({{}, 0, 0, flag}, "found 'fernlicht:" + printable(name.string(), 400) + "', which is no shipped file",
                         nearest.empty() ? "one in " + printable(beside.string(), 400) : "one as 'fernlicht:" + nearest + "'");
    }
    throw InputError({{}, 0, 0, flag}, fmt::format("found no {} in {}", name.string(), library_places()),
                     "fernlicht's data there, FERNLICHT_DATA to name its folder, or another file here");
}

std::string nearest_shipped(const fs::path& name) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const fs::path& folder : library_folders())
        for (const fs::directory_entry& entry : fs::directory_iterator(folder / name.parent_path(), ignored))
            names.push_back((name.parent_path() / entry.path().filename()).string());
    std::ranges::sort(names); // folders are in no order
    return nearest_name(name.string(), names);
}

std::string library_places() {
    std::string told;
    for (const fs::path& folder : library_folders())
        told += printable(folder.string(), 400) + ", ";
    return told + "nor scenarios/library above the program or here";
}

} // namespace fernlicht
