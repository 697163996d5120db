#include "scenarios/models/gltf_file.h"

#include "scenarios/values/errors.h"

#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string described(const nlohmann::json& value) {
    if (value.is_structured())
        return fmt::format("{} of {}", value.is_array() ? "a list" : "an object", value.size());
    return printable(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

} // namespace

void GltfEntry::refuse(const std::string& found, const std::string& expected) const {
    throw InputError({*file_, 0, 0, printable(way_, 120)}, found, expected);
}
void GltfEntry::refuse(const std::string& expected) const { refuse("found " + described(*value_), expected); }

bool GltfEntry::is_object() const { return value_->is_object(); }

std::optional<GltfEntry> GltfEntry::find(std::string_view key) const {
    if (!value_->is_object())
        refuse("an object");
    const auto it = value_->find(key);
    if (it == value_->end())
        return std::nullopt;
    return GltfEntry(*it, *file_, way_.empty() ? std::string(key) : fmt::format("{}.{}", way_, key));
}

GltfEntry GltfEntry::require(std::string_view key) const {
    if (auto found = find(key))
        return *found;
    refuse(fmt::format("has no \"{}\"", key), "one");
}

std::size_t GltfEntry::list_size(std::string_view key) const {
    const auto found = find(key);
    if (!found)
        return 0;
    if (!found->value_->is_array())
        found->refuse("a list");
    return found->value_->size();
}

GltfEntry GltfEntry::at(std::string_view key, std::size_t index) const {
    const GltfEntry found = require(key);
    return {(*found.value_)[index], *file_, fmt::format("{}[{}]", found.way_, index)};
}

std::vector<GltfEntry> GltfEntry::list(std::string_view key) const {
    std::vector<GltfEntry> all;
    for (std::size_t i = 0, count = list_size(key); i < count; ++i)
        all.push_back(at(key, i));
    return all;
}

std::string GltfEntry::text() const {
    if (!value_->is_string())
        refuse("text");
    return value_->get<std::string>();
}

std::string GltfEntry::text_or(std::string_view key, const std::string& otherwise) const {
    const auto found = find(key);
    return found ? found->text() : otherwise;
}

double GltfEntry::number() const {
    if (!value_->is_number() || !std::isfinite(value_->get<double>()))
        refuse("a number");
    return value_->get<double>();
}

double GltfEntry::number_or(std::string_view key, double otherwise) const {
    const auto found = find(key);
    return found ? found->number() : otherwise;
}

bool GltfEntry::flag_or(std::string_view key, bool otherwise) const {
    const auto found = find(key);
    if (found && !found->value_->is_boolean())
        found->refuse("true or false");
    return found ? found->value_->get<bool>() : otherwise;
}

std::vector<double> GltfEntry::numbers(std::size_t count) const {
    if (!value_->is_array() || value_->size() != count)
        refuse(fmt::format("{} numbers", count));
    std::vector<double> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(GltfEntry((*value_)[i], *file_, fmt::format("{}[{}]", way_, i)).number());
    return all;
}

std::size_t GltfEntry::whole(std::size_t most) const {
    const double value = number();
    if (!(value >= 0.0) || value > static_cast<double>(most) || value != std::floor(value))
        refuse(fmt::format("a whole number from 0 to {}", most));
    return static_cast<std::size_t>(value);
}

std::size_t GltfEntry::whole_or(std::string_view key, std::size_t otherwise, std::size_t most) const {
    const auto found = find(key);
    return found ? found->whole(most) : otherwise;
}

std::optional<GltfEntry> GltfEntry::extension(std::string_view name) const {
    const auto all = find("extensions");
    return all ? all->find(name) : std::nullopt;
}

std::size_t GltfEntry::index(std::size_t count, std::string_view what) const {
    const double value = number();
    if (!(value >= 0.0) || value >= static_cast<double>(count) || value != std::floor(value))
        refuse(count == 0 ? fmt::format("none, as the file has no {}", what)
                          : fmt::format("0 to {}, as the file has {} {}", count - 1, count, what));
    return static_cast<std::size_t>(value);
}

} // namespace fernlicht
