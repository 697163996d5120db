// A struct in JSON, from one list of its members: by that list it is written, read back and described to checkers.
//
//   JsonMembers spot_members(Spot& spot) {
//       return {{"x_px", spot.x}, {"name", or_null(spot.name)}, {"edges", spot.edges, edge_members}, {"area", spot.area()}};
//   }
//
// Elements of lists and optional values (null: absent) are described by the function beside them. What is const or temporary, as
// the area, is derived: copied to be written, and nothing is read back into it.
#pragma once

#include "runner/files/json_text.h"
#include "runner/files/value_json.h"

#include <functional>
#include <memory>
#include <type_traits>

namespace fernlicht {

struct JsonMember;
using JsonMembers = std::vector<JsonMember>;
using JsonTexts = std::vector<std::pair<std::string, std::string>>; ///< an object of texts; they come back by name

/// A value: each function looks at it only when called. Without `read`: derived.
struct JsonPart {
    using Json = nlohmann::ordered_json;
    JsonPart(const JsonMembers& members);
    JsonPart(std::function<Json()> writes, std::function<void(const CheckedJson&)> reads, std::function<Json()> describes)
        : write(std::move(writes)), read(std::move(reads)), schema(std::move(describes)) {}

    std::function<Json()> write;
    std::function<void(const CheckedJson&)> read;
    std::function<Json()> schema;
    std::function<void(const std::function<void(Json)>&)> each = {}; ///< of a list: what `write` has, item by item
    bool is_there = true;
    bool may_lack = false; ///< left out where it is not there
    int turn = 0;          ///< 0, 1 or 2: read after all members of an earlier one
};

JsonPart json_constant(nlohmann::ordered_json value); ///< all else is refused
JsonPart json_leaf(bool& value);
JsonPart json_leaf(int& value);
JsonPart json_leaf(std::uint64_t& value);
JsonPart json_leaf(double& value);
JsonPart json_leaf(std::string& value);
JsonPart json_leaf(std::filesystem::path& value);
JsonPart json_leaf(Value& value);
JsonPart json_leaf(ReadingKey& value); ///< by name
JsonPart json_leaf(JsonTexts& value);
nlohmann::ordered_json nullable(nlohmann::ordered_json schema);
std::size_t place_in(const nlohmann::ordered_json& list, const CheckedJson& json); ///< refuses what is not in it

template <class T, class... Inner> JsonPart json_part(T&& value, Inner... inner) {
    using Plain = std::remove_cvref_t<T>;
    using Json = nlohmann::ordered_json;
    if constexpr (!std::is_lvalue_reference_v<T> || std::is_const_v<std::remove_reference_t<T>>) {
        using Own = std::conditional_t<std::is_convertible_v<T, std::string_view>, std::string, Plain>;
        const auto own = std::make_shared<Own>(std::forward<T>(value));
        JsonPart part = json_part(*own, inner...);
        part.write = [own, write = part.write] { return write(); };
        part.read = nullptr;
        part.each = nullptr;
        return part;
    } else if constexpr ((std::is_invocable_v<Inner, T> || ...)) {
        return JsonPart(inner(value)...);
    } else if constexpr (requires { value.has_value(); }) {
        return {[&value, inner...] { return value ? json_part(*value, inner...).write() : Json(nullptr); },
                [&value, inner...](const CheckedJson& json) {
                    value.reset();
                    if (!json.is_null())
                        json_part(value.emplace(), inner...).read(json);
                },
                [inner...] {
                    typename Plain::value_type one{};
                    return nullable(json_part(one, inner...).schema());
                }};
    } else if constexpr (!requires { json_leaf(value); }) {
        const auto each = [&value, inner...](const std::function<void(Json)>& take) {
            for (auto& element : value)
                take(json_part(element, inner...).write());
        };
        JsonPart part{[each] {
                          Json list = Json::array();
                          each([&](Json item) { list.push_back(std::move(item)); });
                          return list;
                      },
                      [&value, inner...](const CheckedJson& json) {
                          const std::vector<CheckedJson> items = json.items();
                          if constexpr (requires { value.resize(0); })
                              value = Plain(items.size());
                          else if (items.size() != value.size())
                              json.refuse(std::to_string(value.size()) + " elements");
                          for (std::size_t i = 0; i < items.size(); ++i)
                              json_part(value[i], inner...).read(items[i]);
                      },
                      [inner...] {
                          typename Plain::value_type one{};
                          return Json{{"type", "array"}, {"items", json_part(one, inner...).schema()}};
                      }};
        part.each = each;
        return part;
    } else
        return json_leaf(value);
}

struct JsonMember {
    JsonMember(std::string name, JsonPart value) : key(std::move(name)), part(std::move(value)) {}
    JsonMember(std::string name, const JsonMembers& members) : JsonMember(std::move(name), JsonPart(members)) {}
    template <class T, class... Inner>
    requires(!std::is_same_v<std::remove_cvref_t<T>, JsonPart> && !std::is_same_v<std::remove_cvref_t<T>, JsonMembers>)
        JsonMember(std::string name, T&& value, Inner... inner)
        : key(std::move(name)), part(json_part(std::forward<T>(value), inner...)) {}

