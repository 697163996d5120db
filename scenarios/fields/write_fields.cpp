#include "scenarios/fields/write_fields.h"

#include "scenarios/yaml/yaml_tree.h"

#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/vec3.hpp>

namespace fernlicht {
namespace {

/// What visitors that change nothing look at.
void* look(const Field& field, const void* whole) { return field.member.look(const_cast<void*>(whole)); }
std::size_t size(const Field& field, const void* whole) { return field.member.size(const_cast<void*>(whole)); }
void* element(const Field& field, const void* whole, std::size_t i) { return field.member.element(const_cast<void*>(whole), i); }

std::string text_of(const Field& field, const void* value) {
    switch (field.kind) {
    case FieldKind::number:
        return fmt::format("{}", *static_cast<const double*>(value));
    case FieldKind::whole:
        return fmt::format("{}", *static_cast<const int*>(value));
    case FieldKind::flag:
        return fmt::format("{}", *static_cast<const bool*>(value));
    case FieldKind::choice: {
        int chosen = 0;
        std::memcpy(&chosen, value, sizeof chosen);
        return std::string(field.rule.words[static_cast<std::size_t>(chosen)]);
    }
    case FieldKind::text:
    case FieldKind::name:
        return fernlicht::quoted(*static_cast<const std::string*>(value));
    case FieldKind::path:
        return fernlicht::quoted(static_cast<const std::filesystem::path*>(value)->string());
    case FieldKind::names:
    case FieldKind::texts: {
        std::vector<std::string> names;
        for (const std::string& name : *static_cast<const std::vector<std::string>*>(value))
            names.push_back(fernlicht::quoted(name));
        return fmt::format("[{}]", fmt::join(names, ", "));
    }
    case FieldKind::numbers:
        return fmt::format("[{}]", fmt::join(*static_cast<const std::vector<double>*>(value), ", "));
    case FieldKind::position: {
        const auto& v = *static_cast<const glm::dvec3*>(value);
        return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
    }
    default:
        return "{" + flow_text(*field.group, value) + "}";
    }
}

std::string element_text(const Group& group, const void* value) {
    return group.is_bare ? value_text(group.fields.front(), value) : "{" + flow_text(group, value) + "}";
}

bool is_list(const Field& field) { return field.kind == FieldKind::named || field.kind == FieldKind::list; }

/// "key: value"; "" for what is not written.
std::string entry_text(const Field& field, const void* whole) {
    if (field.kind == FieldKind::inlined)
        return look(field, whole) ? flow_text(*field.group, look(field, whole)) : "";
    const std::string value = value_text(field, whole);
    if (value.empty())
        return "";
    if (field.rule.units.empty())
        return fmt::format("{}:{}{}", field.key, value.front() == '\n' ? "" : " ", value);
    const double number = *static_cast<const double*>(look(field, whole));
    return field.rule.degrees_where_exact ? angle_entry(field.key, number) : fmt::format("{}: {}", field.rule.units[1].key, value);
}

std::string lines_of_list(const Field& field, const void* whole, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    std::string lines = fmt::format("{}{}:\n", indent, field.key);
    for (std::size_t i = 0; i < size(field, whole); ++i) {
        void* const one = element(field, whole, i);
        const std::string start =
            field.kind == FieldKind::list ? indent + "  -" : fmt::format("{}  {}:", indent, fernlicht::quoted(*field.member.name_of(one)));
        if (!field.group->is_block)
            lines += fmt::format("{} {}\n", start, element_text(*field.group, one));
        else if (field.kind == FieldKind::list)
            lines += start + block_text(*field.group, one, depth + 2).substr(start.size());
        else
            lines += start + "\n" + block_text(*field.group, one, depth + 2);
    }
    return lines;
}

std::string lines_of(const Field& field, const void* whole, std::size_t depth) {
    if (field.kind == FieldKind::inlined)
        return look(field, whole) ? block_text(*field.group, look(field, whole), depth) : "";
    if (is_list(field) && size(field, whole) > 0)
        return lines_of_list(field, whole, depth);
    const std::string indent(2 * depth, ' ');
    if (field.kind == FieldKind::group && field.group->is_block && !field.text && look(field, whole))
        return fmt::format("{}{}:\n{}", indent, field.key, block_text(*field.group, look(field, whole), depth + 1));
    const std::string entry = entry_text(field, whole);
    return entry.empty() ? "" : indent + entry + "\n";
}

bool is_usual(const Group& group, const Field& field, const void* whole) {
    return value_text(field, whole) == value_text(field, group.usual.get());
}

bool is_written(const Group& group, const Field& field, const void* whole) {
    return !field.is_form && !(field.heard && !field.heard(whole)) && !(field.is_written_off_default && is_usual(group, field, whole));
}

} // namespace

std::string value_text(const Field& field, const void* whole) {
    if (field.text)
        return field.text(whole);
    if (is_list(field)) {
        std::vector<std::string> elements;
        for (std::size_t i = 0; i < size(field, whole); ++i)
            elements.push_back(element_text(*field.group, element(field, whole, i)));
        return field.kind == FieldKind::named ? "" : fmt::format("[{}]", fmt::join(elements, ", "));
    }
    const void* const value = look(field, whole);
    return value ? text_of(field, value) : std::string(field.absent_word);
}

std::string flow_text(const Group& group, const void* whole) {
    std::vector<std::string> entries;
    for (const Field& field : group.fields)
        if (is_written(group, field, whole))
            if (std::string entry = entry_text(field, whole); !entry.empty())
                entries.push_back(std::move(entry));
    return fmt::format("{}", fmt::join(entries, ", "));
}

std::string block_text(const Group& group, const void* whole, std::size_t depth) {
    std::string lines;
    for (const Field& field : group.fields)
        if (is_written(group, field, whole))
            lines += lines_of(field, whole, depth);
    return lines;
}

} // namespace fernlicht
