// Typed reading of a YAML document: every refusal names file, line, column, key path, what was found and what was expected.
#pragma once

#include "scenarios/yaml/yaml_tree.h"

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fernlicht {

class YamlMap;

/// A value and the way to it. Points into the YamlValue and the path it was made from; both must outlive it.
class YamlEntry {
  public:
    YamlEntry(const YamlValue& value, const std::filesystem::path& file, std::string key_path);

    const YamlValue& value() const { return *value_; }
    const std::filesystem::path& file() const { return *file_; }
    const std::string& key_path() const { return key_path_; }
    bool is_scalar() const { return value_->kind == YamlValue::Kind::scalar; }
    bool is_list() const { return value_->kind == YamlValue::Kind::list; }

    /// Throws InputError at this value's place.
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    /// As above; `found` is a description of the value itself.
    [[noreturn]] void refuse(const std::string& expected) const;

    /// A finite number from `least` to `greatest`, both included. Never from quoted text.
    double number(double least, double greatest) const;
    double number_above(double bound, double greatest) const; ///< the bound itself excluded
    int whole(int least, int greatest) const;
    std::uint64_t count() const;
    bool flag() const;
    std::string text() const; ///< not empty
    /// Text that can be part of a file name and of a reading's name: letters, digits, `-`, `_`, `.`; at most 64, not starting with a dot.
    std::string name() const;
    /// Index of the text among `choices`; the refusal lists them and names the nearest.
    std::size_t choice(std::initializer_list<std::string_view> choices) const { return choice(std::span(choices.begin(), choices.size())); }
    std::size_t choice(std::span<const std::string_view> choices) const;
    /// Relative paths start at the folder of the YAML file. The result is absolute and normal. Existence is not asked.
    std::filesystem::path path() const;

    std::vector<YamlEntry> list(std::size_t least, std::size_t most) const;
    std::vector<double> numbers(std::size_t least, std::size_t most, double lowest, double highest) const;
    /// A map with these keys and no others.
    YamlMap map(std::span<const std::string_view> known_keys) const;
    YamlMap map(std::initializer_list<std::string_view> known_keys) const;
    /// A map whose keys are names that the user chooses.
    std::vector<std::pair<std::string, YamlEntry>> named(std::size_t most) const;

  private:
    const YamlValue* value_;
    const std::filesystem::path* file_;
    std::string key_path_;
};

/// What is expected of a name that none of `known` is: "one of a, b (nearest: 'b')".
std::string one_of_names(const std::string& given, const std::vector<std::string>& known);

/// A map whose keys are all known.
class YamlMap {
  public:
    YamlMap(YamlEntry entry, std::span<const std::string_view> known_keys);
    YamlMap(YamlEntry entry, std::initializer_list<std::string_view> known_keys)
        : YamlMap(std::move(entry), std::span(known_keys.begin(), known_keys.size())) {}

    /// This map in front of another, which gives what this one does not; it must outlive it.
    YamlMap before(const YamlMap* behind) && { return behind_ = behind, std::move(*this); }

    const YamlEntry& entry() const { return entry_; }
    const YamlMap* behind() const { return behind_; }
    std::optional<YamlEntry> find(std::string_view key) const; ///< nullopt: not given
    YamlEntry require(std::string_view key) const;
    [[noreturn]] void refuse_missing(std::string_view key, const std::string& expected) const;
    /// The one of `keys` that is given, if any, here or else behind; two of them refuse.
    std::optional<std::pair<std::string_view, YamlEntry>> one_of(std::initializer_list<std::string_view> keys) const;
    double number_or(std::string_view key, double otherwise, double least, double greatest) const;
    bool flag_or(std::string_view key, bool otherwise) const;

  private:
    std::optional<YamlEntry> own(std::string_view key) const;

    YamlEntry entry_;
    const YamlMap* behind_ = nullptr;
};

} // namespace fernlicht
