#include "scenarios/fields/field_bits.h"

#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <glm/vec3.hpp>

namespace fernlicht {
namespace {

std::string group_bits(const Group& group, const void* whole, const void* usual, const std::string& above);

std::string double_bits(double value) { return fmt::format("{:016x}", std::bit_cast<std::uint64_t>(value)); }

std::string value_bits(const Field& field, const void* value) {
    std::string bits;
    switch (field.kind) {
    case FieldKind::number:
        return double_bits(*static_cast<const double*>(value));
    case FieldKind::whole:
    case FieldKind::choice: {
        int number = 0;
        std::memcpy(&number, value, sizeof number);
        return fmt::format("{}", number);
    }
    case FieldKind::flag:
        return *static_cast<const bool*>(value) ? "1" : "0";
    case FieldKind::text:
    case FieldKind::name:
        return quoted(*static_cast<const std::string*>(value));
    case FieldKind::path:
        return quoted(static_cast<const std::filesystem::path*>(value)->string());
    case FieldKind::names:
    case FieldKind::texts:
        for (const std::string& text : *static_cast<const std::vector<std::string>*>(value))
            bits += quoted(text);
        return "[" + bits + "]";
    case FieldKind::numbers:
        for (const double number : *static_cast<const std::vector<double>*>(value))
            bits += double_bits(number) + ",";
        return "[" + bits + "]";
    case FieldKind::position: {
        const auto& v = *static_cast<const glm::dvec3*>(value);
        return double_bits(v.x) + double_bits(v.y) + double_bits(v.z);
    }
    default:
        return bits; // has no value of its own
    }
}

std::string elements_bits(const Field& field, void* whole, const std::string& at) {
    std::string bits;
    for (std::size_t i = 0; i < field.member.size(whole); ++i) {
        void* const one = field.member.element(whole, i);
        const std::string* const name = field.kind == FieldKind::named ? field.member.name_of(one) : nullptr;
        bits += fmt::format("{}[{}]={}\n", at, i, name ? quoted(*name) : "");
        bits += group_bits(*field.group, one, field.group->usual.get(), fmt::format("{}[{}].", at, i));
    }
    return bits.empty() ? at + "=[]\n" : bits;
}

/// Nothing where the field is as in `usual`.
std::string field_bits_at(const Field& field, void* whole, void* usual, const std::string& at) {
    if (field.bits || field.kind == FieldKind::own) {
        const auto& tell = field.bits ? field.bits : field.text;
        const std::string told = tell(whole);
        return told == tell(usual) ? "" : fmt::format("{}={}\n", at, told);
    }
    if (field.kind == FieldKind::named || field.kind == FieldKind::list) {
        std::string elements = elements_bits(field, whole, at);
        return elements == elements_bits(field, usual, at) ? "" : elements;
    }
    const void *const value = field.member.look(whole), *const base = field.member.look(usual);
    if (!value)
        return base ? at + " absent\n" : "";
    if (field.group)
        return (base ? "" : at + " there\n") + group_bits(*field.group, value, base ? base : field.group->usual.get(), at + ".");
    std::string bits = value_bits(field, value);
    return base && bits == value_bits(field, base) ? "" : fmt::format("{}={}\n", at, bits);
}

std::vector<std::pair<std::string, std::string>> group_bits_by_key(const Group& group, const void* whole, const void* usual,
                                                                   const std::string& above) {
    std::vector<const Field*> by_id;
    for (const Field& field : group.fields)
        if (!field.is_form && (!field.heard || field.heard(whole)))
            by_id.push_back(&field);
    std::ranges::sort(by_id, {}, &Field::id);
    std::vector<std::pair<std::string, std::string>> all;
    for (const Field* field : by_id) // what is looked at here is not changed: members have one way to look for all visitors
        if (std::string bits =
                field_bits_at(*field, const_cast<void*>(whole), const_cast<void*>(usual), fmt::format("{}{}", above, field->id));
            !bits.empty())
            all.emplace_back(field->key, std::move(bits));
    return all;
}

std::string group_bits(const Group& group, const void* whole, const void* usual, const std::string& above) {
    std::string all;
    for (const auto& [key, bits] : group_bits_by_key(group, whole, usual, above))
        all += bits;
    return all;
}

} // namespace

std::string field_bits(const Group& group, const void* whole) { return group_bits(group, whole, group.usual.get(), ""); }

std::vector<std::pair<std::string, std::string>> field_bits_by_key(const Group& group, const void* whole) {
    return group_bits_by_key(group, whole, group.usual.get(), "");
}

} // namespace fernlicht
