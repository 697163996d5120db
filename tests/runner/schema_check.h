// JSON against a schema of ours, by the few words of JSON Schema that they use.
#pragma once

#include "runner/files/described_json.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace fernlicht::tests {

class Schema {
    using json = nlohmann::json;

  public:
    explicit Schema(json root) : root_(std::move(root)) {}

    /// Complaints about `value`, each with its place; none when it fits.
    std::vector<std::string> check(const json& value) {
        complaints_.clear();
        check(value, root_, "");
        return complaints_;
    }

  private:
    void complain(const std::string& place, const std::string& what) { complaints_.push_back(place + ": " + what); }

    static bool is_of(const json& value, const std::string& type) {
        return (type == "object" && value.is_object()) || (type == "array" && value.is_array()) ||
               (type == "string" && value.is_string()) || (type == "integer" && value.is_number_integer()) ||
               (type == "number" && value.is_number()) || (type == "boolean" && value.is_boolean()) || (type == "null" && value.is_null());
    }

    void check(const json& value, const json& schema, const std::string& place) {
        static const std::set<std::string> known{"$schema", "$defs", "$ref",     "title",      "description", "type",
                                                 "const",   "enum",  "required", "properties", "items",       "additionalProperties"};
        for (const auto& [word, meaning] : schema.items())
            if (!known.contains(word))
                complain(place, "the schema says '" + word + "', which this test does not know");
        if (schema.contains("$ref"))
            check(value, root_.at(json::json_pointer(schema.at("$ref").get<std::string>().substr(1))), place);
        if (schema.contains("const") && value != schema.at("const"))
            complain(place, "is not " + schema.at("const").dump());
        if (schema.contains("enum") && std::find(schema.at("enum").begin(), schema.at("enum").end(), value) == schema.at("enum").end())
            complain(place, "is none of " + schema.at("enum").dump());
        if (schema.contains("type")) {
            const json types = schema.at("type").is_array() ? schema.at("type") : json::array({schema.at("type")});
            if (std::none_of(types.begin(), types.end(), [&](const json& type) { return is_of(value, type.get<std::string>()); }))
                complain(place, "is no " + types.dump());
        }
        if (value.is_object())
            check_members(value, schema, place);
        if (value.is_array() && schema.contains("items"))
            for (std::size_t i = 0; i < value.size(); ++i)
                check(value[i], schema.at("items"), place + "/" + std::to_string(i));
    }

    void check_members(const json& value, const json& schema, const std::string& place) {
        for (const json& name : schema.value("required", json::array()))
            if (!value.contains(name.get<std::string>()))
                complain(place, "lacks " + name.dump());
        const json properties = schema.value("properties", json::object());
        for (const auto& [name, member] : value.items()) {
            const json rest = schema.value("additionalProperties", json(true));
            if (properties.contains(name))
                check(member, properties.at(name), place + "/" + name);
            else if (rest.is_object())
                check(member, rest, place + "/" + name);
            else if (rest == json(false))
                complain(place, "has an unknown member '" + name + "'");
        }
    }

    json root_;
    std::vector<std::string> complaints_;
};

/// What a file of results says: it fits the schema, and comes back as it is.
template <class Result> nlohmann::json checked(const std::filesystem::path& file, const std::string& schema,
                                               Result (*read)(const std::filesystem::path&), std::string (*text)(const Result&)) {
    nlohmann::json found = nlohmann::json::parse(std::ifstream(file));
    EXPECT_EQ(Schema(nlohmann::json::parse(schema)).check(found), std::vector<std::string>());
    EXPECT_EQ(nlohmann::json::parse(text(read(file))), found);
    return found;
}

/// The same of a text, by the members that it describes.
template <class Result> nlohmann::json checked(const std::string& text, JsonMembers (*members)(Result&)) {
    nlohmann::json found = nlohmann::json::parse(text);
    EXPECT_EQ(Schema(nlohmann::json::parse(json_schema(members))).check(found), std::vector<std::string>());
    const Result read = from_json<Result>(CheckedJson::parse(text, {}), members);
    EXPECT_EQ(nlohmann::json::parse(json_text(as_json(read, members))), found);
    return found;
}

/// The one in a list that has this value there; throws where there is none.
inline const nlohmann::json& entry(const nlohmann::json& list, const char* key, const std::string& value) {
    const auto found = std::ranges::find_if(list, [&](const nlohmann::json& one) { return one.at(key) == value; });
    return found == list.end() ? throw std::out_of_range(value) : *found;
}

/// Complaints about `value` by a schema in runner/experiments, as "run/report".
inline std::vector<std::string> complaints(const nlohmann::json& value, const std::string& schema) {
    return Schema(nlohmann::json::parse(std::ifstream(FERNLICHT_SOURCE_DIR "/runner/experiments/" + schema + ".schema.json"))).check(value);
}

} // namespace fernlicht::tests
