#include "scenarios/yaml/library_file.h"

#include "scenarios/values/files.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>

namespace fernlicht {

std::vector<std::string> library_names(const std::string& kind) {
    std::vector<std::string> names;
    std::error_code none; // without the library there are none
    for (const auto& entry : std::filesystem::directory_iterator(shipped_path(kind + 's'), none))
        if (entry.path().extension() == ".yaml")
            names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    return names;
}

std::filesystem::path library_file(const std::string& kind, const std::string& given, const std::filesystem::path& folder,
                                   const InputError::Where& where) {
    const std::filesystem::path here = std::filesystem::absolute(folder / given).lexically_normal();
    std::error_code ignored; // what cannot be looked at is not there
    if (std::filesystem::is_regular_file(here, ignored))
        return here;
    const std::vector<std::string> names = library_names(kind);
    if (std::ranges::find(names, given) != names.end())
        return std::filesystem::absolute(shipped_path(fmt::format("{}s/{}.yaml", kind, given))).lexically_normal();
    throw InputError(where, fmt::format("there is no file {} and no {} of that name", printable(here.string(), 400), kind),
                     fmt::format("a {} file, or {}", kind, one_of_names(given, names)));
}

} // namespace fernlicht