    std::string key;
    JsonPart part;
};

template <class... More> JsonMembers joined(JsonMembers members, const More&... more) {
    (members.insert(members.end(), more.begin(), more.end()), ...);
    return members;
}
/// Members that stand there only if so.
JsonMembers when(bool there, JsonMembers members);

/// By way of another value, which `get` gives and `set` takes back.
template <class Get, class Set, class... Inner> JsonPart through(Get get, Set set, Inner... inner) {
    using Other = std::remove_cvref_t<decltype(get())>;
    return {[=] {
                Other value = get();
                return json_part(value, inner...).write();
            },
            [=](const CheckedJson& json) {
                Other value{};
                json_part(value, inner...).read(json);
                set(value);
            },
            [=] {
                Other value{};
                return json_part(value, inner...).schema();
            }};
}

/// null where it is empty or 0, or what else stands for none.
template <class T> JsonPart or_null(T& value, T none = T{}) {
    return through([&value, none] { return value == none ? std::nullopt : std::optional(value); },
                   [&value, none](const std::optional<T>& given) { value = given.value_or(none); });
}

/// Of a part that names what other members hold: read after those.
JsonPart in_turn(int turn, JsonPart part);

/// null unless it is there.
JsonPart null_unless(bool there, const JsonPart& part);

/// Of an optional value: {"not_measured": why} rather than null, read back into `back`.
JsonPart or_why(const JsonPart& optional, const std::string& why, std::string* back = nullptr);

/// One for each element of `list`, which another member of the JSON, `of`, made before.
template <class List, class Inner> JsonPart one_for_each(List& list, Inner inner, const std::string& of) {
    JsonPart part = json_part(list, inner);
    part.read = [&list, inner, of](const CheckedJson& json) {
        const std::vector<CheckedJson> entries = json.items();
        if (entries.size() != list.size())
            json.refuse(std::to_string(list.size()) + " entries, as " + of + " has");
        for (std::size_t i = 0; i < entries.size(); ++i)
            json_part(list[i], inner).read(entries[i]);
    };
    return part;
}

template <class Value> nlohmann::ordered_json schema_of_one(const std::vector<Value>& all) {
    Value one{};
    nlohmann::ordered_json schema = json_leaf(one).schema();
    if (!all.empty())
        schema = {{"enum", all}};
    return schema;
}
/// A number of an enumerator or an index, as that element of what `list` gives.
template <class E, class List> JsonPart one_of(E& value, List list) {
    return {[&value, list] { return nlohmann::ordered_json(list().at(static_cast<std::size_t>(value))); },
            [&value, list](const CheckedJson& json) { value = static_cast<E>(place_in(list(), json)); },
            [list] { return schema_of_one(list()); }};
}
/// The names of the first `count` enumerators, for one_of().
template <class E, class Name> auto names_of(Name name, int count) {
    return [=] {
        std::vector<std::string> names;
        for (int i = 0; i < count; ++i)
            names.emplace_back(name(static_cast<E>(i)));
        return names;
    };
}

template <class T, class... Inner> nlohmann::ordered_json as_json(const T& value, Inner... inner) {
    return json_part(const_cast<T&>(value), inner...).write(); // which only looks at it
}
/// The file has the text that json_text() has of as_json(); of each long list, one item at a time is in memory.
void write_json(const std::filesystem::path& file, const JsonMembers& members);
template <class T> void write_json(const std::filesystem::path& file, const T& value, JsonMembers (*members)(T&)) {
    write_json(file, members(const_cast<T&>(value))); // as above
}
/// Throws InputError for what is no such value, with its place.
template <class T, class... Inner> T from_json(const CheckedJson& json, Inner... inner) {
    T value{};
    json_part(value, inner...).read(json);
    return value;
}
/// A list of two.
template <class T> JsonPart both(T& first, T& second, JsonMembers (*members)(T&)) {
    return {[=, &first, &second] {
                return nlohmann::ordered_json::array({as_json(first, members), as_json(second, members)});
            },
            [=, &first, &second](const CheckedJson& json) {
                const std::vector<CheckedJson> two = json.items();
                if (two.size() != 2)
                    json.refuse("2 elements");
                JsonPart(members(first)).read(two[0]);
                JsonPart(members(second)).read(two[1]);
            },
            [=] {
                std::vector<T> none;
                return json_part(none, members).schema();
            }};
}
template <class T> std::string json_schema(JsonMembers (*members)(T&)) {
    T usual;
    return json_text(JsonPart(members(usual)).schema());
}

} // namespace fernlicht
