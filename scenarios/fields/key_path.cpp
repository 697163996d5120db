#include "scenarios/fields/key_path.h"

#include "scenarios/values/errors.h"
#include "scenarios/yaml/yaml_entry.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <string_view>
#include <utility>

namespace fernlicht {
namespace {

using Parts = std::vector<std::string>;

Parts parts_of_path(const std::string& path) {
    Parts parts(1);
    for (const char c : path)
        if (c == '.')
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

/// Keys of which one is given, never two, where no description of units says so; of what is first in a row the others are other ways.
constexpr std::array<std::array<std::string_view, 3>, 4> other_ways{{{"speed", "speed_kmh", "speed_mps"},
                                                                     {"step_s", "rate_hz", ""},
                                                                     {"fog", "extinction_per_m", ""},
                                                                     {"pitch_deg", "pitch_rad", "percent_down"}}};

/// One key of all that say the same.
std::string chief_key(const std::string& key) {
    for (const auto& ways : other_ways)
        if (std::ranges::count(ways, key) > 0)
            return std::string(ways.front());
    for (const auto& [from, to] : {std::pair<std::string_view, std::string_view>("_rad", "_deg"), {"_rad_s", "_deg_s"}})
        if (key.ends_with(from))
            return key.substr(0, key.size() - from.size()) + std::string(to);
    return key;
}

/// What the description says of a place: keys of a group, names, items, a value without keys, or nothing.
struct PathPlace {
    enum class Holds { keys, names, items, none, unknown };
    Holds holds = Holds::keys;
    const Group* group = nullptr;
    const Field* field = nullptr; ///< whose value, or element, stands there: says what its short forms are
};

using Holds = PathPlace::Holds;

const Field* field_with_key(const Group& group, std::string_view key) {
    for (const Field& field : group.fields)
        if (field.kind == FieldKind::inlined) {
            if (const Field* const inner = field_with_key(*field.group, key))
                return inner;
        } else if (std::ranges::count(keys_of(field), key) > 0)
            return &field;
    return nullptr;
}

PathPlace keys_at(const Field& field) {
    if (!field.group || field.group->is_bare)
        return {Holds::unknown, nullptr, &field};
    return {Holds::keys, field.group.get(), &field};
}

PathPlace place_of_value(const Field& field) {
    switch (field.kind) {
    case FieldKind::named:
        return {Holds::names, nullptr, &field};
    case FieldKind::list:
        return {Holds::items, nullptr, &field};
    case FieldKind::group:
    case FieldKind::own:
        return keys_at(field);
    case FieldKind::numbers:
    case FieldKind::position:
    case FieldKind::names:
    case FieldKind::texts:
        return {Holds::unknown, nullptr, &field};
    default:
        return {Holds::none, nullptr, &field};
    }
}

std::optional<std::size_t> number_of_item(const std::string& part) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    return error == std::errc{} && end == part.data() + part.size() ? std::optional(number) : std::nullopt;
}

std::string nearest_key(const Group& group, const std::string& key, const std::string& parent) {
    const std::vector<std::string_view> known = keys_of(group);
    const auto unit = std::ranges::find_if(known, [&](std::string_view one) { return one.starts_with(key + '_'); });
    const std::string near = unit != known.end() ? std::string(*unit) : nearest_name(key, known);
    const std::string where = parent.empty() ? "a drive" : parent;
    return near.empty() ? fmt::format("a key of {}: {}", where, fmt::join(known, ", "))
                        : fmt::format("'{}', the nearest known key of {}", near, where);
}

/// A document on the way to the value.
class ValueSetter {
  public:
    ValueSetter(const std::string& path, const YamlValue& value, const std::filesystem::path& file)
        : path_(path), parts_(parts_of_path(path)), value_(value), file_(file) {}

    std::size_t set(YamlValue& at, const PathPlace& place, std::size_t i, bool by_star) {
        if (i == parts_.size()) {
            at = value_;
            return 1;
        }
        switch (place.holds) {
        case Holds::keys:
            return set_key(at, place, i, by_star);
        case Holds::names:
            return set_named(at, place, i);
        case Holds::items:
            return set_item(at, keys_at(*place.field), i);
        default:
            return at.kind == YamlValue::Kind::list ? set_item(at, {Holds::unknown, nullptr, place.field}, i) : set_unknown(at, place, i);
        }
    }

    [[noreturn]] void refuse_path(const std::string& found, const std::string& expected) const {
        throw InputError({file_, 0, 0, path_}, found, expected);
    }

  private:
    std::string until(std::size_t i) const {
        return fmt::format("{}", fmt::join(parts_.begin(), parts_.begin() + static_cast<std::ptrdiff_t>(i), "."));
    }

