#include "scenarios/yaml/old_names.h"

#include "scenarios/yaml/yaml_tree.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace fernlicht {
namespace {

struct OldKey {
    std::string_view below; ///< key whose map it stands in; "": the document's own
    std::string_view old, now;
};

constexpr OldKey keys[] = {
    {"", "variants", "lamp_sets"},
    {"", "readings", "decide"},
    {"extent", "limits_lx", "thresholds_lx"},
    {"sensors", "limits_lx", "thresholds_lx"},
    {"glare", "limits_lx", "thresholds_lx"},
    {"glare", "limits_percent", "thresholds_percent"},
    {"glare", "limits_de_boer", "thresholds_de_boer"},
    {"traffic_light", "least_lx", "min_lx"},
    {"homogeneity", "least_lx", "min_lx"},
    {"levelling", "least_deg", "min_deg"},
    {"levelling", "least_rad", "min_rad"},
    {"levelling", "greatest_deg", "max_deg"},
    {"levelling", "greatest_rad", "max_rad"},
    {"swivel", "least_deg", "min_deg"},
    {"swivel", "least_rad", "min_rad"},
    {"swivel", "greatest_deg", "max_deg"},
    {"swivel", "greatest_rad", "max_rad"},
    {"bend", "least_deg", "min_deg"},
    {"bend", "least_rad", "min_rad"},
    {"bend", "greatest_deg", "max_deg"},
    {"bend", "greatest_rad", "max_rad"},
};

/// In JSON a quote within a text has a backslash before it, so that these stand for keys and schemas alone.
constexpr std::pair<std::string_view, std::string_view> baseline_words[] = {
    {"\"schema\": \"fernlicht references\"", "\"schema\": \"fernlicht baselines\""},
    {"\"schema\": \"fernlicht accepted results\"", "\"schema\": \"fernlicht baseline\""},
    {"\"references\": [", "\"baselines\": ["},
    {"\"variant\":", "\"lamp_set\":"},
};

constexpr std::string_view old_verdict = "reference", verdict_today = "baseline";

void find_keys(const YamlValue& value, std::string_view below, Naming naming, std::vector<TextEdit>& edits,
               std::vector<std::string>& unmatched) {
    for (const YamlMember& member : value.members) {
        for (const OldKey& name : keys) {
            const auto [from, to] = naming == Naming::today ? std::pair(name.old, name.now) : std::pair(name.now, name.old);
            if (name.below != below || member.key != from)
                continue;
            if (std::ranges::find(value.members, to, &YamlMember::key) != value.members.end())
                unmatched.push_back(fmt::format("{}: '{}' beside '{}', which is the same", member.line, from, to));
            else
                edits.push_back({member.line, member.column, std::string(from), std::string(to)});
        }
        find_keys(member.value, member.key, naming, edits, unmatched);
    }
    for (const YamlValue& item : value.items)
        find_keys(item, "[]", naming, edits, unmatched);
}

/// Where lines begin.
std::vector<std::size_t> line_starts(const std::string& text) {
    std::vector<std::size_t> starts{0};
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
        starts.push_back(at + 1);
    return starts;
}

/// Where `key` stands as a key, from `at` on; not in a comment, a value or another key.
std::size_t key_in(const std::string& text, std::string_view key, std::size_t at) {
    const std::size_t comment = text.find(" #", at);
    for (at = text.find(key, at); at < comment && at != std::string::npos; at = text.find(key, at + 1)) {
        const std::size_t after = text.find_first_not_of(" \"'", at + key.size());
        if ((at == 0 || std::string_view(" \t\n{,\"'").find(text[at - 1]) != std::string_view::npos) && after != std::string::npos &&
            text[after] == ':')
            return at;
    }
    return std::string::npos;
}

} // namespace

std::string_view name_of_today(std::string_view key, std::span<const std::string_view> known_keys) {
    for (const OldKey& name : keys)
        if (name.old == key && std::ranges::find(known_keys, name.now) != known_keys.end())
            return name.now;
    return {};
}

std::string edited(const std::string& text, std::vector<TextEdit> edits, std::vector<std::string>& unmatched) {
    const auto place = [](const TextEdit& edit) { return std::pair(edit.line, edit.column); };
    const auto same_place = [&](const TextEdit& a, const TextEdit& b) { return place(a) == place(b); };
    std::ranges::sort(edits, {}, place);
    edits.erase(std::unique(edits.begin(), edits.end(), same_place), edits.end()); // what an alias stands for is met at its anchor again
    const std::vector<std::size_t> starts = line_starts(text);
    std::string out;
    std::size_t done = 0;
    for (const TextEdit& edit : edits) {
        const std::size_t line = starts.at(edit.line - 1);
        std::size_t at = std::min(line + edit.column - 1, text.size());
        if (at < text.size() && (text[at] == '"' || text[at] == '\''))
            ++at;
        if (text.compare(at, edit.old.size(), edit.old) != 0) // a line with characters of several bytes, in some encodings
            at = std::min(key_in(text, edit.old, line), text.size());
        if (at < done || at >= (edit.line < starts.size() ? starts[edit.line] : text.size())) {
            unmatched.push_back(fmt::format("{}: '{}' is not written out here", edit.line, edit.old));
            continue;
        }
        out.append(text, done, at - done).append(edit.now);
        done = at + edit.old.size();
    }
    return out.append(text, done);
}

std::string renamed_keys(const std::string& text, const std::filesystem::path& file, Naming naming, std::vector<std::string>& unmatched) {
    std::vector<TextEdit> edits;
    find_keys(parse_yaml(text, file), "", naming, edits, unmatched);
    return edited(text, std::move(edits), unmatched);
}

std::string verdict_id_of_today(const std::string& id) {
    std::string out;
    std::size_t done = 0;
    for (std::size_t at = id.find(old_verdict); at != std::string::npos; at = id.find(old_verdict, at + 1)) {
        const std::size_t end = at + old_verdict.size();
        // Of a verdict's name; the techniques of the ray tracer go on with a hyphen.
        if ((at > 0 && id[at - 1] != '/' && id[at - 1] != '*') || (end < id.size() && id[end] != ' ' && id[end] != '*'))
            continue;
        out.append(id, done, at - done).append(verdict_today);
        done = end;
    }
    return out.append(id, done);
}

bool is_old_index(std::string_view schema) { return schema == "fernlicht references"; }

std::string baseline_text_of_today(std::string text) {
    for (const auto& [old, now] : baseline_words)
        for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size()))
            text.replace(at, old.size(), now);
    return text;
}

} // namespace fernlicht
