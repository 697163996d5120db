#include "scenarios/roads/opendrive/opendrive_parts.h"

#include "scenarios/values/errors.h"

#include <fmt/format.h>

namespace fernlicht {

OpenDriveXml::OpenDriveXml(const std::filesystem::path& path, FilesRead& opened)
    : XmlFile(path, opened, "OpenDRIVE", "an OpenDRIVE file") {}

std::string named(std::string_view element, const std::string& id) { return fmt::format("{} '{}'", element, printable(id)); }

} // namespace fernlicht
