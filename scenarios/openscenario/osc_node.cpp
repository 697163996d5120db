#include "scenarios/openscenario/osc_node.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht::osc {
namespace {

bool is_element(pugi::xml_node node) { return node.type() == pugi::node_element; }

} // namespace

std::optional<std::string> Scope::find(const std::string& name) const {
    for (const Scope* scope = this; scope; scope = scope->outer.get())
        if (const auto value = scope->values.find(name); value != scope->values.end())
            return value->second;
    return {};
}

void OscNode::refuse(const std::string& attribute, const std::string& found, const std::string& expected) const {
    file_->refuse(node_, attribute, found, expected);
}

void OscNode::unsupported(const std::string& what) const { reading_->unsupported.push_back({file(), line(), element(), what}); }

void OscNode::note(const std::string& what) const {
    reading_->notes.push_back(fmt::format("{}:{}: {}: {}", file().string(), line(), element(), what));
}

std::string OscNode::resolved(const char* attribute, const char* written) const {
    try {
        std::string text = resolve(written, *scope_);
        if (std::string_view(written).find('$') != std::string_view::npos)
            count_bytes(attribute, text.size());
        return text;
    } catch (const std::invalid_argument& error) {
        refuse(attribute, fmt::format("found '{}': {}", printable(written), error.what()));
    }
}

std::optional<std::string> OscNode::if_given(const char* attribute) const {
    const pugi::xml_attribute found = node_.attribute(attribute);
    return found ? std::optional(resolved(attribute, found.value())) : std::nullopt;
}

std::string OscNode::text(const char* attribute) const {
    if (auto found = if_given(attribute))
        return *found;
    refuse(attribute, "is missing");
}

std::string OscNode::text_or(const char* attribute, const std::string& otherwise) const { return if_given(attribute).value_or(otherwise); }

std::string OscNode::name() const {
    std::string written = node_.attribute("name").value();
    try {
        return resolve(written, *scope_);
    } catch (const std::invalid_argument&) {
        return written;
    }
}

std::string OscNode::entity(const char* attribute) const {
    std::string found = text(attribute);
    const auto& known = reading_->entities;
    if (std::find(known.begin(), known.end(), found) == known.end()) {
        const std::string nearest = nearest_name(found, known);
        refuse(attribute, fmt::format("found '{}'", printable(found)),
               nearest.empty() ? std::string("an entity of the scenario")
                               : fmt::format("an entity of the scenario, perhaps '{}'", nearest));
    }
    return found;
}

double OscNode::number(const char* attribute) const {
    const std::string found = text(attribute);
    if (found == "INF" || found == "+INF") // xsd:double
        return HUGE_VAL;
    if (found == "-INF")
        return -HUGE_VAL;
    if (found == "pi" || found == "-pi")
        return found == "pi" ? pi : -pi;
    const auto value = to_number(found);
    if (!value)
        refuse(attribute, fmt::format("found '{}'", printable(found)), "a number");
    return *value;
}

double OscNode::number_or(const char* attribute, double otherwise) const { return has(attribute) ? number(attribute) : otherwise; }

std::optional<double> OscNode::number_if(const char* attribute) const {
    return has(attribute) ? std::optional(number(attribute)) : std::nullopt;
}

double OscNode::length(const char* attribute) const {
    const double found = number(attribute);
    if (!(std::abs(found) <= 1e9))
        refuse(attribute, fmt::format("found {}", found), "a length within 1e9 m");
    return found;
}

double OscNode::length_or_0(const char* attribute) const { return has(attribute) ? length(attribute) : 0.0; }

double OscNode::angle_or_0(const char* attribute) const {
    const double found = number_or(attribute, 0.0);
    if (!(std::abs(found) <= 1e6))
        refuse(attribute, fmt::format("found {}", found), "an angle within 1e6 rad");
    return found;
}

