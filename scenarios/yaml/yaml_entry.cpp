#include "scenarios/yaml/yaml_entry.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/values/library_folders.h"
#include "scenarios/values/refusals.h"
#include "scenarios/yaml/old_names.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

std::string description(const YamlValue& value) {
    switch (value.kind) {
    case YamlValue::Kind::null:
        return "nothing";
    case YamlValue::Kind::list:
        return fmt::format("a list of {}", value.items.size());
    case YamlValue::Kind::map:
        return "a map";
    case YamlValue::Kind::scalar:
        break;
    }
    return fmt::format("{}'{}'", value.quoted ? "the text " : "", printable(value.text));
}

/// The whole text as T; nullopt when it is none, or when it was quoted.
template <class T> std::optional<T> parsed(const YamlValue& value) {
    if (value.kind != YamlValue::Kind::scalar || value.quoted)
        return std::nullopt;
    std::string_view text = value.text;
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    T result{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    if (error != std::errc{} || end != text.data() + text.size())
        return std::nullopt;
    return result;
}

/// "64.4" for the value 64,4; "" where it is no number with a decimal comma.
std::string with_point(YamlValue value) {
    const std::size_t comma = value.text.find(',');
    if (comma == std::string::npos || comma == 0 || comma + 1 == value.text.size())
        return {};
    value.text[comma] = '.';
    return parsed<double>(value) ? value.text : std::string();
}

std::string child_path(const std::string& parent, std::string_view key) {
    return parent.empty() ? printable(std::string(key)) : fmt::format("{}.{}", parent, printable(std::string(key)));
}

/// The known key that was meant: the same without its unit, else the nearest by letters; "" if none.
std::string meant_key(const std::string& key, std::span<const std::string_view> known_keys) {
    for (const std::string_view known : known_keys)
        if (known.starts_with(key + '_'))
            return std::string(known);
    return nearest_name(key, known_keys);
}

} // namespace

YamlEntry::YamlEntry(const YamlValue& value, const std::filesystem::path& file, std::string key_path)
    : value_(&value), file_(&file), key_path_(std::move(key_path)) {}

void YamlEntry::refuse(const std::string& found, const std::string& expected) const {
    throw InputError({*file_, value_->line, value_->column, key_path_}, found, expected);
}

void YamlEntry::refuse(const std::string& expected) const { refuse("found " + description(*value_), expected); }

double YamlEntry::number(double least, double greatest) const {
    const std::optional<double> number = parsed<double>(*value_);
    if (const std::string pointed = number ? "" : with_point(*value_); !pointed.empty())
        refuse("has a decimal comma: write " + pointed, "");
    if (!number)
        refuse("a number (units belong to the key)");
    if (!std::isfinite(*number))
        refuse("a finite number");
    if (*number < least || *number > greatest)
        refuse(fmt::format("a number from {} to {}", least, greatest));
    return *number;
}

double YamlEntry::number_above(double bound, double greatest) const {
    const double result = number(-HUGE_VAL, HUGE_VAL);
    if (!(result > bound) || result > greatest)
        refuse(fmt::format("a number above {}{}", bound, std::isfinite(greatest) ? fmt::format(", at most {}", greatest) : ""));
    return result;
}

int YamlEntry::whole(int least, int greatest) const {
    const std::optional<int> number = parsed<int>(*value_);
    if (!number || *number < least || *number > greatest)
        refuse(fmt::format("a whole number from {} to {}", least, greatest));
    return *number;
}

std::uint64_t YamlEntry::count() const {
    const std::optional<std::uint64_t> number = parsed<std::uint64_t>(*value_);
    if (!number)
        refuse("a whole number from 0 to 2^64 - 1");
    return *number;
}

bool YamlEntry::flag() const {
    if (is_scalar() && !value_->quoted && (value_->text == "true" || value_->text == "false"))
        return value_->text == "true";
    refuse("true or false");
}

std::string YamlEntry::text() const {
    if (!is_scalar() || value_->text.empty())
        refuse("text that is not empty");
    return value_->text;
}

std::string YamlEntry::name() const {
    std::string result = text();
    const auto allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
    };
    if (result.size() > 64 || result[0] == '.' || !std::all_of(result.begin(), result.end(), allowed))
        refuse("a name of at most 64 letters (a-z, A-Z), digits, '-', '_' and '.', not starting with '.'");
    return result;
}

std::size_t YamlEntry::choice(std::span<const std::string_view> choices) const {
    if (!is_scalar())
        refuse(fmt::format("one of {}", fmt::join(choices, ", ")));
    const auto found = std::find(choices.begin(), choices.end(), value_->text);
    if (found == choices.end())
        refuse(one_of_names(value_->text, {choices.begin(), choices.end()}));
    return static_cast<std::size_t>(found - choices.begin());
}

std::filesystem::path YamlEntry::path() const {
    const std::filesystem::path given = text();
    if (constexpr std::string_view ours = "fernlicht:"; given.string().starts_with(ours)) {
        const std::filesystem::path found = shipped_path(given.string().substr(ours.size()));
        if (found.empty()) {
            const std::string nearest = nearest_shipped(given.string().substr(ours.size()));
            refuse(fmt::format("'{}', which is no shipped file", printable(given, 400)),
                   nearest.empty() ? "one in " + library_places() : fmt::format("one as '{}{}'", ours, nearest));
        }
        return std::filesystem::absolute(found).lexically_normal();
    }
    refuse_windows_path(given, {*file_, value_->line, value_->column, key_path_});
    return std::filesystem::absolute(file_->parent_path() / given).lexically_normal();
}

