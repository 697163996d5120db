#include "scenarios/fields/key_table.h"

#include "scenarios/fields/write_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

std::string allowed(const Field& field) {
    const FieldRule& rule = field.rule;
    switch (field.kind) {
    case FieldKind::number:
        return fmt::format("{}{} to {}{}", rule.is_above ? "above " : "", rule.least, rule.refused_as.empty() ? "" : "below ",
                           rule.greatest);
    case FieldKind::whole:
        return fmt::format("whole, {} to {}", rule.least, rule.greatest);
    case FieldKind::flag:
        return "true, false";
    case FieldKind::text:
        return "text";
    case FieldKind::name:
        return "a name";
    case FieldKind::path:
        return "a file";
    case FieldKind::texts:
        return fmt::format("{} to {} texts", rule.fewest, rule.most);
    case FieldKind::names:
        return fmt::format("{} to {} names", rule.fewest, rule.most);
    case FieldKind::choice:
        return fmt::format("{}", fmt::join(rule.words, ", "));
    case FieldKind::numbers:
        return fmt::format("{} to {} numbers from {} to {}", rule.fewest, rule.most, rule.least, rule.greatest);
    case FieldKind::position:
        return fmt::format("[x, y, z], each {} to {}", rule.least, rule.greatest);
    case FieldKind::group:
        if (field.may_be_flag)
            return "true, false, keys below";
        if (!field.default_word.empty())
            return fmt::format("{}, keys below", field.default_word.front());
        return field.short_key.empty() ? "keys below" : fmt::format("{} alone, keys below", field.short_key);
    case FieldKind::named:
        return fmt::format("{} to {} by name", rule.fewest, rule.most);
    case FieldKind::list:
        return fmt::format("list of {} to {}", rule.fewest, rule.most);
    case FieldKind::own:
    case FieldKind::inlined:
        return "";
    }
    return "";
}

std::string by_default(const Field& field, const void* usual) {
    if (field.is_required)
        return "must be given";
    if (!usual || field.is_form || field.kind == FieldKind::group)
        return "";
    const std::string text = value_text(field, usual);
    return text.size() > 40 ? "" : text;
}

void add_rows(std::string& text, const Group& group, const void* usual) {
    for (const Field& field : group.fields) {
        if (field.kind == FieldKind::inlined && field.is_form) {
            text += fmt::format("| {} | | | | |\n", field.meaning);
            continue;
        }
        if (field.kind == FieldKind::inlined) {
            const void* const inner = usual ? field.member.look(const_cast<void*>(usual)) : nullptr;
            add_rows(text, *field.group, inner ? inner : field.group->usual.get());
            continue;
        }
        if (field.rule.units.empty()) {
            text += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.key, unit_of(field.key), allowed(field), by_default(field, usual),
                                field.meaning);
            continue;
        }
        const FieldUnit &first = field.rule.units[0], &second = field.rule.units[1];
        text += fmt::format("| `{}` or `{}` | {}, {} | {:.6g} to {:.6g} {} | {} {} | {} |\n", first.key, second.key, unit_of(first.key),
                            unit_of(second.key), first.least, first.greatest, unit_of(first.key), by_default(field, usual),
                            unit_of(second.key), field.meaning);
    }
}

} // namespace

std::string key_tables(const std::string& path, const Group& group, const void* usual) {
    std::string text =
        fmt::format("## {}\n\n| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n", path.empty() ? "At the top" : path);
    add_rows(text, group, usual);
    text += "\n";
    for (const Field& field : group.fields) {
        if (!field.group || field.kind == FieldKind::inlined || field.group->is_bare || !field.group->definition.empty())
            continue;
        const bool is_list = field.kind != FieldKind::group;
        const void* inner = is_list || !usual ? nullptr : field.member.look(const_cast<void*>(usual));
        const std::string_view end = field.kind == FieldKind::named ? ".NAME" : field.kind == FieldKind::list ? "[]" : "";
        text += key_tables(fmt::format("{}{}{}{}", path, path.empty() ? "" : ".", field.key, end), *field.group,
                           inner ? inner : field.group->usual.get());
    }
    return text;
}

} // namespace fernlicht
