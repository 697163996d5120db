#include "scenarios/control/fmu_law.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

/// "others[2].x_m" and, of an array, "others.x_m[2]" are place 1 of "others.x_m".
std::pair<std::string, std::size_t> place_in_list(const std::string& name) {
    auto [plain, number] = listed_name(name);
    if (number == 0)
        return {name, 0};
    return {plain.erase(plain.find("[#]"), 3), number - 1};
}

struct ListMember {
    std::string_view name, unit;
    std::function<double(const fernlicht_control_input&, std::size_t)> value;
};

/// An other that is not there is infinitely far and has no lamps on; the road beyond its end is not known.
const std::vector<ListMember>& list_members() {
    using In = fernlicht_control_input;
    using Other = fernlicht_other;
    using Point = fernlicht_road_point;
    const auto other = [](auto member, double beyond = 0.0) {
        return [=](const In& in, std::size_t i) { return i < in.other_count ? static_cast<double>(in.others[i].*member) : beyond; };
    };
    const auto road = [](auto member) {
        return [=](const In& in, std::size_t i) { return i < in.road_count ? in.road[i].*member : std::nan(""); };
    };
    static const std::vector<ListMember> members{{"others.x_m", "m", other(&Other::x_m, std::numeric_limits<double>::infinity())},
                                                 {"others.y_m", "m", other(&Other::y_m)},
                                                 {"others.heading_rad", "rad", other(&Other::heading_rad)},
                                                 {"others.speed_mps", "m/s", other(&Other::speed_mps)},
                                                 {"others.width_m", "m", other(&Other::width_m)},
                                                 {"others.height_m", "m", other(&Other::height_m)},
                                                 {"others.lamps_on", "1", other(&Other::lamps_on)},
                                                 {"road.along_m", "m", road(&Point::along_m)},
                                                 {"road.x_m", "m", road(&Point::x_m)},
                                                 {"road.y_m", "m", road(&Point::y_m)},
                                                 {"road.curvature_per_m", "1/m", road(&Point::curvature_per_m)}};
    return members;
}

/// Whether metres, seconds and candelas are those of our unit. Radians, and those of a lux's steradian, may be left out, never too many.
bool fits(const FmuUnit& unit, std::string_view ours) {
    struct Base {
        std::string_view unit;
        int metres, seconds, candelas, radians;
    };
    static constexpr Base known[] = {{"s", 0, 1, 0, 0},     {"m", 1, 0, 0, 0},      {"m/s", 1, -1, 0, 0},
                                     {"m/s2", 1, -2, 0, 0}, {"rad/s", 0, -1, 0, 1}, {"1/m", -1, 0, 0, 1},
                                     {"lx", -2, 0, 1, 2},   {"rad", 0, 0, 0, 1},    {"1", 0, 0, 0, 0}};
    const auto* const base = std::ranges::find(known, ours, &Base::unit);
    return base != std::end(known) && !unit.others && unit.metres == base->metres && unit.seconds == base->seconds &&
           unit.candelas == base->candelas && unit.radians >= 0 && unit.radians <= base->radians;
}

std::string mapped(const std::vector<std::pair<std::string, std::string>>& names, const std::string& variable) {
    const auto found = std::ranges::find(names, variable, &std::pair<std::string, std::string>::first);
    return found == names.end() ? variable : found->second;
}

std::string element_of(const FmuVariable& variable, const std::string& name, std::size_t i) {
    return variable.count ? fmt::format("{}[{}]", name, i + 1) : name;
}

} // namespace

FmuLaw::FmuLaw(const PluginParameters& parameters, const std::vector<ControlledLamp>& lamps)
    : file_(parameters.library), places_(parameters.places), fmu_(file_) {
    std::vector<std::string> names;
    for (const ControlledLamp& lamp : lamps)
        names.push_back(lamp.name);
    const SignalTable table(names);
    for (const auto& [causality, maps] : {std::pair("input", &parameters.inputs), std::pair("output", &parameters.outputs)})
        for (const auto& [variable, signal] : *maps)
            if (std::ranges::none_of(fmu_.description().variables, [&, &wanted = variable, &as = causality](const FmuVariable& of) {
                    return of.name == wanted && of.causality == as;
                }))
                refuse(fmt::format("{}s", causality), fmt::format("no {} '{}'", causality, printable(variable)),
                       fmt::format("an {} of the FMU", causality));
    take_parameters(parameters);
    for (const auto& [variable, value] : parameters.values)
        if (mapped(parameters.inputs, variable) != variable)
            refuse("inputs", fmt::format("'{}', which parameters give a value", printable(variable)), "one of them");
    for (const FmuVariable& variable : fmu_.description().variables) {
        const bool is_set = std::ranges::any_of(parameters.values, [&](const auto& value) { return value.first == variable.name; });
        if (variable.causality == "input" && !is_set)
            match_input(variable, mapped(parameters.inputs, variable.name), table);
        if (variable.causality != "output")
            continue;
        const std::string name = mapped(parameters.outputs, variable.name);
        if (match_output(variable, name, lamps, parameters.lamps))
            continue;
        if (name != variable.name)
            refuse("outputs", fmt::format("'{}' for '{}', no command of these lamps", printable(name), printable(variable.name)),
                   "lamp.NAME.swivel_command_rad, pitch_command_rad, level or segments[1], or a star for NAME");
        unread_.push_back(printable(variable.name));
    }
    if (outputs_.empty())
        refuse("outputs", "no output that is a command",
               fmt::format("lamp.{}.swivel_command_rad or another command, by its own name or by outputs",
                           lamps.empty() ? "*" : lamps[0].name));
}

