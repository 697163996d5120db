#include "scenarios/openscenario/reader/read_storyboard.h"

#include "scenarios/openscenario/osc_node.h"
#include "scenarios/openscenario/reader/read_parts.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht::osc {
namespace {

namespace fs = std::filesystem;

std::optional<Action> read_action(const OscNode& node) {
    const auto of = [&](auto what) { return what ? std::optional(Action{node.name(), std::move(*what), node.line()}) : std::nullopt; };
    if (const auto one = node.find("PrivateAction"))
        return of(read_private_action(*one));
    if (const auto all = node.find("GlobalAction"))
        return of(read_global_action(*all));
    const OscNode other = node.only("PrivateAction or GlobalAction");
    other.unsupported(fmt::format("the action {}", printable(other.element())));
    return {};
}

int executions_of(const OscNode& node) {
    const int count = node.whole("maximumExecutionCount");
    if (count < 0)
        node.refuse("maximumExecutionCount", fmt::format("found {}", count), "a count not below 0");
    return count;
}

Event read_event(const OscNode& node) {
    Event event;
    event.name = node.name();
    const std::size_t priority = node.choice("priority", {"overwrite", "override", "skip", "parallel"});
    event.priority = priority < 2 ? Priority::overwrite : priority == 2 ? Priority::skip : Priority::parallel;
    event.executions = node.has("maximumExecutionCount") ? executions_of(node) : 1;
    for (const OscNode& action : node.children("Action"))
        if (auto read = read_action(action))
            event.actions.push_back(std::move(*read));
    event.start = read_trigger(node, "StartTrigger");
    return event;
}

Maneuver read_maneuver(const OscNode& node) {
    Maneuver maneuver;
    maneuver.name = node.name();
    for (const OscNode& event : node.children("Event"))
        maneuver.events.push_back(read_event(event));
    return maneuver;
}

using Selections = std::map<std::string, std::vector<std::string>>;

ManeuverGroup read_group(const OscNode& node, const Selections& selections) {
    ManeuverGroup group;
    group.name = node.name();
    group.executions = executions_of(node);
    if (const auto actors = node.find("Actors")) {
        group.select_triggering = actors->flag_or("selectTriggeringEntities", false);
        for (const OscNode& actor : actors->children("EntityRef")) {
            const std::string name = actor.entity("entityRef");
            if (const auto selection = selections.find(name); selection != selections.end())
                group.actors.insert(group.actors.end(), selection->second.begin(), selection->second.end());
            else
                group.actors.push_back(name);
        }
    }
    for (const OscNode& child : node.children()) {
        if (child.element() == "Maneuver") {
            group.maneuvers.push_back(read_maneuver(child.with_declared()));
        } else if (child.element() == "CatalogReference") {
            const OscNode entry = catalog_entry(child);
            if (entry.element() != "Maneuver")
                child.refuse("entryName", fmt::format("found a {}", entry.element()), "a Maneuver");
            group.maneuvers.push_back(read_maneuver(entry));
        }
    }
    return group;
}

Story read_story(const OscNode& plain, const Selections& selections) {
    const OscNode node = plain.with_declared();
    Story story;
    story.name = node.name();
    for (const OscNode& child : node.children("Act")) {
        Act act;
        act.name = child.name();
        for (const OscNode& group : child.children("ManeuverGroup"))
            act.groups.push_back(read_group(group, selections));
        act.start = read_trigger(child, "StartTrigger");
        act.stop = read_trigger(child, "StopTrigger");
        story.acts.push_back(std::move(act));
    }
    return story;
}

void read_init(const OscNode& storyboard, const Selections& selections, Storyboard& out) {
    const auto init = storyboard.find("Init");
    const auto actions = init ? init->find("Actions") : std::nullopt;
    if (!actions)
        return;
    for (const OscNode& child : actions->children()) {
        if (child.element() == "GlobalAction") {
            if (auto what = read_global_action(child))
                out.init.push_back({{}, {child.element(), std::move(*what), child.line()}});
        } else if (child.element() == "Private") {
            const std::string name = child.entity("entityRef");
            const auto selection = selections.find(name);
            const std::vector<std::string> names = selection == selections.end() ? std::vector{name} : selection->second;
            for (const OscNode& action : child.children("PrivateAction"))
                if (auto what = read_private_action(action))
                    for (const std::string& entity : names)
                        out.init.push_back({entity, {action.element(), *what, action.line()}});
        } else {
            child.unsupported(fmt::format("the action {}", printable(child.element())));
        }
    }
}

void read_network(const OscNode& scenario, const StoryboardOptions& options, Storyboard& out) {
    out.road_file = options.road;
    const auto network = scenario.find("RoadNetwork");
    if (!network)
        return;
    if (const auto logic = network->find("LogicFile"); options.road.empty() && logic && !logic->text("filepath").empty()) {
        const fs::path named = (fs::absolute(out.file).parent_path() / logic->text("filepath")).lexically_normal();
        out.road_file = find_road(named, options.road_folders);
        if (out.road_file.empty())
            logic->refuse("filepath", fmt::format("found '{}', where there is no file", printable(logic->text("filepath"), 200)),
                          options.road_folders.empty() ? "a road file there, a folder for --road-folder that holds it, or another by --road"
                                                       : "a road file there or in the road folders, or another by --road");
    }
    const auto signals = network->find("TrafficSignals");
    for (const OscNode& node : signals ? signals->children("TrafficSignalController") : std::vector<OscNode>{}) {
        TrafficController controller{node.text("name"), node.number_or("delay", 0.0), node.text_or("reference", ""), {}};
        for (const OscNode& phase : node.children("Phase")) {
            controller.phases.push_back({phase.text("name"), phase.number("duration"), {}});
            for (const OscNode& state : phase.children("TrafficSignalState"))
                controller.phases.back().states.emplace_back(state.text("trafficSignalId"), state.text("state"));
        }
        out.signals.push_back(std::move(controller));
    }
}

void read_header(const OscNode& scenario, Storyboard& out) {
    const OscNode header = scenario.require("FileHeader");
    out.major = header.whole("revMajor");
    out.minor = header.whole("revMinor");
    out.description = header.text_or("description", "");
    if (out.major != 1 || out.minor < 0 || out.minor > 3)
        header.refuse("revMajor", fmt::format("found version {}.{}", out.major, out.minor), "OpenSCENARIO XML 1.0 to 1.3");
    for (const char* other : {"Catalog", "ParameterValueDistribution"})
        if (const auto node = scenario.find(other))
            node->refuse("", "is not a scenario",
                         std::string_view(other) == "Catalog" ? "a Storyboard; catalogs are read by the scenarios that name them"
                                                              : "a Storyboard; fernlicht storyboard plays all cases of a variation file");
}

/// Values from outside come before those of the file.
OscNode with_parameters(const OscNode& scenario, const StoryboardOptions& options, Storyboard& out) {
    out.parameters = scenario.declared();
    for (const auto& [name, value] : options.parameters) {
        if (!out.parameters.contains(name))
            scenario.refuse("ParameterDeclarations", fmt::format("has no parameter '{}'", printable(name)), "one that the file declares");
        out.parameters[name] = value;
    }
    scenario.reading().global = std::make_shared<Scope>(Scope{out.parameters, nullptr});
    OscNode with = scenario.with(scenario.reading().global);
    if (const auto list = with.find("VariableDeclarations"))
        for (const OscNode& variable : list->children("VariableDeclaration"))
            out.variables[variable.text("name")] = variable.text_or("value", "");
    return with;
}

void refuse_unsupported(const Reading& reading) {
    const auto& first = reading.unsupported.front();
    std::string found = fmt::format("{} is not supported", first.what);
    if (const std::size_t more = reading.unsupported.size() - 1; more > 0) {
        found += fmt::format(" (and {} more:", more);
        for (std::size_t i = 1; i <= std::min<std::size_t>(more, 5); ++i)
            found += fmt::format("{} line {} {}", i == 1 ? "" : ",", reading.unsupported[i].line, reading.unsupported[i].what);
        found += more > 5 ? ", ...)" : ")";
    }
    throw InputError({first.file, first.line, 0, first.element}, found, "a scenario without it, or --lenient to go on without it");
}

} // namespace

