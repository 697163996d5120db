#include "runner/files/checked_json.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <fmt/format.h>
#include <limits>

namespace fernlicht {

CheckedJson CheckedJson::read(const std::filesystem::path& file) {
    FilesRead opened;
    return parse(read_file(file, opened, std::size_t{1} << 30), file);
}

CheckedJson CheckedJson::parse(const std::string& content, const std::filesystem::path& file) {
    constexpr int deepest = 64; // ours have a dozen; what shows a refused value calls itself once a level
    const auto watch = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        if (depth > deepest)
            throw InputError({file, 0, 0, {}}, fmt::format("is JSON nested deeper than {} levels", deepest));
        return true;
    };
    auto root = std::make_shared<const nlohmann::json>(nlohmann::json::parse(content, watch, false));
    if (root->is_discarded())
        throw InputError({file, 0, 0, {}}, "is no JSON, or only part of it");
    return {root, *root, file, ""};
}

std::string CheckedJson::dump() const { return value_->dump(-1, ' ', true, nlohmann::json::error_handler_t::replace); }

void CheckedJson::refuse(const std::string& expected) const {
    throw InputError({file_, 0, 0, place_}, "found '" + printable(dump()) + "'", expected);
}

CheckedJson CheckedJson::at(const std::string& key) const {
    if (!value_->is_object())
        refuse("an object");
    const auto found = value_->find(key);
    const std::string place = place_.empty() ? key : place_ + "." + key;
    if (found == value_->end())
        throw InputError({file_, 0, 0, place}, "is missing");
    return {root_, *found, file_, place};
}

std::vector<CheckedJson> CheckedJson::items() const {
    if (!value_->is_array())
        refuse("a list");
    std::vector<CheckedJson> result;
    for (std::size_t i = 0; i < value_->size(); ++i)
        result.push_back({root_, (*value_)[i], file_, fmt::format("{}[{}]", place_, i)});
    return result;
}

std::vector<std::pair<std::string, std::string>> CheckedJson::texts() const {
    if (!value_->is_object())
        refuse("an object");
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& [key, ignored] : value_->items())
        result.emplace_back(key, at(key).text());
    return result;
}

std::string CheckedJson::text() const {
    if (!value_->is_string())
        refuse("a text");
    return value_->get<std::string>();
}

double CheckedJson::number() const {
    if (!value_->is_number())
        refuse("a number");
    return value_->get<double>();
}

std::optional<double> CheckedJson::number_or_null() const { return is_null() ? std::nullopt : std::optional(number()); }

int CheckedJson::whole() const {
    if (!value_->is_number_integer() || *value_ < std::numeric_limits<int>::min() || *value_ > std::numeric_limits<int>::max())
        refuse("a whole number");
    return value_->get<int>();
}

std::uint64_t CheckedJson::count() const {
    if (!value_->is_number_unsigned())
        refuse("a whole number of at least 0");
    return value_->get<std::uint64_t>();
}

bool CheckedJson::truth() const {
    if (!value_->is_boolean())
        refuse("true or false");
    return value_->get<bool>();
}

void CheckedJson::expect_schema(const std::string& name, int version) const {
    if (const CheckedJson schema = at("schema"); schema.text() != name)
        schema.refuse(name);
    if (const CheckedJson given = at("schema_version"); given.whole() != version)
        given.refuse(fmt::format("version {}", version));
}

} // namespace fernlicht
