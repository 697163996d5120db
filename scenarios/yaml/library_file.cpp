#include "scenarios/yaml/library_file.h"

#include "scenarios/values/library_folders.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <system_error>

namespace fernlicht {

namespace {

std::string folder_of(const std::string& kind) { return kind == "study" ? "studies" : kind + 's'; }

} // namespace

std::vector<std::string> library_names(const std::string& kind) {
    std::set<std::string> names;
    std::error_code none; // where there is no such folder
    for (const std::filesystem::path& folder : library_folders())
        for (const auto& entry : std::filesystem::directory_iterator(folder / folder_of(kind), none))
            if (entry.path().extension() == ".yaml")
                names.insert(entry.path().stem().string());
    return {names.begin(), names.end()};
}

std::filesystem::path library_file(const std::string& kind, const std::string& given, const std::filesystem::path& folder,
                                   const InputError::Where& where) {
    std::filesystem::path here = std::filesystem::absolute(folder / given).lexically_normal();
    std::error_code ignored; // what cannot be looked at is not there
    if (std::filesystem::is_regular_file(here, ignored))
        return here;
    const std::vector<std::string> names = library_names(kind);
    if (std::ranges::find(names, given) != names.end())
        return std::filesystem::absolute(shipped_path(fmt::format("{}/{}.yaml", folder_of(kind), given))).lexically_normal();
    throw InputError(
        where,
        fmt::format("there is no file {} and no {} of that name{}", printable(here.string(), 400), kind,
                    names.empty() ? " in " + library_places() : ""),
        fmt::format("a {} file{}", kind,
                    names.empty() ? ", or FERNLICHT_DATA to name the folder of fernlicht's own" : ", or " + one_of_names(given, names)));
}

} // namespace fernlicht
