#include "scenarios/roads/signal_faces.h"

#include "scenarios/values/xml_file.h"

namespace fernlicht {

std::map<std::pair<std::string, std::string>, SignalFace> read_signal_faces(const std::filesystem::path& path) {
    FilesRead opened;
    const XmlFile xml(path, opened, "OpenDRIVE", "an OpenDRIVE file");
    std::map<std::pair<std::string, std::string>, SignalFace> faces;
    for (const pugi::xml_node road : xml.root().children("road"))
        for (const pugi::xml_node node : road.child("signals").children("signal"))
            faces.insert_or_assign({xml.text(road, "id"), xml.text(node, "id")},
                                   SignalFace{xml.text(node, "country"), xml.text(node, "type"), xml.text(node, "subtype"),
                                              xml.text(node, "value"), xml.text(node, "text")});
    return faces;
}

} // namespace fernlicht
