#include "runner/judge/reference_choice.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t fewest_digits = 4; // fewer are a word rather than an id
constexpr std::size_t most_listed = 6;

bool is_prefix(const std::string& word) {
    return word.size() >= fewest_digits && word.size() <= 32 && word.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// "straight/halogen" means "straight/halogen/photometric", "straight/hal" does not.
bool means(const std::string& word, const std::string& cell) { return cell == word || cell.starts_with(word + "/"); }

std::string listed(const std::vector<StoredReference>& entries) {
    std::string text;
    for (std::size_t i = 0; i < std::min(entries.size(), most_listed); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", short_id(entries[i].id), printable(cell_text(entries[i].key)));
    return entries.size() > most_listed ? text + ", ..." : text;
}

} // namespace

std::vector<StoredReference> choose_references(const std::filesystem::path& store, const std::string& word) {
    const std::vector<StoredReference> all = list_references(store);
    if (all.empty())
        throw InputError({store, 0, 0, {}}, "holds nothing that was accepted", "a folder that `fernlicht accept` made");
    if (is_prefix(word))
        if (std::vector<StoredReference> found = with_prefix(all, word); !found.empty())
            return found;
    std::vector<StoredReference> found;
    std::vector<std::string> cells;
    for (const StoredReference& entry : all) {
        cells.push_back(cell_text(entry.key));
        if (means(word, cells.back()))
            found.push_back(entry);
    }
    if (!found.empty())
        return found;
    const std::string nearest = nearest_name(word, cells);
    throw InputError({store, 0, 0, {}}, "has nothing called '" + printable(word) + "'",
                     fmt::format("the first digits of an id, four or more, or DRIVE/LAMP SET/TECHNIQUE from the left{}",
                                 nearest.empty() ? "" : "; the nearest is " + printable(nearest)));
}

StoredReference choose_reference(const std::filesystem::path& store, const std::string& word) {
    std::vector<StoredReference> found = choose_references(store, word);
    if (found.size() > 1)
        throw InputError({store, 0, 0, {}}, fmt::format("'{}' means {}: {}", printable(word), found.size(), listed(found)),
                         "more digits of one id");
    return std::move(found.front());
}

} // namespace fernlicht
