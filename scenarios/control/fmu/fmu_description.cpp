#include "scenarios/control/fmu/fmu_description.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {
namespace {

constexpr double max_array = 1.0e6;

struct FmuElement {
    std::string_view name;
    int version;
    FmuType type;
};

constexpr std::array<FmuElement, 21> fmu_elements{
    {{"Real", 2, FmuType::float64},      {"Integer", 2, FmuType::int32}, {"Enumeration", 2, FmuType::int32},
     {"Boolean", 2, FmuType::int32},     {"String", 2, FmuType::text},   {"Float64", 3, FmuType::float64},
     {"Float32", 3, FmuType::float32},   {"Int8", 3, FmuType::int8},     {"UInt8", 3, FmuType::uint8},
     {"Int16", 3, FmuType::int16},       {"UInt16", 3, FmuType::uint16}, {"Int32", 3, FmuType::int32},
     {"UInt32", 3, FmuType::uint32},     {"Int64", 3, FmuType::int64},   {"UInt64", 3, FmuType::uint64},
     {"Enumeration", 3, FmuType::int64}, {"Boolean", 3, FmuType::flag},  {"String", 3, FmuType::text},
     {"Binary", 3, FmuType::none},       {"Clock", 3, FmuType::none},    {"", 0, FmuType::none}}};

const FmuElement& element_named(std::string_view name, int version) {
    return *std::ranges::find_if(fmu_elements,
                                 [&](const FmuElement& of) { return of.name.empty() || (of.name == name && of.version == version); });
}

std::map<std::string, FmuUnit> read_units(const XmlFile& file) {
    std::map<std::string, FmuUnit> units;
    for (const pugi::xml_node node : file.root().child("UnitDefinitions").children("Unit")) {
        FmuUnit unit;
        unit.name = node.attribute("name").as_string();
        if (const pugi::xml_node base = node.child("BaseUnit")) {
            unit.known = true;
            unit.factor = file.number(base, "factor", 1.0);
            unit.offset = file.number(base, "offset", 0.0);
            unit.metres = file.integer(base, "m", 0);
            unit.seconds = file.integer(base, "s", 0);
            unit.candelas = file.integer(base, "cd", 0);
            unit.radians = file.integer(base, "rad", 0);
            for (const char* const other : {"kg", "A", "K", "mol"})
                unit.others = unit.others || file.integer(base, other, 0) != 0;
            if (unit.factor == 0.0)
                file.refuse(base, "factor", "found 0", "a number that is not 0");
        }
        units[unit.name] = unit;
    }
    return units;
}

/// Units of types that are declared once for many variables, by their names.
std::map<std::string, std::string> read_type_units(const XmlFile& file, int version) {
    std::map<std::string, std::string> units;
    for (const pugi::xml_node node : file.root().child("TypeDefinitions").children())
        units[node.attribute("name").as_string()] = (version == 2 ? node.child("Real") : node).attribute("unit").as_string();
    return units;
}

/// As xs:double has them, beside numbers.
bool is_fmu_number(std::string_view word, FmuType type) {
    return to_number(word) ||
           ((type == FmuType::float64 || type == FmuType::float32) && (word == "INF" || word == "-INF" || word == "+INF" || word == "NaN"));
}

/// Start values are of their type, as many as an array has.
void check_start(const XmlFile& file, pugi::xml_node node, const FmuVariable& variable) {
    const std::string start = node.attribute("start").as_string();
    if (start.empty() || variable.type == FmuType::text || variable.type == FmuType::none)
        return;
    std::size_t found = 0;
    for (std::size_t at = 0, end = 0; at < start.size(); at = end) {
        at = start.find_first_not_of(" \t\r\n", at);
        if (at == std::string::npos)
            break;
        end = std::min(start.find_first_of(" \t\r\n", at), start.size());
        const std::string word = start.substr(at, end - at);
        ++found;
        if (variable.element == "Boolean" ? word != "true" && word != "false" && word != "0" && word != "1"
                                          : !is_fmu_number(word, variable.type))
            file.refuse(node, "start", fmt::format("found '{}' of variable '{}'", printable(word), printable(variable.name)),
                        fmt::format("a value of type {}", variable.element));
    }
    if (found != variable.count.value_or(1) && found != 1)
        file.refuse(node, "start", fmt::format("found {} values of variable '{}'", found, printable(variable.name)),
                    fmt::format("{}", variable.count.value_or(1)));
}

std::optional<std::size_t> read_count(const XmlFile& file, pugi::xml_node node) {
    if (!node.child("Dimension"))
        return std::nullopt;
    double count = 1.0;
    for (const pugi::xml_node dimension : node.children("Dimension")) {
        // By a structural parameter: it keeps its start value.
        const pugi::xml_attribute parameter = dimension.attribute("valueReference");
        const pugi::xml_node sized =
            parameter ? file.root().child("ModelVariables").find_child_by_attribute("valueReference", parameter.value()) : dimension;
        if (!sized)
            file.refuse(dimension, "valueReference", "a dimension that no variable gives", "one with a start value");
        const double size = file.number(sized, "start");
        count *= size;
        if (!(size >= 1.0) || size != std::floor(size) || count > max_array)
            file.refuse(sized, "start", fmt::format("found {} as a dimension", size),
                        fmt::format("a whole number from 1, at most {} values in all", max_array));
    }
    return static_cast<std::size_t>(count);
}

std::uint32_t read_reference(const XmlFile& file, pugi::xml_node node) {
    const std::optional<double> number = to_number(node.attribute("valueReference").as_string());
    if (!number || !(*number >= 0.0 && *number <= 4294967295.0) || *number != static_cast<double>(static_cast<std::uint32_t>(*number)))
        file.refuse(node, "valueReference", fmt::format("found '{}'", printable(node.attribute("valueReference").as_string())),
                    "a whole number below 2^32");
    return static_cast<std::uint32_t>(*number);
}

bool is_c_name(const std::string& name) {
    return !name.empty() && std::ranges::all_of(name, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

} // namespace

FmuDescription read_fmu_description(const std::filesystem::path& path, const std::string& xml) {
    const XmlFile file(path, xml, "fmiModelDescription", "the description of an FMU");
    const pugi::xml_node root = file.root();
    FmuDescription description;
    const std::string version = root.attribute("fmiVersion").as_string();
    if (version != "2.0" && version != "3.0")
        file.refuse(root, "fmiVersion", fmt::format("found '{}'", printable(version)), "2.0 or 3.0");
    description.version = version == "2.0" ? 2 : 3;
    const bool is_2 = description.version == 2;
    description.name = root.attribute("modelName").as_string();
    const char* const token = is_2 ? "guid" : "instantiationToken";
    description.token = root.attribute(token).as_string();
    if (description.token.empty())
        file.refuse(root, token, "is missing", "what its binary is compared with");
    const pugi::xml_node co_simulation = root.child("CoSimulation");
    if (!co_simulation)
        file.refuse(root, "", root.child("ModelExchange") ? "an FMU for model exchange alone" : "no CoSimulation", "co-simulation");
    if (co_simulation.attribute("needsExecutionTool").as_bool())
        file.refuse(co_simulation, "needsExecutionTool", "found 'true'", "an FMU that runs without the tool that made it");
    description.model = co_simulation.attribute("modelIdentifier").as_string();
    if (!is_c_name(description.model))
        file.refuse(co_simulation, "modelIdentifier", fmt::format("found '{}'", printable(description.model)),
                    "letters, digits and underscores");
    const std::map<std::string, FmuUnit> units = read_units(file);
    const std::map<std::string, std::string> type_units = read_type_units(file, description.version);
    for (const pugi::xml_node node : root.child("ModelVariables").children()) {
        if (node.type() != pugi::node_element)
            continue;
        const pugi::xml_node typed =
            is_2 ? node.find_child([](pugi::xml_node child) { return !element_named(child.name(), 2).name.empty(); }) : node;
        const FmuElement& element = element_named(typed.name(), description.version);
        FmuVariable variable;
        variable.name = node.attribute("name").as_string();
        if (variable.name.empty() || element.name.empty())
            file.refuse(node, "",
                        variable.name.empty() ? "a variable without a name" : fmt::format("no type of '{}'", printable(variable.name)),
                        is_2 ? "Real, Integer, Boolean, String or Enumeration" : "a variable of FMI 3.0");
        variable.reference = read_reference(file, node);
        variable.causality = file.text(node, "causality", "local");
        variable.element = element.name;
        variable.type = element.type;
        if (variable.causality == "input" || variable.causality == "output") { // others may have any size
            variable.count = read_count(file, node);
            check_start(file, typed, variable);
        } else if (node.child("Dimension")) {
            variable.count = 0;
        }
        std::string unit = typed.attribute("unit").as_string();
        if (const auto declared = type_units.find(typed.attribute("declaredType").as_string());
            unit.empty() && declared != type_units.end())
            unit = declared->second;
        if (const auto known = units.find(unit); known != units.end())
            variable.unit = known->second;
        variable.unit.name = unit;
        description.variables.push_back(std::move(variable));
    }
    return description;
}

} // namespace fernlicht
