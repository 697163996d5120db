// JSON that others may have edited: every access says what was found, and where.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// A value within a file. Each function throws InputError with the file and the place when the value is not what is asked for.
class CheckedJson {
  public:
    /// Reads a file of at most 1 GiB.
    static CheckedJson read(const std::filesystem::path& file);
    /// As above; `file` only for messages.
    static CheckedJson parse(const std::string& content, const std::filesystem::path& file);

    CheckedJson at(const std::string& key) const;
    std::vector<CheckedJson> items() const; ///< of a list
    bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }
    std::vector<std::pair<std::string, std::string>> texts() const; ///< an object of texts, in the order of their names
    std::size_t size() const { return value_->size(); }             ///< members of an object, items of a list
    bool is_null() const { return value_->is_null(); }
    std::string text() const;
    double number() const;
    std::optional<double> number_or_null() const;
    int whole() const; ///< a number without fraction that fits an int
    std::uint64_t count() const;
    bool truth() const;
    /// Refuses a file that says it is something else.
    void expect_schema(const std::string& name, int version) const;
    std::string dump() const; ///< as JSON on one line
    [[noreturn]] void refuse(const std::string& expected) const;

  private:
    /// `root` keeps the document that `value` lies in.
    CheckedJson(std::shared_ptr<const nlohmann::json> root, const nlohmann::json& value, std::filesystem::path file, std::string place)
        : root_(std::move(root)), value_(&value), file_(std::move(file)), place_(std::move(place)) {}

    std::shared_ptr<const nlohmann::json> root_;
    const nlohmann::json* value_;
    std::filesystem::path file_;
    std::string place_;
};

} // namespace fernlicht
