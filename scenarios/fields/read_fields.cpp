#include "scenarios/fields/read_fields.h"

#include "scenarios/values/refusals.h"
#include "scenarios/values/xml_file.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/vec3.hpp>

namespace fernlicht {
namespace {

template <class T> T& as(void* value) { return *static_cast<T*>(value); }

double number(const FieldRule& rule, const YamlEntry& entry) {
    if (rule.refused_as.empty())
        return rule.is_above ? entry.number_above(rule.least, rule.greatest) : entry.number(rule.least, rule.greatest);
    const double value = entry.number(-HUGE_VAL, HUGE_VAL);
    if (!(value >= rule.least && value < rule.greatest))
        entry.refuse(std::string(rule.refused_as));
    return value;
}

void read_named(const Field& field, const YamlEntry& entry, void* whole) {
    field.member.clear(whole);
    EachRead each;
    for (const auto& [name, given] : entry.named(field.rule.most)) {
        void* const element = field.member.append(whole);
        *field.member.name_of(element) = name;
        each([&, &given = given] {
            if (field.group->is_bare)
                read_value(field.group->fields.front(), given, element);
            else
                read_group(*field.group, given, element);
        });
    }
    each.end();
}

/// A number where a word stands alone is another field's: it is told where it belongs.
void read_short(const Field& field, const YamlEntry& entry, void* whole) {
    const Field& alone = field_named(*field.group, field.short_key);
    if (alone.kind == FieldKind::choice && to_number(entry.text())) {
        std::string others;
        for (const Field& other : field.group->fields)
            if (other.kind == FieldKind::number)
                others += fmt::format("{}{}: ...", others.empty() ? "" : ", ",
                                      other.rule.units.empty() ? std::string_view(other.key) : std::string_view(other.rule.units[0].key));
        entry.refuse(fmt::format("one of {}, or a map as {{{}}}", fmt::join(alone.rule.words, ", "), others));
    }
    read_value(alone, entry, whole);
}

void read_inner(const Field& field, const YamlEntry& entry, void* whole) {
    if (field.short_is_list ? !entry.is_list() : !entry.is_scalar())
        return read_group(*field.group, entry, field.member.make(whole));
    if (field.may_be_flag)
        entry.flag() ? void(field.member.make(whole)) : field.member.clear(whole);
    else if (!field.default_word.empty())
        entry.choice(field.default_word), field.member.make(whole);
    else if (!field.short_key.empty())
        read_short(field, entry, field.member.make(whole));
    else if (!field.absent_word.empty())
        entry.choice({&field.absent_word, 1}), field.member.clear(whole);
    else
        read_group(*field.group, entry, field.member.make(whole));
}

/// The first field says what the others do: the method of shadows, the kind of a tone mapper.
void refuse_unheard(const Group& group, const YamlMap& keys, const void* whole) {
    const Field& says = group.fields.front();
    std::string heard(says.key);
    for (const Field& field : group.fields)
        if (field.heard && field.heard(whole))
            heard += fmt::format(", {}", field.key);
    for (const Field& field : group.fields)
        if (const auto given = keys.find(field.key); given && field.heard && !field.heard(whole)) {
            int word = 0;
            std::memcpy(&word, says.member.look(const_cast<void*>(whole)), sizeof word);
            given->refuse(fmt::format("a key that {} '{}' does not use", says.key, says.rule.words[static_cast<std::size_t>(word)]),
                          fmt::format("none but {}", heard));
        }
}

void read_field(const Field& field, const YamlMap& keys, void* whole) {
    if (field.is_form && !field.read)
        return;
    if (field.kind == FieldKind::inlined)
        return read_group(*field.group, keys, field.member.make(whole));
    if (const std::vector<FieldUnit>& units = field.rule.units; !units.empty()) {
        if (const auto given = keys.one_of({units[0].key, units[1].key})) {
            const FieldUnit& unit = given->first == units[0].key ? units[0] : units[1];
            as<double>(field.member.make(whole)) = unit.stored(given->second.number(unit.least, unit.greatest));
        }
        return;
    }
    if (const auto given = field.is_required ? keys.require(field.key) : keys.find(field.key))
        read_value(field, *given, whole);
}

} // namespace

void read_value(const Field& field, const YamlEntry& entry, void* whole) {
    const FieldRule& rule = field.rule;
    if (field.read)
        return field.read(entry, whole);
    switch (field.kind) {
    case FieldKind::number: {
        const double value = number(rule, entry); // refused before an optional one is there
        as<double>(field.member.make(whole)) = value;
        break;
    }
    case FieldKind::whole:
        as<int>(field.member.make(whole)) = entry.whole(static_cast<int>(rule.least), static_cast<int>(rule.greatest));
        break;
    case FieldKind::flag:
        as<bool>(field.member.make(whole)) = entry.flag();
        break;
    case FieldKind::choice: {
        const int chosen = static_cast<int>(entry.choice(rule.words));
        std::memcpy(field.member.make(whole), &chosen, sizeof chosen);
        break;
    }
    case FieldKind::text:
        as<std::string>(field.member.make(whole)) = entry.text();
        break;
    case FieldKind::name:
        as<std::string>(field.member.make(whole)) = entry.name();
        break;
    case FieldKind::path:
        as<std::filesystem::path>(field.member.make(whole)) = entry.path();
        break;
    case FieldKind::texts:
        for (const YamlEntry& text : entry.list(rule.fewest, rule.most))
            as<std::vector<std::string>>(field.member.make(whole)).push_back(text.text());
        break;
    case FieldKind::names:
        for (const YamlEntry& name : entry.list(rule.fewest, rule.most))
            as<std::vector<std::string>>(field.member.make(whole)).push_back(name.name());
        break;
    case FieldKind::numbers:
        as<std::vector<double>>(field.member.make(whole)) = entry.numbers(rule.fewest, rule.most, rule.least, rule.greatest);
        break;
    case FieldKind::position: {
        const std::vector<double> xyz = entry.numbers(3, 3, rule.least, rule.greatest);
        as<glm::dvec3>(field.member.make(whole)) = {xyz[0], xyz[1], xyz[2]};
        break;
    }
    case FieldKind::group:
        read_inner(field, entry, whole);
        break;
    case FieldKind::named:
        read_named(field, entry, whole);
        break;
    case FieldKind::list: {
        field.member.clear(whole);
        EachRead each;
        for (const YamlEntry& element : entry.list(rule.fewest, rule.most))
            each([&] { read_group(*field.group, element, field.member.append(whole)); });
        each.end();
        break;
    }
    case FieldKind::own:
    case FieldKind::inlined:
        break; // has no value of its own
    }
}

void read_field(const Group& group, std::string_view key, const YamlMap& keys, void* whole) {
    read_field(field_named(group, key), keys, whole);
}

namespace {

/// `before`: refusals that were met before the map was opened.
void read_fields_of(const Group& group, const YamlMap& keys, void* whole, std::size_t before) {
    bool first = true;
    EachRead each;
    for (const Field& field : group.fields) {
        const bool is_read = each([&] { read_field(field, keys, whole); });
        if (std::exchange(first, false) && is_read)
            each([&] { refuse_unheard(group, keys, whole); });
    }
    each.end();
    if (group.check && refusals_met() == before) // else it would judge what is not as it was meant
        group.check(keys, whole);
}

} // namespace

void read_group(const Group& group, const YamlMap& keys, void* whole) { read_fields_of(group, keys, whole, refusals_met()); }

void read_group(const Group& group, const YamlEntry& entry, void* whole) {
    const std::size_t before = refusals_met();
    read_fields_of(group, YamlMap(entry, keys_of(group)), whole, before);
}

} // namespace fernlicht