void FmuLaw::refuse(const std::string& key, const std::string& found, const std::string& expected) const {
    if (places_.own.file.empty())
        throw InputError({file_, 0, 0, key}, found, expected);
    throw InputError(places_.of(key), file_.filename().string() + ": " + found, expected);
}

void FmuLaw::take_parameters(const PluginParameters& parameters) {
    std::vector<std::string> known;
    for (const FmuVariable& variable : fmu_.description().variables)
        if (variable.causality == "parameter" || variable.causality == "input")
            known.push_back(variable.name);
    for (const auto& [name, value] : parameters.values) {
        const auto found = std::ranges::find(fmu_.description().variables, name, &FmuVariable::name);
        if (std::ranges::find(known, name) == known.end()) {
            const std::string near = nearest_name(name, known);
            refuse("parameters", fmt::format("no parameter '{}'", printable(name)),
                   near.empty() ? "a parameter or an input of the FMU" : fmt::format("'{}', the nearest", printable(near)));
        }
        if (found->count)
            refuse("parameters", fmt::format("'{}', an array", printable(name)), "a parameter of one value");
        fmu_.will_set(*found);
        if (found->type == FmuType::text) {
            texts_.emplace_back(*found, value);
            continue;
        }
        const std::optional<double> number = value == "true" ? 1.0 : value == "false" ? 0.0 : to_number(value);
        if (!number || !Fmu::holds(*found, *number))
            refuse("parameters", fmt::format("'{}' for '{}'", printable(value), printable(name)),
                   fmt::format("a value of type {}", found->element));
        numbers_.emplace_back(*found, *number);
    }
}

void FmuLaw::match_input(const FmuVariable& variable, const std::string& name, const SignalTable& table) {
    Port<Read> port{variable, {}};
    const bool number = variable.type != FmuType::text && variable.type != FmuType::none;
    if (!number && name == variable.name && !known_signal(name))
        return; // it keeps its start value
    if (!number)
        refuse("inputs", fmt::format("variable '{}' of type {}", printable(variable.name), variable.element), "a number");
    fmu_.will_set(variable);
    for (std::size_t i = 0; i < variable.count.value_or(1); ++i) {
        const std::string element = element_of(variable, name, i);
        std::string_view unit = "s";
        if (element == "dt_s") {
            port.values.emplace_back([](const fernlicht_control_input& in) { return in.dt_s; });
        } else if (const auto [plain, at] = place_in_list(element); plain != element) {
            const auto member = std::ranges::find(list_members(), plain, &ListMember::name);
            if (member == list_members().end())
                refuse("inputs", fmt::format("no signal '{}' for '{}'", printable(element), printable(variable.name)),
                       "others[1].x_m, road[1].x_m ...");
            unit = member->unit;
            port.values.emplace_back([of = &*member, at = at](const fernlicht_control_input& in) { return of->value(in, at); });
        } else {
            std::size_t place = 0;
            try {
                place = table.find(element);
            } catch (const std::invalid_argument& nearest) {
                refuse("inputs", fmt::format("no signal '{}' for input '{}'", printable(element), printable(variable.name)),
                       fmt::format("{}, or a place in inputs or parameters", nearest.what()));
            }
            unit = table.kind(place).unit;
            port.values.emplace_back([place](const fernlicht_control_input& in) { return in.signal_values[place]; });
        }
        check_unit("inputs", variable, element, unit);
    }
    inputs_.push_back(std::move(port));
}

void FmuLaw::check_unit(const char* key, const FmuVariable& variable, const std::string& signal, std::string_view ours) const {
    const FmuUnit& unit = variable.unit;
    if (!unit.name.empty() && !unit.known && unit.name != ours)
        refuse(key, fmt::format("'{}' in '{}', a unit that the FMU does not define", printable(variable.name), printable(unit.name)),
               fmt::format("its BaseUnit, because '{}' is in {}", printable(signal), ours));
    if (unit.known && !fits(unit, ours))
        refuse(key, fmt::format("'{}' in '{}'", printable(variable.name), printable(unit.name)),
               fmt::format("a unit of what '{}' has in {}", printable(signal), ours));
}

