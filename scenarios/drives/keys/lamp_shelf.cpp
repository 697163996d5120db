#include "scenarios/drives/keys/lamp_sets.h"

#include "scenarios/values/errors.h"

#include <system_error>
#include <unistd.h>

namespace fernlicht {
void check_file(const std::filesystem::path& path, const YamlEntry& asked_by) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    const std::string name = printable(path.string(), 400);
    if (status.type() == std::filesystem::file_type::not_found)
        asked_by.refuse("there is no file " + name, "a file (relative paths start at this file's folder)");
    if (error)
        asked_by.refuse(name + " cannot be read: " + error.message(), "a readable file");
    if (status.type() != std::filesystem::file_type::regular)
        asked_by.refuse(name + " is not a regular file", "a file");
    if (::access(path.c_str(), R_OK) != 0)
        asked_by.refuse(name + " cannot be read: " + std::generic_category().message(errno), "a readable file");
}

std::shared_ptr<const LampFile> LampShelf::lamp(const std::filesystem::path& path, const LampReadOptions& options,
                                                const YamlEntry* asked_by) {
    for (const LampSource& source : sources_)
        if (source.path == path && source.options == options)
            return source.file;
    if (asked_by)
        check_file(path, *asked_by);
    auto file = std::make_shared<const LampFile>(read_lamp(path, options));
    opened_.insert(opened_.end(), file->opened.begin(), file->opened.end());
    sources_.push_back({path, options, file});
    return file;
}

LampColour LampShelf::spectrum(const std::filesystem::path& path, const YamlEntry& asked_by) {
    if (const auto known = spectra_.find(path); known != spectra_.end())
        return known->second;
    check_file(path, asked_by);
    return spectra_.emplace(path, read_spectrum(path, opened_)).first->second;
}

} // namespace fernlicht