std::optional<double> OscNode::not_below_0_if(const char* attribute, const char* expected) const {
    const std::optional<double> found = number_if(attribute);
    if (found && !(*found >= 0.0))
        refuse(attribute, fmt::format("found {}", *found), expected);
    return found;
}

int OscNode::whole(const char* attribute) const {
    const double value = number(attribute);
    if (value != std::floor(value) || std::abs(value) > 1e9)
        refuse(attribute, fmt::format("found '{}'", printable(text(attribute))), "a whole number");
    return static_cast<int>(value);
}

bool OscNode::flag_or(const char* attribute, bool otherwise) const {
    if (!has(attribute))
        return otherwise;
    const std::string found = text(attribute);
    if (found == "true" || found == "1")
        return true;
    if (found == "false" || found == "0")
        return false;
    refuse(attribute, fmt::format("found '{}'", printable(found)), "'true' or 'false'");
}

std::size_t OscNode::choice(const char* attribute, std::initializer_list<std::string_view> choices) const {
    const std::string found = text(attribute);
    std::size_t at = 0;
    std::string known;
    for (const std::string_view candidate : choices) {
        if (candidate == found)
            return at;
        known += fmt::format("{}'{}'", at == 0 ? "" : at + 1 == choices.size() ? " or " : ", ", candidate);
        ++at;
    }
    refuse(attribute, fmt::format("found '{}'", printable(found)), known);
}

std::string OscNode::content() const { return resolved("", node_.text().get()); }

std::optional<OscNode> OscNode::find(const char* element) const {
    const pugi::xml_node child = node_.child(element);
    return child ? std::optional(OscNode(*file_, child, scope_, *reading_)) : std::nullopt;
}

OscNode OscNode::require(const char* element) const {
    if (auto child = find(element))
        return *child;
    refuse("", fmt::format("has no element '{}'", element), fmt::format("one '{}'", element));
}

std::vector<OscNode> OscNode::children(const char* element) const {
    std::vector<OscNode> found;
    for (const pugi::xml_node child : node_.children(element))
        found.emplace_back(*file_, child, scope_, *reading_);
    return found;
}

std::vector<OscNode> OscNode::children() const {
    std::vector<OscNode> found;
    for (const pugi::xml_node child : node_.children())
        if (is_element(child))
            found.emplace_back(*file_, child, scope_, *reading_);
    return found;
}

OscNode OscNode::only(const std::string& what) const {
    const std::vector<OscNode> found = children();
    if (found.empty())
        refuse("", "is empty", what);
    return found.front();
}

std::map<std::string, std::string> OscNode::declared() const {
    const auto growing = std::make_shared<Scope>(Scope{{}, scope_});
    if (const auto list = find("ParameterDeclarations"))
        for (const OscNode& parameter : list->children("ParameterDeclaration")) {
            // A parameter may lean on those that stand before it.
            const OscNode inner = parameter.with(growing);
            std::string name = parameter.node().attribute("name").value();
            if (name.starts_with('$')) // as files of 1.0 write it
                name.erase(0, 1);
            if (name.empty())
                parameter.refuse("name", "is missing", "the parameter's name");
            std::string value = inner.text_or("value", "");
            inner.count_bytes("value", value.size());
            growing->values[name] = std::move(value);
        }
    return std::move(growing->values);
}

void OscNode::count_bytes(const char* attribute, std::size_t bytes) const {
    constexpr std::size_t most = std::size_t{64} << 20; // files of others stay below 100 kB
    reading_->parameter_bytes += bytes;
    if (reading_->parameter_bytes > most)
        refuse(attribute, fmt::format("gives a text of {} bytes, with which parameters fill more than {} MiB", bytes, most >> 20),
               "shorter ones");
}

OscNode OscNode::with_declared() const {
    auto values = declared();
    return values.empty() ? *this : with(std::make_shared<Scope>(Scope{std::move(values), scope_}));
}

} // namespace fernlicht::osc