bool FmuLaw::match_output(const FmuVariable& variable, const std::string& name, const std::vector<ControlledLamp>& lamps,
                          const std::vector<std::string>& may_move) {
    Port<Write> port{variable, {}};
    bool any = false;
    for (std::size_t i = 0; i < variable.count.value_or(1); ++i) {
        const std::string element = element_of(variable, name, i);
        const auto [plain, at] = place_in_list(element);
        std::vector<Write> writes;
        for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
            for (const std::string& of : {lamps[lamp].name, std::string("*")}) {
                using Command = fernlicht_lamp_command;
                if (std::ranges::find(may_move, lamps[lamp].name) == may_move.end())
                    continue;
                for (const auto& [command, member] :
                     {std::pair("swivel_command_rad", &Command::swivel_rad), std::pair("pitch_command_rad", &Command::pitch_rad),
                      std::pair("level", &Command::level)})
                    if (element == fmt::format("lamp.{}.{}", of, command))
                        writes.emplace_back(
                            [lamp, to = member](fernlicht_control_output& out, double value) { out.lamps[lamp].*to = value; });
                if (plain != element && plain == fmt::format("lamp.{}.segments", of) && at < lamps[lamp].windows.size())
                    writes.emplace_back(
                        [lamp, at = at](fernlicht_control_output& out, double value) { out.lamps[lamp].segments[at] = value; });
            }
        if (writes.empty())
            break;
        check_unit("outputs", variable, plain, plain.ends_with("_rad") ? "rad" : "1");
        any = true;
        port.values.emplace_back([writes](fernlicht_control_output& out, double value) {
            for (const Write& write : writes)
                write(out, value);
        });
    }
    if (!any)
        return false;
    if (port.values.size() < variable.count.value_or(1))
        refuse("outputs", fmt::format("'{}' of {} values for {}", printable(variable.name), *variable.count, port.values.size()),
               "at most as many as there are");
    fmu_.will_get(variable);
    outputs_.push_back(std::move(port));
    return true;
}

std::string FmuLaw::start() {
    std::string wrong = fmu_.instantiate();
    for (const auto& [variable, text] : texts_)
        if (wrong.empty())
            wrong = fmu_.set_text(variable, text);
    for (const auto& [variable, number] : numbers_)
        if (wrong.empty())
            wrong = fmu_.set(variable, std::span(&number, 1));
    return wrong.empty() ? fmu_.initialize() : wrong;
}

std::string FmuLaw::step(const fernlicht_control_input& in, fernlicht_control_output& out) {
    for (const Port<Read>& port : inputs_) {
        values_.clear();
        for (const Read& read : port.values)
            values_.push_back(port.variable.unit.from_base(read(in)));
        if (std::string wrong = fmu_.set(port.variable, values_); !wrong.empty())
            return wrong;
    }
    if (std::string wrong = started_ ? fmu_.step(in.time_s - in.dt_s, in.dt_s) : fmu_.begin(); !wrong.empty())
        return wrong;
    started_ = true;
    for (const Port<Write>& port : outputs_) {
        values_.assign(port.values.size(), 0.0);
        if (std::string wrong = fmu_.get(port.variable, values_); !wrong.empty())
            return wrong;
        for (std::size_t i = 0; i < values_.size(); ++i)
            port.values[i](out, port.variable.unit.to_base(values_[i]));
    }
    return {};
}

std::vector<FmuTie> fmu_ties(const PluginParameters& parameters) {
    const Fmu fmu(parameters.library);
    std::vector<FmuTie> ties;
    for (const FmuVariable& variable : fmu.description().variables) {
        const bool input = variable.causality == "input", output = variable.causality == "output";
        if (!input && !output && variable.causality != "parameter")
            continue;
        const std::string name = mapped(input ? parameters.inputs : output ? parameters.outputs : parameters.values, variable.name);
        const auto start = std::ranges::find(parameters.values, variable.name, &std::pair<std::string, std::string>::first);
        const std::string element = element_of(variable, input || output ? name : std::string(), 0);
        const SignalKind* const kind = known_signal(element);
        std::string tie = input    ? "nothing: it needs a signal (inputs) or a value (parameters)"
                          : output ? "nothing"
                                   : "its own start value";
        if (!output && start != parameters.values.end())
            tie = "is " + start->second;
        else if (input && (kind || element == "dt_s" ||
                           std::ranges::find(list_members(), place_in_list(element).first, &ListMember::name) != list_members().end()))
            tie = "reads " + name;
        else if (input && variable.type == FmuType::text)
            tie = "its own start value";
        else if (output && kind &&
                 (kind->name.ends_with("_command_rad") || kind->name == "lamp.*.level" || kind->name == "lamp.*.segments[#]"))
            tie = "commands " + name;
        ties.push_back({variable, tie});
    }
    return ties;
}

} // namespace fernlicht
