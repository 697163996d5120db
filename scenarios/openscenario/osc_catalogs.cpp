#include "scenarios/openscenario/osc_catalogs.h"

#include "scenarios/openscenario/expression.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht::osc {
namespace {

namespace fs = std::filesystem;

void read_catalog(const fs::path& path, Reading& reading) {
    try {
        const auto file = std::make_shared<XmlFile>(path, reading.opened, "OpenSCENARIO", "an OpenSCENARIO file");
        for (const pugi::xml_node catalog : file->root().children("Catalog"))
            for (const pugi::xml_node entry : catalog.children())
                if (entry.type() == pugi::node_element)
                    reading.entries.try_emplace({catalog.attribute("name").value(), entry.attribute("name").value()},
                                                Reading::Entry{file.get(), entry});
        reading.files.push_back(file);
    } catch (const InputError& error) {
        reading.catalog_notes.emplace_back(error.what());
    }
}

/// Files by name, so that the same entry is found on every machine.
void read_folders(Reading& reading) {
    for (const fs::path& folder : std::exchange(reading.catalog_folders, {})) {
        std::error_code failed;
        std::vector<fs::path> files;
        if (fs::is_regular_file(folder, failed))
            files.push_back(folder);
        for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
            if (entry->path().extension() == ".xosc")
                files.push_back(entry->path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files)
            read_catalog(file, reading);
    }
}

} // namespace

void note_catalog_folders(const OscNode& scenario) {
    const auto locations = scenario.find("CatalogLocations");
    if (!locations)
        return;
    for (const OscNode& kind : locations->children())
        if (const auto directory = kind.find("Directory"))
            scenario.reading().catalog_folders.push_back((scenario.file().parent_path() / directory->text("path")).lexically_normal());
}

OscNode catalog_entry(const OscNode& reference) {
    Reading& reading = reference.reading();
    read_folders(reading);
    const std::string catalog = reference.text("catalogName"), name = reference.text("entryName");
    const auto entry = reading.entries.find({catalog, name});
    if (entry == reading.entries.end()) {
        std::vector<std::string> names;
        for (const auto& [key, unused] : reading.entries)
            if (key.first == catalog)
                names.push_back(key.second);
        const std::string why = reading.catalog_notes.empty() ? "" : fmt::format(" ({})", reading.catalog_notes.front());
        if (names.empty())
            reference.refuse("catalogName", fmt::format("found '{}'", printable(catalog)),
                             "a catalog in the folders of CatalogLocations" + why);
        const std::string nearest = nearest_name(name, names);
        reference.refuse("entryName", fmt::format("found '{}'", printable(name)),
                         nearest.empty() ? fmt::format("one of the {} entries of catalog '{}'", names.size(), printable(catalog))
                                         : fmt::format("an entry of catalog '{}', perhaps '{}'", printable(catalog), nearest));
    }
    const OscNode found(*entry->second.file, entry->second.node, reading.global, reading);
    std::map<std::string, std::string> values = found.declared();
    if (const auto assignments = reference.find("ParameterAssignments"))
        for (const OscNode& assignment : assignments->children("ParameterAssignment")) {
            std::string parameter = assignment.node().attribute("parameterRef").value();
            if (parameter.starts_with('$')) // as files of 1.0 write it
                parameter.erase(0, 1);
            values[parameter] = assignment.text("value");
        }
    return found.with(std::make_shared<Scope>(Scope{std::move(values), reading.global}));
}

std::optional<OscNode> own_or_catalog(const OscNode& node, const char* element) {
    if (auto own = node.find(element))
        return own->with_declared();
    if (const auto reference = node.find("CatalogReference")) {
        OscNode entry = catalog_entry(*reference);
        if (entry.element() != element)
            reference->refuse("entryName", fmt::format("found a {}", entry.element()), fmt::format("a {}", element));
        return entry;
    }
    return {};
}

} // namespace fernlicht::osc
