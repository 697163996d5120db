// What tests of all folders share: files in a folder of one's own, and what a refusal says.
#pragma once

#include "scenarios/values/errors.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fernlicht::tests {

/// New and empty; own_folder.cpp removes it.
inline std::filesystem::path new_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "trial-XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw std::runtime_error("no folder " + name);
    return name;
}

/// A file of this name with this text, in a folder of its own where none is given.
inline std::filesystem::path written(const std::string& name, const std::string& text, const std::filesystem::path& folder = new_folder()) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
}

/// Files of these extensions below a folder, by name; none where it does not exist.
inline std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder, const std::set<std::string>& extensions) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::is_directory(folder))
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
            if (extensions.contains(entry.path().extension().string()))
                files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// What an action is refused with.
template <class Error = InputError, class Action> std::string refusal_of(const Action& action, const char* otherwise = "not refused") {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return otherwise;
}

/// Lines of a file: of {"seed", "3|-1"} "seed: 3" and "seed: -1"; of {"", "a|b"} "a" and "b".
inline std::vector<std::string> each_of(std::initializer_list<std::pair<std::string, std::string>> keys) {
    std::vector<std::string> lines;
    for (const auto& [key, values] : keys)
        for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
            end = values.find('|', at);
            lines.push_back((key.empty() ? "" : key + ": ") + values.substr(at, end - at));
        }
    return lines;
}

/// Notes of what was read, a line each.
inline std::string all_notes(const auto& read) {
    std::string out;
    for (const std::string& note : read.notes)
        out += note + "\n";
    return out;
}

} // namespace fernlicht::tests
