#include "runner/findings/key_reference.h"

#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/pixel_lamp_file.h"
#include "scenarios/ratings/rating.h"
#include "scenarios/studies/study.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <sstream>

namespace fernlicht {
namespace {

/// As a page of Markdown names the heading over a list.
std::string link_to(const std::string& words, const std::string& path) {
    std::string anchor;
    for (const char c : path)
        if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == ' ')
            anchor += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return fmt::format("[{}](#{})", words, anchor);
}

std::size_t count_words(const std::string& text) {
    std::istringstream in(text);
    return static_cast<std::size_t>(std::distance(std::istream_iterator<std::string>(in), {}));
}

std::string names_text(const KeyLine& line) { return fmt::format("`{}`", fmt::join(line.names, "`, `")); }
std::string usual_text(const KeyLine& line) { return line.is_required ? "required" : line.usual.empty() ? "" : "**" + line.usual + "**"; }

std::string text_of(const KeyLine& line) {
    if (line.names.empty())
        return line.below.empty() ? std::string(line.meaning) : fmt::format("{}: {}", line.meaning, link_to("which", line.below));
    std::vector<std::string> parts = line.words;
    const auto usual = std::ranges::find(parts, line.usual);
    const bool is_word = usual != parts.end();
    if (is_word)
        *usual = usual_text(line);
    if (!line.allowed.empty())
        parts.push_back(line.allowed);
    if (!line.below.empty())
        parts.push_back(link_to("keys", line.below));
    if (!is_word && !usual_text(line).empty())
        parts.push_back(usual_text(line));
    return fmt::format("{}{}{}{}{}{}", names_text(line), parts.empty() ? "" : " (", fmt::join(parts, ", "), parts.empty() ? "" : ")",
                       line.meaning.empty() ? "" : ": ", line.meaning);
}

bool same_but_default(KeyLine a, const KeyLine& b) {
    a.usual = b.usual;
    a.is_required = b.is_required;
    return a == b;
}

/// Of lists with the same lines one stays, a group's that has a name or else that of the shortest path, and links lead to it.
void keep_one_of_each(std::vector<KeyList>& lists) {
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < lists.size() && !changed; ++i)
            for (std::size_t j = i + 1; j < lists.size() && !changed; ++j) {
                if (lists[i].lines != lists[j].lines)
                    continue;
                const auto rank = [&lists](std::size_t at) { return std::pair(!lists[at].stands_for_several, lists[at].path.size()); };
                const std::size_t gone = rank(j) < rank(i) ? i : j;
                const std::string from = lists[gone].path, to = lists[gone == i ? j : i].path;
                lists.erase(lists.begin() + static_cast<std::ptrdiff_t>(gone));
                for (KeyList& list : lists)
                    for (KeyLine& line : list.lines)
                        if (line.below == from)
                            line.below = to;
                changed = true;
            }
    }
}

/// What a list says of keys that stand in full elsewhere, and its own lines.
struct Told {
    std::string elsewhere;
    std::vector<const KeyLine*> own;
};

/// `list` by what `full` of the list at `path` says; how many words that saves.
std::pair<Told, std::size_t> told_by(const KeyList& list, const std::string& path, const std::vector<const KeyLine*>& full) {
    Told told;
    std::vector<std::string> all, off_default;
    std::size_t spared = 0;
    for (const KeyLine& line : list.lines) {
        const auto there = std::ranges::find_if(full, [&](const KeyLine* one) { return same_but_default(*one, line); });
        if (line.names.empty() || there == full.end()) {
            told.own.push_back(&line);
            continue;
        }
        const bool as_there = (*there)->usual == line.usual && (*there)->is_required == line.is_required;
        const std::string usual = usual_text(line).empty() ? "no default" : usual_text(line);
        all.push_back(as_there ? names_text(line) : fmt::format("{} ({})", names_text(line), usual));
        if (!as_there)
            off_default.push_back(all.back());
        spared += count_words(text_of(line)) + 1;
    }
    if (all.size() == full.size())
        told.elsewhere =
            fmt::format("All of {}{}{}.", link_to(path, path), off_default.empty() ? "" : ", but ", fmt::join(off_default, ", "));
    else
        told.elsewhere = fmt::format("As {}: {}.", link_to(path, path), fmt::join(all, ", "));
    const std::size_t cost = count_words(told.elsewhere);
    return {std::move(told), spared > cost ? spared - cost : 0};
}

} // namespace

