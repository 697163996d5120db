#include "scenarios/fields/key_list.h"

#include "scenarios/fields/write_fields.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

/// "1e6" for 1e+06.
std::string number_text(double value) {
    const std::string text = fmt::format("{:.5g}", value);
    const std::size_t at = text.find('e');
    return at == std::string::npos ? text : fmt::format("{}e{}", text.substr(0, at), std::stoi(text.substr(at + 1)));
}

std::string range_text(const FieldRule& rule) {
    if (rule.least <= -1e12 && rule.greatest >= 1e12)
        return "number";
    return fmt::format("{}{}..{}{}", rule.is_above ? ">" : "", number_text(rule.least), rule.refused_as.empty() ? "" : "<",
                       number_text(rule.greatest));
}

/// "1..16", "2".
std::string count_text(const FieldRule& rule) {
    return rule.fewest == rule.most ? fmt::format("{}", rule.fewest) : fmt::format("{}..{}", rule.fewest, rule.most);
}

std::string allowed(const Field& field) {
    const FieldRule& rule = field.rule;
    const std::string unit = unit_of(field.key).empty() ? "" : " " + std::string(unit_of(field.key));
    switch (field.kind) {
    case FieldKind::number:
        return range_text(rule) + unit;
    case FieldKind::whole:
        return "whole " + range_text(rule) + unit;
    case FieldKind::text:
        return "text";
    case FieldKind::name:
        return "name";
    case FieldKind::path:
        return "file";
    case FieldKind::texts:
        return count_text(rule) + " texts";
    case FieldKind::names:
        return count_text(rule) + " names";
    case FieldKind::numbers:
        return fmt::format("{} numbers {}{}", count_text(rule), range_text(rule), unit);
    case FieldKind::position:
        return fmt::format("[x, y, z] {}{}", range_text(rule), unit);
    case FieldKind::group:
        return field.may_be_flag             ? "true, false"
               : !field.default_word.empty() ? std::string(field.default_word.front())
               : field.short_key.empty()     ? ""
                                             : fmt::format("`{}` alone", field.short_key);
    case FieldKind::named:
        return count_text(rule) + " by name";
    case FieldKind::list:
        return "list of " + count_text(rule);
    case FieldKind::choice:
    case FieldKind::flag:
        return "";
    case FieldKind::own:
    case FieldKind::inlined:
        return std::string(unit_of(field.key));
    }
    return "";
}

std::string by_default(const Field& field, const void* usual) {
    if (field.is_required || !usual || field.is_form || field.kind == FieldKind::group)
        return "";
    std::string text = value_text(field, usual);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"')
        text = text.substr(1, text.size() - 2);
    if (!field.rule.units.empty() && !text.empty()) { // in the first unit, where its ratio to the struct's is all there is between them
        const auto stored = field.rule.units[0].stored;
        const double ratio = stored(1.0);
        return stored(0.0) == 0.0 && ratio != 0.0 ? number_text(std::strtod(text.c_str(), nullptr) / ratio) : "";
    }
    if (field.kind == FieldKind::number && !text.empty())
        text = number_text(std::strtod(text.c_str(), nullptr));
    return text.size() > 40 || text == "[]" ? "" : text;
}

/// Where the keys of a field's value stand.
std::string path_below(const std::string& path, const Field& field) {
    if (!field.group->definition.empty())
        return std::string(field.group->definition);
    const char* const end = field.kind == FieldKind::named ? ".NAME" : field.kind == FieldKind::list ? "[]" : "";
    return fmt::format("{}{}{}{}", path, path.empty() ? "" : ".", field.key, end);
}

bool has_keys_below(const Field& field) { return field.group && field.kind != FieldKind::inlined && !field.group->is_bare; }

void add_lines(std::vector<KeyLine>& lines, const std::string& path, const Group& group, const void* usual) {
    for (const Field& field : group.fields) {
        if (field.kind == FieldKind::inlined && !field.is_form) {
            const void* const inner = usual ? field.member.look(const_cast<void*>(usual)) : nullptr;
            add_lines(lines, path, *field.group, inner ? inner : field.group->usual.get());
            continue;
        }
        KeyLine line;
        line.meaning = field.meaning;
        if (field.kind == FieldKind::inlined) {
            line.below = field.group->definition;
            lines.push_back(std::move(line));
            continue;
        }
        line.names = {field.key};
        line.allowed = allowed(field);
        line.words.assign(field.rule.words.begin(), field.rule.words.end());
        if (field.kind == FieldKind::flag)
            line.words = {"true", "false"};
        if (has_keys_below(field))
            line.below = path_below(path, field);
        line.usual = by_default(field, usual);
        line.is_required = field.is_required;
        if (!field.rule.units.empty()) {
            const FieldUnit &first = field.rule.units[0], &second = field.rule.units[1];
            line.names = {first.key, second.key};
            line.allowed = fmt::format("{} {}", range_text({first.least, first.greatest}), unit_of(first.key));
        }
        lines.push_back(std::move(line));
    }
}

void add_lists_below(std::vector<KeyList>& lists, const std::string& path, const Group& group, const void* usual);

void add_lists(std::vector<KeyList>& lists, const std::string& path, const Group& group, const void* usual) {
    KeyList& list = lists.emplace_back();
    list.path = path;
    list.stands_for_several = !group.definition.empty();
    add_lines(list.lines, path, group, usual);
    add_lists_below(lists, path, group, usual);
}

void add_lists_below(std::vector<KeyList>& lists, const std::string& path, const Group& group, const void* usual) {
    for (const Field& field : group.fields) {
        const bool is_inlined = field.kind == FieldKind::inlined && !field.is_form;
        if (!field.group || !field.group->definition.empty() || !(is_inlined || has_keys_below(field)))
            continue;
        const bool is_one = field.kind == FieldKind::group || is_inlined;
        const void* inner = is_one && usual && !field.is_form ? field.member.look(const_cast<void*>(usual)) : nullptr;
        inner = inner ? inner : field.group->usual.get();
        if (is_inlined)
            add_lists_below(lists, path, *field.group, inner);
        else
            add_lists(lists, path_below(path, field), *field.group, inner);
    }
}

} // namespace

std::vector<KeyList> key_lists(const std::string& path, const Group& group, const void* usual) {
    std::vector<KeyList> lists;
    add_lists(lists, path, group, usual);
    return lists;
}

std::map<std::string_view, const Group*> definitions(const Group& group) {
    std::map<std::string_view, const Group*> found;
    for (const Field& field : group.fields)
        if (field.group) {
            if (!field.group->definition.empty())
                found.emplace(field.group->definition, field.group.get());
            found.merge(definitions(*field.group));
        }
    return found;
}

} // namespace fernlicht
