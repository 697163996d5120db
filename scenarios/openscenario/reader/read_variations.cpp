#include "scenarios/openscenario/osc_node.h"
#include "scenarios/openscenario/reader/read_storyboard.h"
#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

constexpr std::size_t most_cases = 10'000;
using Case = std::map<std::string, std::string>;

std::vector<Case> range_of(const OscNode& node, const std::string& parameter) {
    const OscNode range = node.require("Range");
    const double step = node.number("stepWidth"), low = range.number("lowerLimit"), high = range.number("upperLimit");
    if (!(step > 0.0) || !(high >= low) || (high - low) / step > static_cast<double>(most_cases))
        node.refuse("stepWidth", fmt::format("found steps of {} from {} to {}", step, low, high), "at most 10000 steps above 0");
    std::vector<Case> out;
    const auto steps = static_cast<int>(std::floor((high - low) / step + 1e-9));
    for (int i = 0; i <= steps; ++i)
        out.push_back({{parameter, fmt::format("{}", low + i * step)}});
    return out;
}

std::vector<Case> set_of(const OscNode& node, const std::string& parameter) {
    std::vector<Case> out;
    for (const OscNode& element : node.children("Element"))
        out.push_back({{parameter, element.text("value")}});
    return out;
}

std::vector<Case> distribution_of(const OscNode& node) {
    std::vector<Case> out;
    if (node.element() == "DeterministicSingleParameterDistribution") {
        const std::string parameter = node.text("parameterName");
        const OscNode kind = node.only("a distribution");
        if (kind.element() == "DistributionRange")
            out = range_of(kind, parameter);
        else if (kind.element() == "DistributionSet")
            out = set_of(kind, parameter);
        else
            kind.refuse("", "is not supported", "DistributionRange or DistributionSet");
    } else if (node.element() == "DeterministicMultiParameterDistribution") {
        for (const OscNode& set : node.require("ValueSetDistribution").children("ParameterValueSet")) {
            Case values;
            for (const OscNode& value : set.children("ParameterAssignment"))
                values[value.text("parameterRef")] = value.text("value");
            out.push_back(std::move(values));
        }
    } else {
        node.refuse("", "is not supported", "deterministic distributions");
    }
    if (out.empty())
        node.refuse("", "gives no value", "at least one");
    return out;
}

} // namespace

Variations read_variations(const std::filesystem::path& path, FilesRead& opened) {
    Reading reading;
    XmlFile file(path, reading.opened, "OpenSCENARIO", "an OpenSCENARIO file");
    const OscNode root(file, file.root(), reading.global, reading);
    const OscNode given = root.require("ParameterValueDistribution");
    Variations out;
    out.scenario = (path.parent_path() / given.require("ScenarioFile").text("filepath")).lexically_normal();
    const auto deterministic = given.find("Deterministic");
    if (!deterministic)
        given.only("Deterministic").refuse("", "is not supported: each run shall give the same results", "Deterministic");
    out.cases = {{}};
    for (const OscNode& node : deterministic->children()) {
        std::vector<Case> crossed;
        const std::vector<Case> values = distribution_of(node);
        if (out.cases.size() * values.size() > most_cases)
            node.refuse("", fmt::format("makes {} cases", out.cases.size() * values.size()), "at most 10000");
        for (const Case& before : out.cases)
            for (const Case& value : values) {
                crossed.push_back(before);
                for (const auto& [name, text] : value)
                    crossed.back()[name] = text;
            }
        out.cases = std::move(crossed);
    }
    opened.insert(opened.end(), reading.opened.begin(), reading.opened.end());
    return out;
}

} // namespace fernlicht::osc
