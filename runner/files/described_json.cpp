#include "runner/files/described_json.h"

#include "scenarios/values/files.h"

#include <algorithm>
#include <utility>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

template <class T> JsonPart leaf(T& value, const char* type, T (CheckedJson::*read)() const) {
    return {[&value] { return Json(value); }, [&value, read](const CheckedJson& json) { value = (json.*read)(); },
            [type] {
                return Json{{"type", type}};
            }};
}

} // namespace

JsonPart json_leaf(bool& value) { return leaf(value, "boolean", &CheckedJson::truth); }
JsonPart json_leaf(int& value) { return leaf(value, "integer", &CheckedJson::whole); }
JsonPart json_leaf(std::uint64_t& value) { return leaf(value, "integer", &CheckedJson::count); }
JsonPart json_leaf(double& value) { return leaf(value, "number", &CheckedJson::number); }
JsonPart json_leaf(std::string& value) { return leaf(value, "string", &CheckedJson::text); }

JsonPart json_leaf(std::filesystem::path& value) {
    return through([&value] { return value.string(); }, [&value](const std::string& text) { value = text; });
}

JsonPart json_leaf(Value& value) {
    return {[&value] { return value_json(value); }, [&value](const CheckedJson& json) { value = value_in(json); },
            [] {
                const Json bound{{"type", "number"}};
                return Json{{"type", {"number", "object", "null"}},
                            {"additionalProperties", false},
                            {"properties", {{"at_least", bound}, {"at_most", bound}}}};
            }};
}

JsonPart json_leaf(ReadingKey& value) {
    return {[&value] { return Json(name_of(value)); }, [&value](const CheckedJson& json) { value = key_in(json); },
            [] {
                return Json{{"type", "string"}};
            }};
}

JsonPart json_leaf(JsonTexts& value) {
    return {[&value] {
                Json texts = Json::object();
                for (const auto& [name, text] : value)
                    texts[name] = text;
                return texts;
            },
            [&value](const CheckedJson& json) { value = json.texts(); },
            [] {
                return Json{{"type", "object"}, {"additionalProperties", {{"type", "string"}}}};
            }};
}

JsonPart json_constant(Json value) {
    return {[value] { return value; }, [value](const CheckedJson& json) { place_in(Json::array({value}), json); },
            [value] {
                return Json{{"const", value}};
            }};
}

JsonPart::JsonPart(const JsonMembers& members)
    : JsonPart(
          [members] {
              Json object = Json::object();
              for (const JsonMember& member : members)
                  if (member.part.is_there)
                      object[member.key] = member.part.write();
              return object;
          },
          [members](const CheckedJson& json) {
              for (const int now : {0, 1, 2})
                  for (const auto& [key, part] : members)
                      if (part.turn == now && part.read && (!part.may_lack || json.has(key)))
                          part.read(json.at(key));
          },
          [members] {
              Json required = Json::array(), properties = Json::object();
              for (const JsonMember& member : members) {
                  properties[member.key] = member.part.schema();
                  if (!member.part.may_lack)
                      required.push_back(member.key);
              }
              return Json{{"type", "object"}, {"additionalProperties", false}, {"required", required}, {"properties", properties}};
          }) {}

namespace {

/// A list as the value of a member; what is finished of the text goes to `take`.
void append_items(std::string& out, const JsonPart& list, const TakePiece& take) {
    Json first = Json::array();
    bool is_long = false;
    const auto add = [&](const Json& item, const char* before) {
        out += before;
        out += "\n    ";
        append_json(out, item, 2);
        take(out);
        out.clear();
    };
    list.each([&](Json item) {
        if (is_long)
            return add(item, ",");
        first.push_back(std::move(item));
        is_long = takes_lines(first);
        for (std::size_t i = 0; is_long && i < first.size(); ++i)
            add(first[i], i == 0 ? "[" : ",");
    });
    if (is_long)
        out += "\n  ]";
    else
        append_json(out, first, 1);
}

} // namespace

void write_json(const std::filesystem::path& file, const JsonMembers& members) {
    write_file(file, [&](const TakePiece& take) {
        std::string out;
        bool is_first = true;
        for (const auto& [key, part] : members)
            if (part.is_there) {
                out += (is_first ? "{\n  " : ",\n  ") + json_quoted(key) + ": ";
                is_first = false;
                if (part.each)
                    append_items(out, part, take);
                else
                    append_json(out, part.write(), 1);
                take(std::exchange(out, {}));
            }
        take("\n}\n");
    });
}

JsonMembers when(bool there, JsonMembers members) {
    for (JsonMember& member : members)
        member.part.is_there = there, member.part.may_lack = true;
    return members;
}

JsonPart in_turn(int turn, JsonPart part) {
    part.turn = turn;
    return part;
}

Json nullable(Json schema) {
    if (schema.contains("enum"))
        schema["enum"].push_back(nullptr);
    else
        schema["type"] = Json::array({schema["type"], "null"});
    return schema;
}

JsonPart null_unless(bool there, const JsonPart& part) {
    return {[=] { return there ? part.write() : Json(nullptr); },
            [=](const CheckedJson& json) {
                if (!json.is_null())
                    part.read(json);
            },
            [=] { return nullable(part.schema()); }};
}

JsonPart or_why(const JsonPart& optional, const std::string& why, std::string* back) {
    return {[=] {
                const Json value = optional.write();
                return value.is_null() ? Json{{"not_measured", why}} : value;
            },
            [=](const CheckedJson& json) {
                if (!json.has("not_measured"))
                    optional.read(json);
                else if (back)
                    *back = json.at("not_measured").text();
            },
            [=] {
                Json schema = optional.schema();
                schema["type"] = "object";
                schema["properties"]["not_measured"]["type"] = "string";
                schema.erase("required");
                return schema;
            }};
}

std::size_t place_in(const Json& list, const CheckedJson& json) {
    const auto found = std::ranges::find(list, json.dump(), [](const Json& one) { return one.dump(-1, ' ', true); });
    if (found == list.end())
        json.refuse(list.size() == 1 ? list[0].dump() : "one of " + list.dump());
    return static_cast<std::size_t>(found - list.begin());
}

} // namespace fernlicht