std::vector<YamlEntry> YamlEntry::list(std::size_t least, std::size_t most) const {
    if (!is_list())
        refuse("a list");
    if (value_->items.size() < least || value_->items.size() > most)
        refuse(least == most ? fmt::format("a list of {}", least) : fmt::format("a list of {} to {}", least, most));
    std::vector<YamlEntry> entries;
    for (std::size_t i = 0; i < value_->items.size(); ++i)
        entries.emplace_back(value_->items[i], *file_, fmt::format("{}[{}]", key_path_, i));
    return entries;
}

std::vector<double> YamlEntry::numbers(std::size_t least, std::size_t most, double lowest, double highest) const {
    std::vector<double> result;
    EachRead each;
    for (const YamlEntry& entry : list(least, most))
        each([&] { result.push_back(entry.number(lowest, highest)); });
    each.end();
    return result;
}

YamlMap YamlEntry::map(std::span<const std::string_view> known_keys) const { return {*this, known_keys}; }
YamlMap YamlEntry::map(std::initializer_list<std::string_view> known_keys) const { return {*this, known_keys}; }

std::vector<std::pair<std::string, YamlEntry>> YamlEntry::named(std::size_t most) const {
    if (value_->kind != YamlValue::Kind::map)
        refuse("a map of names");
    if (value_->members.empty() || value_->members.size() > most)
        refuse(fmt::format("found {} names", value_->members.size()), fmt::format("1 to {}", most));
    std::vector<std::pair<std::string, YamlEntry>> entries;
    for (const YamlMember& member : value_->members) {
        YamlValue key;
        key.kind = YamlValue::Kind::scalar;
        key.text = member.key;
        key.line = member.line;
        key.column = member.column;
        entries.emplace_back(YamlEntry(key, *file_, key_path_).name(), YamlEntry(member.value, *file_, child_path(key_path_, member.key)));
    }
    return entries;
}

std::string one_of_names(const std::string& given, const std::vector<std::string>& known) {
    const std::string near = nearest_name(given, known);
    return fmt::format("one of {}{}", fmt::join(known, ", "), near.empty() ? "" : fmt::format(" (nearest: '{}')", near));
}

YamlMap::YamlMap(YamlEntry entry, std::span<const std::string_view> known_keys) : entry_(std::move(entry)) {
    if (entry_.value().kind != YamlValue::Kind::map)
        entry_.refuse(fmt::format("a map with keys such as {}", fmt::join(known_keys, ", ")));
    for (const YamlMember& member : entry_.value().members) {
        if (std::find(known_keys.begin(), known_keys.end(), member.key) != known_keys.end())
            continue;
        const auto refuse = [&](const char* found, const std::string& expected, std::string_view meant) {
            refuse_and_go_on({{entry_.file(), member.line, member.column, child_path(entry_.key_path(), member.key)}, found, expected},
                             meant.empty() ? "" : child_path(entry_.key_path(), meant));
        };
        if (const std::string_view now = name_of_today(member.key, known_keys); !now.empty())
            refuse("a key of version 0.1",
                   fmt::format("'{}', its name today; `fernlicht migrate --in-place {}` writes the file so", now,
                               printable(entry_.file().string(), 400)),
                   now);
        else if (const std::string near = meant_key(member.key, known_keys); !near.empty())
            refuse("unknown key", "'" + near + "', the nearest known key", near);
        else
            refuse("unknown key", fmt::format("one of {}", fmt::join(known_keys, ", ")), {});
    }
}

std::optional<YamlEntry> YamlMap::own(std::string_view key) const {
    const auto found = std::ranges::find(entry_.value().members, key, &YamlMember::key);
    if (found == entry_.value().members.end())
        return std::nullopt;
    return YamlEntry(found->value, entry_.file(), child_path(entry_.key_path(), key));
}

std::optional<YamlEntry> YamlMap::find(std::string_view key) const {
    std::optional<YamlEntry> found = own(key);
    return found || !behind_ ? found : behind_->find(key);
}

YamlEntry YamlMap::require(std::string_view key) const {
    if (std::optional<YamlEntry> found = find(key))
        return *found;
    refuse_missing(key, "this key, which has no default");
}

void YamlMap::refuse_missing(std::string_view key, const std::string& expected) const {
    throw InputError({entry_.file(), entry_.value().line, entry_.value().column, child_path(entry_.key_path(), key)}, "missing", expected);
}

std::optional<std::pair<std::string_view, YamlEntry>> YamlMap::one_of(std::initializer_list<std::string_view> keys) const {
    std::optional<std::pair<std::string_view, YamlEntry>> result;
    for (const std::string_view key : keys) {
        const std::optional<YamlEntry> found = own(key);
        if (found && result)
            found->refuse(fmt::format("'{}' beside '{}'", key, result->first), "one of them");
        if (found)
            result.emplace(key, *found);
    }
    return result || !behind_ ? result : behind_->one_of(keys);
}

double YamlMap::number_or(std::string_view key, double otherwise, double least, double greatest) const {
    const std::optional<YamlEntry> found = find(key);
    return found ? found->number(least, greatest) : otherwise;
}

bool YamlMap::flag_or(std::string_view key, bool otherwise) const {
    const std::optional<YamlEntry> found = find(key);
    return found ? found->flag() : otherwise;
}

} // namespace fernlicht
