#include "runner/experiments/compare/runs/yaml_difference.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

using Kind = YamlValue::Kind;

std::string below(const std::string& key, const std::string& name) { return key.empty() ? name : key + "." + name; }

bool has_parts(const YamlValue& value) {
    return value.kind == Kind::map || std::ranges::any_of(value.items, [](const YamlValue& item) { return item.kind == Kind::map; });
}

/// On one line, in YAML's flow form.
std::string flow_text(const YamlValue& value) {
    std::string text;
    switch (value.kind) {
    case Kind::null:
        return "null";
    case Kind::scalar:
        return value.text;
    case Kind::list:
        for (const YamlValue& item : value.items)
            text += (text.empty() ? "" : ", ") + flow_text(item);
        return "[" + text + "]";
    case Kind::map:
        for (const YamlMember& member : value.members)
            text += (text.empty() ? "" : ", ") + member.key + ": " + flow_text(member.value);
        return "{" + text + "}";
    }
    return text;
}

} // namespace

const YamlValue* member_of(const YamlValue& map, const std::string& key) {
    const auto found = std::ranges::find(map.members, key, &YamlMember::key);
    return found == map.members.end() ? nullptr : &found->value;
}

void add_changes(const YamlValue* before, const YamlValue* now, const std::string& key, std::vector<YamlChange>& changes) {
    if (!before && !now)
        return;
    if (before && now && before->kind == Kind::map && now->kind == Kind::map) {
        for (const YamlMember& member : before->members)
            add_changes(&member.value, member_of(*now, member.key), below(key, member.key), changes);
        for (const YamlMember& member : now->members)
            if (!member_of(*before, member.key))
                add_changes(nullptr, &member.value, below(key, member.key), changes);
        return;
    }
    if (before && now && before->kind == Kind::list && now->kind == Kind::list && before->items.size() == now->items.size() &&
        has_parts(*before) && has_parts(*now)) {
        for (std::size_t i = 0; i < now->items.size(); ++i)
            add_changes(&before->items[i], &now->items[i], fmt::format("{}[{}]", key, i), changes);
        return;
    }
    const std::string old_text = before ? flow_text(*before) : "", new_text = now ? flow_text(*now) : "";
    if (old_text != new_text || !before != !now)
        changes.push_back({key, old_text, new_text});
}

} // namespace fernlicht