    /// A map in place of its short form.
    void make_map(YamlValue& at, const Field* field, std::size_t i) const {
        if (at.kind == YamlValue::Kind::map)
            return;
        YamlValue map;
        map.kind = YamlValue::Kind::map;
        map.line = at.line;
        map.column = at.column;
        const bool is_list = at.kind == YamlValue::Kind::list, is_scalar = at.kind == YamlValue::Kind::scalar;
        const bool is_short = field && !field->short_key.empty() && (field->short_is_list ? is_list : is_scalar);
        const bool is_word = field && is_scalar && (field->may_be_flag || std::ranges::count(field->default_word, at.text) > 0);
        if (is_short && !is_word)
            map.members.push_back({std::string(field->short_key), at.line, at.column, at});
        else if (at.kind != YamlValue::Kind::null && !is_word)
            refuse_path(fmt::format("found {} in {}", is_scalar ? "'" + printable(at.text) + "'" : "a list", until(i)),
                        "a map, so that a key in it can be set");
        at = std::move(map);
    }

    YamlMember& member(YamlValue& map, const std::string& key) const {
        const auto found = std::ranges::find(map.members, key, &YamlMember::key);
        if (found != map.members.end())
            return *found;
        return map.members.emplace_back(YamlMember{key, map.line, map.column, {}});
    }

    std::size_t set_key(YamlValue& at, const PathPlace& place, std::size_t i, bool by_star) {
        make_map(at, place.field, i);
        const Field* const field = field_with_key(*place.group, parts_[i]);
        if (!field)
            refuse_path("unknown key", nearest_key(*place.group, parts_[i], until(i)));
        const bool is_there = std::ranges::count(at.members, parts_[i], &YamlMember::key) > 0;
        if (by_star && !is_there && field->heard) // a place ahead for one that comes the other way
            return 0;
        drop_other_ways(at, *field, parts_[i]);
        const std::size_t places = set(member(at, parts_[i]).value, place_of_value(*field), i + 1, by_star);
        if (places == 0 && !is_there)
            std::erase_if(at.members, [&](const YamlMember& one) { return one.key == parts_[i]; });
        return places;
    }

    /// One of them is given, never two.
    static void drop_other_ways(YamlValue& map, const Field& field, const std::string& key) {
        std::vector<std::string_view> ways = keys_of(field);
        for (const auto& alike : other_ways)
            if (std::ranges::count(alike, key) > 0)
                ways.insert(ways.end(), alike.begin(), alike.end());
        std::erase_if(map.members, [&](const YamlMember& one) { return one.key != key && std::ranges::count(ways, one.key) > 0; });
    }

    std::size_t set_named(YamlValue& at, const PathPlace& place, std::size_t i) {
        if (at.kind != YamlValue::Kind::map && at.kind != YamlValue::Kind::null)
            return 0;
        const PathPlace element = keys_at(*place.field);
        std::size_t places = 0;
        std::vector<std::string> known;
        for (YamlMember& one : at.members) {
            known.push_back(one.key);
            if (parts_[i] == "*" || parts_[i] == one.key)
                places += set(one.value, element, i + 1, parts_[i] == "*");
        }
        if (places > 0 || parts_[i] == "*" || known.empty())
            return places;
        refuse_path(fmt::format("no '{}' in {}", printable(parts_[i]), until(i)), one_of_names(parts_[i], known));
    }

    std::size_t set_item(YamlValue& at, const PathPlace& element, std::size_t i) {
        const std::optional<std::size_t> number = number_of_item(parts_[i]);
        std::size_t places = 0;
        for (std::size_t k = 0; k < at.items.size(); ++k)
            if (parts_[i] == "*" || number == k)
                places += set(at.items[k], element, i + 1, parts_[i] == "*");
        return places;
    }

    std::size_t set_unknown(YamlValue& at, const PathPlace& place, std::size_t i) {
        make_map(at, place.field, i);
        return set(member(at, parts_[i]).value, {Holds::unknown, nullptr, nullptr}, i + 1, false);
    }

    const std::string& path_;
    const Parts parts_;
    const YamlValue& value_;
    const std::filesystem::path& file_;
};

} // namespace

std::string unknown_in_path(const Group& group, const std::string& path) {
    PathPlace place{Holds::keys, &group, nullptr};
    std::string parent;
    for (const std::string& part : parts_of_path(path)) {
        if (part.empty())
            return "keys with one dot between them";
        switch (place.holds) {
        case Holds::keys: {
            const Field* const field = field_with_key(*place.group, part);
            if (!field)
                return nearest_key(*place.group, part, parent);
            place = place_of_value(*field);
            break;
        }
        case Holds::names:
            place = keys_at(*place.field);
            break;
        case Holds::items:
            if (part != "*" && !number_of_item(part))
                return fmt::format("the number of an item of {}, from 0, or *", parent);
            place = keys_at(*place.field);
            break;
        case Holds::none:
            return fmt::format("'{}', which has no keys", parent);
        case Holds::unknown:
            break;
        }
        parent += (parent.empty() ? "" : ".") + part;
    }
    return "";
}

void set_value(YamlValue& document, const Group& group, const std::string& path, const YamlValue& value,
               const std::filesystem::path& file) {
    ValueSetter setter(path, value, file);
    if (setter.set(document, {Holds::keys, &group, nullptr}, 0, false) == 0)
        setter.refuse_path("found nothing there", "something that this path names");
}

bool paths_overlap(const std::string& a, const std::string& b) {
    const Parts left = parts_of_path(a), right = parts_of_path(b);
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
        if (left[i] != "*" && right[i] != "*" && chief_key(left[i]) != chief_key(right[i]))
            return false;
    return true;
}

} // namespace fernlicht