std::vector<Section> key_sections(std::vector<KeyList> lists) {
    keep_one_of_each(lists);
    // Groups with names stand in full, the longest before others, so that all lead to them.
    std::vector<std::size_t> order(lists.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::stable_sort(order, {},
                             [&](std::size_t i) { return lists[i].stands_for_several ? -static_cast<int>(lists[i].lines.size()) : 0; });
    std::vector<Told> told(lists.size());
    std::vector<std::size_t> before;
    constexpr std::size_t worth_a_look_elsewhere = 15; // words
    for (const std::size_t i : order) {
        std::pair<Told, std::size_t> best = {{}, worth_a_look_elsewhere};
        for (const std::size_t other : before)
            if (auto found = told_by(lists[i], lists[other].path, told[other].own); found.second > best.second)
                best = std::move(found);
        if (best.first.elsewhere.empty())
            for (const KeyLine& line : lists[i].lines)
                best.first.own.push_back(&line);
        told[i] = std::move(best.first);
        before.push_back(i);
    }
    std::vector<Section> sections;
    for (std::size_t i = 0; i < lists.size(); ++i) {
        Section& section = sections.emplace_back(Section{lists[i].path, {}, 3});
        if (!told[i].elsewhere.empty())
            section.blocks.emplace_back(told[i].elsewhere);
        Listing items;
        for (const KeyLine* line : told[i].own)
            items.items.emplace_back(text_of(*line));
        if (!items.items.empty())
            section.blocks.emplace_back(std::move(items));
    }
    return sections;
}

namespace {

void add_file(std::vector<KeyList>& lists, const std::string& path, const Group& keys, const void* usual) {
    const auto add = [&lists](std::vector<KeyList> more) { std::ranges::move(more, std::back_inserter(lists)); };
    add(key_lists(path, keys, usual));
    for (const auto& [name, group] : definitions(keys))
        add(key_lists(std::string(name), *group, group->usual.get()));
}

} // namespace

Document keys_document() {
    Drive usual;
    usual.extent.emplace();
    std::vector<KeyList> lists;
    add_file(lists, "", drive_fields(), &usual);
    lists.front().path = "drive";
    Group of_study = study_fields();
    std::erase_if(of_study.fields, [](const Field& field) { return field.key == "measure"; }); // a drive's
    const std::vector<std::string> files = {"drive", "study", "rating", "recipe", "pixel lamp"};
    add_file(lists, "study", of_study, study_fields().usual.get());
    KeyLine measure;
    measure.names = {"measure"};
    measure.meaning = "as in a drive, but for extents and probes; for every drive that does not ask itself";
    std::ranges::find(lists, "study", &KeyList::path)->lines.push_back(std::move(measure));
    add_file(lists, "rating", rating_fields(), rating_fields().usual.get());
    add_file(lists, "recipe", grid_recipe_fields(), grid_recipe_fields().usual.get());
    add_file(lists, "pixel lamp", pixel_lamp_fields(), pixel_lamp_fields().usual.get());
    std::vector<Section> sections = {
        {"",
         {"Keys of drives ([drives.md](../drives.md), `scenarios/drive.example.yaml`), studies ([studies.md](../studies.md)), ratings "
          "([ratings.md](../ratings.md)), recipes of lamp files ([lamps.md](../lamps.md)) and pixel lamps "
          "([pixel-lamps.md](../pixel-lamps.md)); each has a commented example in `scenarios/`.",
          "In brackets: what is allowed and, **bold**, the default. `>0..5`: not 0 itself; `0..<1`: not 1. Two names are two units of one "
          "value; range and default are in the first. NAME is yours to choose. `reach` alone: a plain value stands for that key."}}};
    for (Section& section : key_sections(std::move(lists))) {
        if (std::ranges::find(files, section.title) != files.end())
            section.level = 2;
        sections.push_back(std::move(section));
    }
    return {"Keys", std::move(sections)};
}

} // namespace fernlicht
