#include "scenarios/fields/schema.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using nlohmann::ordered_json;

constexpr const char* name_pattern = "^[A-Za-z0-9_-][A-Za-z0-9_.-]{0,63}$";

ordered_json of_group(const Group& group);

/// 3 rather than 3.0.
ordered_json of_bound(double bound) {
    if (bound == std::round(bound) && std::abs(bound) < 1.0e9)
        return static_cast<std::int64_t>(bound);
    return bound;
}

ordered_json of_range(const char* type, double least, double greatest) {
    return {{"type", type}, {"minimum", of_bound(least)}, {"maximum", of_bound(greatest)}};
}

ordered_json of_number(const FieldRule& rule) {
    ordered_json json = of_range("number", rule.least, rule.greatest);
    if (!rule.refused_as.empty())
        json["exclusiveMaximum"] = of_bound(rule.greatest), json.erase("maximum");
    if (rule.is_above)
        json["exclusiveMinimum"] = of_bound(rule.least), json.erase("minimum");
    return json;
}

ordered_json of_array(const FieldRule& rule, const ordered_json& items) {
    ordered_json json{{"type", "array"}, {"items", items}};
    if (rule.fewest > 0)
        json["minItems"] = rule.fewest;
    json["maxItems"] = rule.most;
    return json;
}

ordered_json of_value(const Field& field);

/// A struct, and the scalars that may stand in its place.
ordered_json of_inner(const Field& field) {
    ordered_json map = field.group->definition.empty() ? of_group(*field.group)
                                                       : ordered_json{{"$ref", fmt::format("#/definitions/{}", field.group->definition)}};
    ordered_json scalar;
    if (field.may_be_flag)
        scalar["type"] = "boolean";
    else if (!field.default_word.empty())
        scalar["enum"] = field.default_word;
    else if (!field.short_key.empty())
        scalar = of_value(field_named(*field.group, field.short_key));
    else if (!field.absent_word.empty())
        scalar["enum"] = {field.absent_word};
    else
        return map;
    return {{"anyOf", {scalar, map}}};
}

ordered_json of_element(const Field& field) { return field.group->is_bare ? of_value(field.group->fields.front()) : of_inner(field); }

ordered_json of_value(const Field& field) {
    const FieldRule& rule = field.rule;
    if (!field.schema.empty())
        return ordered_json::parse(field.schema);
    switch (field.kind) {
    case FieldKind::number:
        return of_number(rule);
    case FieldKind::whole:
        return of_range("integer", rule.least, rule.greatest);
    case FieldKind::flag:
        return {{"type", "boolean"}};
    case FieldKind::text:
        return {{"type", {"string", "number"}}, {"minLength", 1}};
    case FieldKind::name:
        return {{"type", "string"}, {"pattern", name_pattern}};
    case FieldKind::path:
        return {{"type", "string"}, {"minLength", 1}};
    case FieldKind::names:
    case FieldKind::texts:
        return of_array(rule, {{"type", {"string", "number"}}, {"minLength", 1}});
    case FieldKind::choice:
        return {{"enum", rule.words}};
    case FieldKind::numbers:
        return of_array(rule, of_range("number", rule.least, rule.greatest));
    case FieldKind::position: {
        FieldRule three = rule;
        three.fewest = three.most = 3;
        return of_array(three, of_range("number", rule.least, rule.greatest));
    }
    case FieldKind::named:
        return {{"type", "object"},
                {"minProperties", rule.fewest},
                {"maxProperties", rule.most},
                {"propertyNames", {{"type", "string"}, {"pattern", name_pattern}}},
                {"additionalProperties", of_element(field)}};
    case FieldKind::list:
        return of_array(rule, of_element(field));
    case FieldKind::own:
        break;
    case FieldKind::group:
    case FieldKind::inlined:
        return of_inner(field);
    }
    return {};
}

void add_properties(const Group& group, ordered_json& object) {
    for (const Field& field : group.fields) {
        if (field.kind == FieldKind::inlined) {
            add_properties(*field.group, object);
            continue;
        }
        const std::vector<FieldUnit>& units = field.rule.units;
        ordered_json value = units.empty() ? of_value(field) : ordered_json{};
        for (std::size_t i = 0; i < std::max<std::size_t>(1, units.size()); ++i) {
            if (!units.empty())
                value = of_range("number", units[i].least, units[i].greatest);
            if (!field.meaning.empty())
                value["description"] = field.meaning;
            object["properties"][units.empty() ? field.key : units[i].key] = value;
        }
        if (field.is_required)
            object["required"].push_back(field.key);
        if (!units.empty())
            object["allOf"].push_back({{"not", {{"required", {units[0].key, units[1].key}}}}});
    }
    if (group.schema_beside.empty())
        return;
    const ordered_json beside = ordered_json::parse(group.schema_beside);
    for (const auto& [keyword, rule] : beside.items())
        if (keyword == "allOf" || keyword == "required")
            std::ranges::copy(rule, std::back_inserter(object[keyword]));
        else
            object[keyword] = rule;
}

ordered_json of_group(const Group& group) {
    ordered_json object{{"type", "object"}, {"additionalProperties", false}, {"properties", ordered_json::object()}};
    add_properties(group, object);
    return object;
}

} // namespace

std::string schema_of(const Group& group) { return of_group(group).dump(2); }

std::string schema_as_heard(Group group, const void* whole) {
    const void* const of = whole ? whole : group.usual.get();
    std::erase_if(group.fields, [&](const Field& field) { return field.heard && !field.heard(of); });
    return schema_of(group);
}

std::string schemas_by_word(const Group& group, void* scratch) {
    const Field& says = group.fields.front();
    std::string forms;
    Group form;
    for (int word = 0; word < static_cast<int>(says.rule.words.size()); ++word) {
        std::memcpy(says.member.make(scratch), &word, sizeof word);
        Group heard = group;
        std::erase_if(heard.fields, [&](const Field& field) { return field.heard && !field.heard(scratch); });
        if (keys_of(heard) != keys_of(form)) {
            forms += form.fields.empty() ? "" : schema_of(form) + ", ";
            form = heard;
            form.fields.front().rule.words.clear();
        }
        form.fields.front().rule.words.push_back(says.rule.words[static_cast<std::size_t>(word)]);
    }
    return forms + schema_of(form);
}

std::string schema_of(const Field& field) {
    ordered_json json = of_value(field);
    if (!field.meaning.empty())
        json["description"] = field.meaning;
    return json.dump(2);
}

} // namespace fernlicht
