// YAML against a JSON schema of ours: what an editor would say of it.
#pragma once

#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

namespace fernlicht {

using nlohmann::json;

inline json to_json(const YamlValue& value) {
    if (value.kind == YamlValue::Kind::null)
        return nullptr;
    if (value.kind == YamlValue::Kind::scalar) {
        double number = 0.0;
        const auto [end, error] = std::from_chars(value.text.data(), value.text.data() + value.text.size(), number);
        if (!value.quoted && error == std::errc{} && end == value.text.data() + value.text.size())
            return number;
        if (!value.quoted && (value.text == "true" || value.text == "false"))
            return value.text == "true";
        return value.text;
    }
    json result = value.kind == YamlValue::Kind::list ? json::array() : json::object();
    for (const YamlValue& item : value.items)
        result.push_back(to_json(item));
    for (const YamlMember& member : value.members)
        result[member.key] = to_json(member.value);
    return result;
}

/// The part of JSON Schema, draft 7, that our schema uses. Gives the first violation, "" for none; throws for keywords it does not know.
class SchemaCheck {
  public:
    explicit SchemaCheck(json schema) : root_(std::move(schema)) {}

    std::string violation(const json& value) const { return violation(root_, value, ""); }

  private:
    static bool has_type(const std::string& type, const json& value) {
        return type == "object"    ? value.is_object()
               : type == "array"   ? value.is_array()
               : type == "string"  ? value.is_string()
               : type == "boolean" ? value.is_boolean()
               : type == "integer" ? value.is_number() && value.get<double>() == std::floor(value.get<double>())
                                   : type == "number" && value.is_number();
    }

    std::size_t passing(const json& schemas, const json& value, const std::string& where) const {
        return static_cast<std::size_t>(
            std::count_if(schemas.begin(), schemas.end(), [&](const json& schema) { return violation(schema, value, where).empty(); }));
    }

    std::string violation(const json& schema, const json& value, const std::string& where) const {
        for (const auto& [keyword, rule] : schema.items())
            if (std::string text = keyword_violation(schema, keyword, rule, value, where); !text.empty())
                return text;
        return "";
    }

    std::string keyword_violation(const json& schema, const std::string& keyword, const json& rule, const json& value,
                                  const std::string& where) const {
        const auto unless = [&](bool holds) {
            return holds ? std::string() : where + " against " + keyword + " " + rule.dump().substr(0, 80);
        };
        if (keyword == "$schema" || keyword == "title" || keyword == "description" || keyword == "definitions")
            return "";
        if (keyword == "$ref")
            return violation(root_.at(json::json_pointer(rule.get<std::string>().substr(1))), value, where);
        if (keyword == "type") {
            const json types = rule.is_array() ? rule : json::array({rule});
            return unless(std::any_of(types.begin(), types.end(), [&](const json& type) { return has_type(type, value); }));
        }
        if (keyword == "const")
            return unless(value == rule);
        if (keyword == "enum")
            return unless(std::find(rule.begin(), rule.end(), value) != rule.end());
        if (keyword == "anyOf")
            return unless(passing(rule, value, where) >= 1);
        if (keyword == "oneOf")
            return unless(passing(rule, value, where) == 1);
        if (keyword == "allOf")
            return unless(passing(rule, value, where) == rule.size());
        if (keyword == "not")
            return unless(!violation(rule, value, where).empty());
        if (keyword == "minimum")
            return unless(!value.is_number() || value >= rule);
        if (keyword == "maximum")
            return unless(!value.is_number() || value <= rule);
        if (keyword == "exclusiveMinimum")
            return unless(!value.is_number() || value > rule);
        if (keyword == "exclusiveMaximum")
            return unless(!value.is_number() || value < rule);
        if (keyword == "minLength")
            return unless(!value.is_string() || value.get<std::string>().size() >= rule);
        if (keyword == "pattern")
            return unless(!value.is_string() || std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>())));
        if (keyword == "minItems")
            return unless(!value.is_array() || value.size() >= rule);
        if (keyword == "maxItems")
            return unless(!value.is_array() || value.size() <= rule);
        if (keyword == "minProperties")
            return unless(!value.is_object() || value.size() >= rule);
        if (keyword == "maxProperties")
            return unless(!value.is_object() || value.size() <= rule);
        if (keyword == "required")
            return unless(!value.is_object() ||
                          std::all_of(rule.begin(), rule.end(), [&](const json& key) { return value.contains(key.get<std::string>()); }));
        if (keyword == "items" || keyword == "properties" || keyword == "additionalProperties" || keyword == "propertyNames")
            return children_violation(schema, keyword, rule, value, where);
        throw std::logic_error("schema keyword that this test does not know: " + keyword);
    }

    std::string children_violation(const json& schema, const std::string& keyword, const json& rule, const json& value,
                                   const std::string& where) const {
        if (keyword == "items" && value.is_array())
            for (const json& item : value)
                if (std::string text = violation(rule, item, where + "[]"); !text.empty())
                    return text;
        if (keyword == "items" || !value.is_object())
            return "";
        for (const auto& [key, member] : value.items()) {
            const bool described = schema.contains("properties") && schema["properties"].contains(key);
            std::string text;
            if (keyword == "propertyNames")
                text = violation(rule, json(key), where + "." + key);
            else if (keyword == "properties" && described)
                text = violation(rule[key], member, where + "." + key);
            else if (keyword == "additionalProperties" && !described)
                text = rule.is_boolean() ? where + "." + key + " is unknown" : violation(rule, member, where + "." + key);
            if (!text.empty())
                return text;
        }
        return "";
    }

    json root_;
};

} // namespace fernlicht
