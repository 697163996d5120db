// An OpenDRIVE file as XML.
#pragma once

#include "scenarios/values/xml_file.h"

namespace fernlicht {

class OpenDriveXml : public XmlFile {
  public:
    /// Throws InputError (xml_file.h), and where the root is not OpenDRIVE.
    OpenDriveXml(const std::filesystem::path& path, FilesRead& opened);
};

/// Words for messages: "road '12'".
std::string named(std::string_view element, const std::string& id);

} // namespace fernlicht
