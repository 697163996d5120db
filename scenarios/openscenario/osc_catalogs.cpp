#include "scenarios/openscenario/osc_node.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace fernlicht::osc {
namespace {

namespace fs = std::filesystem;

using Entries = std::map<std::pair<std::string, std::string>, Reading::Entry>;

/// `by_file`: the same entries under the file's name, as which esmini finds them.
void read_catalog(const fs::path& path, Reading& reading, Entries& by_file) {
    try {
        const auto file = std::make_shared<XmlFile>(path, reading.opened, "OpenSCENARIO", "an OpenSCENARIO file");
        for (const pugi::xml_node catalog : file->root().children("Catalog"))
            for (const pugi::xml_node entry : catalog.children())
                if (entry.type() == pugi::node_element) {
                    const Reading::Entry found{file.get(), entry};
                    reading.entries.try_emplace({catalog.attribute("name").value(), entry.attribute("name").value()}, found);
                    by_file.try_emplace({path.stem().string(), entry.attribute("name").value()}, found);
                }
        reading.files.push_back(file);
    } catch (const InputError& error) {
        reading.catalog_notes.emplace_back(error.what());
    }
}

/// Files by name, so that the same entry is found on every machine; the name that a catalog has itself comes before its file's.
void read_folders(Reading& reading) {
    Entries by_file;
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
            read_catalog(file, reading, by_file);
    }
    reading.entries.merge(by_file);
}

/// "'A', 'B' and 3 more"
std::string catalogs_found(const Reading& reading) {
    std::set<std::string> names;
    for (const auto& [key, unused] : reading.entries)
        names.insert(key.first);
    std::string out;
    std::size_t told = 0;
    for (const std::string& name : names) {
        if (told == 12)
            return out + fmt::format(" and {} more", names.size() - told);
        out += fmt::format("{}'{}'", told++ == 0 ? "" : ", ", printable(name));
    }
    return out;
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
                             (reading.entries.empty() ? "a catalog in the folders of CatalogLocations, where there is none"
                                                      : "a catalog in the folders of CatalogLocations: " + catalogs_found(reading)) +
                                 why);
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
            std::string value = assignment.text("value");
            assignment.count_bytes("value", value.size());
            values[parameter] = std::move(value);
        }
    return found.with(std::make_shared<Scope>(Scope{std::move(values), reading.global}));
}

OpenEntry::OpenEntry(const OscNode& node) : reading_(node.reading()) {
    constexpr std::size_t max_open = 64, max_inner = 10'000; // files of others have one within another
    std::vector<Reading::Entry>& open = reading_.open_entries;
    /// "'a' > 'b' > 'c'", the node last; of a long way the first and the last names.
    const auto way = [&](auto from) {
        std::string names;
        const std::ptrdiff_t count = open.end() - from;
        for (std::ptrdiff_t i = 0; i < count; ++i)
            if (i < 4 || i + 2 >= count)
                names += fmt::format("'{}' > ", printable(from[i].node.attribute("name").value()));
            else if (i == 4)
                names += "... > ";
        return fmt::format("{}'{}'", names, printable(node.name()));
    };
    if (const auto again = std::ranges::find(open, node.node(), &Reading::Entry::node); again != open.end())
        node.refuse("", "leads back to itself: " + way(again), "positions that do not need it");
    if (open.size() == max_open)
        node.refuse("", "lies on a way from one to the next: " + way(open.begin()), fmt::format("{} at most", max_open));
    if (!open.empty() && ++reading_.inner_entries > max_inner)
        node.refuse("",
                    fmt::format("is the {}th route or trajectory that lies within others: {}", reading_.inner_entries, way(open.begin())),
                    fmt::format("{} at most in all", max_inner));
    open.push_back({&node.xml(), node.node()});
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