fs::path find_road(const fs::path& named, const std::vector<fs::path>& folders) {
    std::error_code failed;
    if (fs::is_regular_file(named, failed))
        return named;
    if (!named.has_extension()) // some name a town, not a file
        return find_road(fs::path(named) += ".xodr", folders);
    for (const fs::path& folder : folders)
        for (fs::path tail = named.relative_path(); !tail.empty();) {
            if (fs::is_regular_file(folder / tail, failed))
                return folder / tail;
            fs::path shorter;
            for (auto part = std::next(tail.begin()); part != tail.end(); ++part)
                shorter /= *part;
            tail = shorter;
        }
    return {};
}

Storyboard read_storyboard(const fs::path& path, const StoryboardOptions& options) {
    Reading reading;
    Storyboard out;
    out.file = path;
    const auto file = std::make_shared<XmlFile>(path, reading.opened, "OpenSCENARIO", "an OpenSCENARIO file");
    reading.files.push_back(file);
    const OscNode plain(*file, file->root(), reading.global, reading);
    read_header(plain, out);
    const OscNode scenario = with_parameters(plain, options, out);
    note_catalog_folders(scenario);
    ReadEntities entities = read_entities(scenario);
    out.entities = std::move(entities.entities);
    const OscNode storyboard = scenario.require("Storyboard");
    read_init(storyboard, entities.selections, out);
    for (const OscNode& story : storyboard.children("Story"))
        out.stories.push_back(read_story(story, entities.selections));
    out.stop = read_trigger(storyboard, "StopTrigger");
    read_network(scenario, options, out);
    if (!reading.unsupported.empty() && !options.lenient)
        refuse_unsupported(reading);
    out.notes = std::move(reading.notes);
    for (const auto& left : reading.unsupported)
        out.notes.push_back(
            fmt::format("{}:{}: {}: {} is not supported and left out", left.file.string(), left.line, left.element, left.what));
    out.opened = std::move(reading.opened);
    return out;
}

namespace {

constexpr std::size_t max_cases = 10'000;
using Case = std::map<std::string, std::string>;

std::vector<Case> range_of(const OscNode& node, const std::string& parameter) {
    const OscNode range = node.require("Range");
    const double step = node.number("stepWidth"), low = range.number("lowerLimit"), high = range.number("upperLimit");
    if (!(step > 0.0) || !(high >= low) || (high - low) / step > static_cast<double>(max_cases))
        node.refuse("stepWidth", fmt::format("found steps of {} from {} to {}", step, low, high), "at most 10000 steps above 0");
    std::vector<Case> out;
    const auto steps = static_cast<int>(std::floor((high - low) / step + 1e-9));
    for (int i = 0; i <= steps; ++i)
        out.push_back({{parameter, fmt::format("{}", low + i * step)}});
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
            for (const OscNode& element : kind.children("Element"))
                out.push_back({{parameter, element.text("value")}});
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
        if (out.cases.size() * values.size() > max_cases)
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
