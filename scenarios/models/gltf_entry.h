// A value of a glTF file's JSON and the way to it: every refusal names file, way, what was found and what was expected.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Points into the JSON and the path it was made from; both must outlive it.
class GltfEntry {
  public:
    GltfEntry(const nlohmann::json& value, const std::filesystem::path& file, std::string way)
        : value_(&value), file_(&file), way_(std::move(way)) {}

    const nlohmann::json& value() const { return *value_; }
    const std::filesystem::path& file() const { return *file_; }
    const std::string& way() const { return way_; }
    [[noreturn]] void refuse(const std::string& found, const std::string& expected) const;
    [[noreturn]] void refuse(const std::string& expected) const; ///< found: a description of the value itself

    bool is_object() const;
    std::optional<GltfEntry> find(std::string_view key) const; ///< nullopt: not given. Refuses where this is no object
    GltfEntry require(std::string_view key) const;
    std::vector<GltfEntry> list(std::string_view key) const; ///< empty where it is not given
    std::size_t list_size(std::string_view key) const;
    GltfEntry at(std::string_view key, std::size_t index) const; ///< a member of a list that is long enough

    std::string text() const;
    std::string text_or(std::string_view key, const std::string& otherwise) const;
    double number() const; ///< finite
    double number_or(std::string_view key, double otherwise) const;
    bool flag_or(std::string_view key, bool otherwise) const;
    /// Exactly so many finite numbers.
    std::vector<double> numbers(std::size_t count) const;
    std::size_t whole(std::size_t most) const;
    std::size_t whole_or(std::string_view key, std::size_t otherwise, std::size_t most) const;
    /// An index into a list of `count`; `what` names it: "accessors".
    std::size_t index(std::size_t count, std::string_view what) const;

  private:
    const nlohmann::json* value_;
    const std::filesystem::path* file_;
    std::string way_;
};

} // namespace fernlicht
