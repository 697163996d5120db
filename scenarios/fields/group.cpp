#include "scenarios/fields/field.h"
#include "scenarios/values/pose.h"

#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

const Field* find_field(const Group& group, std::string_view key) {
    for (const Field& field : group.fields)
        if (field.kind != FieldKind::inlined && field.key == key)
            return &field;
        else if (const Field* const inner = field.kind == FieldKind::inlined ? find_field(*field.group, key) : nullptr)
            return inner;
    return nullptr;
}

double as_given(double value) { return value; }
double from_degrees(double value) { return radians(value); }
double from_kmh(double value) { return value / 3.6; }

} // namespace

FieldRule::FieldRule(double least_value, double greatest_value, std::size_t fewest_elements, std::size_t most_elements,
                     std::vector<std::string_view> in_order)
    : least(least_value), greatest(greatest_value), fewest(fewest_elements), most(most_elements), words(std::move(in_order)) {}
FieldRule::FieldRule(const FieldRule&) = default;
FieldRule::FieldRule(FieldRule&&) noexcept = default;
FieldRule& FieldRule::operator=(const FieldRule&) = default;
FieldRule::~FieldRule() = default;

Field::Field(std::string_view its_key, int its_id, FieldKind its_kind, Member its_member, std::string_view its_meaning)
    : key(its_key), id(its_id), kind(its_kind), member(its_member), meaning(its_meaning) {}
Field::Field(const Field&) = default;
Field::Field(Field&&) noexcept = default;
Field& Field::operator=(const Field&) = default;
Field::~Field() = default;

const Field& field_named(const Group& group, std::string_view key) {
    const Field* const found = find_field(group, key);
    return found ? *found : throw std::logic_error(fmt::format("no field '{}' is described", key));
}

std::vector<std::string_view> keys_of(const Field& field) {
    if (field.kind == FieldKind::inlined)
        return keys_of(*field.group);
    if (field.rule.units.empty())
        return {field.key};
    return {field.rule.units[0].key, field.rule.units[1].key};
}

std::vector<std::string_view> keys_of(const Group& group) {
    std::vector<std::string_view> keys;
    for (const Field& field : group.fields)
        for (const std::string_view key : keys_of(field))
            keys.push_back(key);
    return keys;
}

std::string_view unit_of(std::string_view key) {
    // Longer ends first: cornering_stiffness_n_per_rad is no angle.
    static constexpr std::pair<std::string_view, std::string_view> units[] = {{"_nm_per_rad", "N m/rad"},
                                                                              {"_n_per_rad", "N/rad"},
                                                                              {"_n_per_m", "N/m"},
                                                                              {"_ns_per_m", "Ns/m"},
                                                                              {"_per_m", "1/m"},
                                                                              {"_kgm2", "kg m²"},
                                                                              {"_cdm2", "cd/m²"},
                                                                              {"_deg_s", "°/s"},
                                                                              {"_rad_s", "rad/s"},
                                                                              {"_percent", "%"},
                                                                              {"_kmh", "km/h"},
                                                                              {"_mps", "m/s"},
                                                                              {"_deg", "°"},
                                                                              {"_rad", "rad"},
                                                                              {"_kg", "kg"},
                                                                              {"_hz", "Hz"},
                                                                              {"_lx", "lx"},
                                                                              {"_cd", "cd"},
                                                                              {"_m2", "m²"},
                                                                              {"_px", "px"},
                                                                              {"_years", "a"},
                                                                              {"_per_second", "1/s"},
                                                                              {"_m", "m"},
                                                                              {"_n", "N"},
                                                                              {"_s", "s"},
                                                                              {"_v", "V"},
                                                                              {"_h", "h"},
                                                                              {"_k", "K"}};
    for (const auto& [end, unit] : units)
        if (key.ends_with(end) || key == end.substr(1))
            return key.size() == 1 ? "" : unit;
    return "";
}

FieldRule units(FieldUnit first, FieldUnit own) {
    FieldRule rule;
    rule.units = {std::move(first), std::move(own)};
    return rule;
}

FieldRule degrees_within(std::string_view key, double limit_deg) {
    FieldRule rule = units({std::string(key) + "_deg", from_degrees, -limit_deg, limit_deg},
                           {std::string(key) + "_rad", as_given, -radians(limit_deg), radians(limit_deg)});
    rule.degrees_where_exact = true;
    return rule;
}

FieldRule in_radians(std::string_view key, double limit_deg) {
    FieldRule rule = degrees_within(key, limit_deg);
    rule.degrees_where_exact = false;
    return rule;
}

FieldRule speed(std::string_view key) {
    return units({std::string(key) + "_kmh", from_kmh, 0.0, 540.0}, {std::string(key) + "_mps", as_given, 0.0, 150.0});
}

FieldRule angular_speed(std::string_view key, double min_deg_s, double max_deg_s, double min_rad_s, double max_rad_s) {
    return units({std::string(key) + "_deg_s", from_degrees, min_deg_s, max_deg_s},
                 {std::string(key) + "_rad_s", as_given, min_rad_s, max_rad_s});
}

} // namespace fernlicht
