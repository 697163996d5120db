#include "runner/judge/baseline_store.h"

#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "runner/judge/baseline_json.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/old_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <tuple>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* index_schema = "fernlicht baselines";
constexpr int index_version = 2;
constexpr std::size_t max_object_bytes = std::size_t{1} << 30;

/// A version 1 store knew neither inputs nor producers, so nothing of it can be put under today's keys.
void check_version(const CheckedJson& index, const fs::path& store) {
    const CheckedJson version = index.at("schema_version");
    if (index.at("schema").text() == index_schema && version.whole() == 1)
        throw InputError({store / "index.json", 0, 0, {}}, "is a store of the old form, which does not know the inputs of its results",
                         "a new folder, into which the runs are accepted again");
    if (const std::string schema = index.at("schema").text(); schema != index_schema && is_old_index(schema))
        throw InputError({store / "index.json", 0, 0, {}}, "is a store of version 0.1",
                         fmt::format("one of today; `fernlicht migrate --in-place {}` writes it so", printable(store.string(), 200)));
    index.expect_schema(index_schema, index_version);
}

std::string index_text(const std::vector<StoredBaseline>& entries) {
    const Json index{{"schema", index_schema}, {"schema_version", index_version}, {"baselines", as_json(entries, stored_members)}};
    return index.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Here a change takes hold.
void write_index(const fs::path& store, std::vector<StoredBaseline> entries) {
    std::ranges::sort(entries, {}, [](const StoredBaseline& entry) { return std::tuple(key_text(entry.key), entry.key.inputs, entry.id); });
    const fs::path next = store / fmt::format(".index-{}.json", ::getpid());
    write_durably(next, index_text(entries));
    rename_durably(next, store / "index.json");
}

/// What a killed process left half written. Nobody else is at it: the store is locked.
void remove_leftovers(const fs::path& store) {
    std::vector<fs::path> leftovers;
    for (const fs::directory_entry& entry : fs::directory_iterator(store))
        if (entry.path().filename().string().starts_with(".index-"))
            leftovers.push_back(entry.path());
    for (const fs::path& leftover : leftovers) {
        std::error_code ignored;
        fs::remove(leftover, ignored);
    }
}

/// Objects that entries need: their results, and the frames that these name. Throws InputError where results cannot be read.
std::set<std::string> needed(const fs::path& store, const std::vector<StoredBaseline>& entries) {
    std::set<std::string> hashes;
    for (const StoredBaseline& entry : entries) {
        hashes.insert(entry.id);
        get_object(store, entry.id, "result that was accepted");
        for (const BaselineFrame& frame : read_baseline_object(object_path(store, entry.id)).frames)
            hashes.insert(frame.xxh128);
    }
    return hashes;
}

/// Everything below objects/ that is not needed, what a killed process left among it.
Removal collect(const fs::path& store, const std::set<std::string>& hashes, bool dry) {
    Removal removal;
    std::error_code error;
    if (!fs::exists(store / "objects", error))
        return removal;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(store / "objects"))
        if (entry.is_regular_file() && !hashes.contains(entry.path().parent_path().filename().string() + entry.path().filename().string()))
            files.push_back(entry.path());
    for (const fs::path& file : files) {
        ++removal.objects;
        removal.bytes += fs::file_size(file, error);
        if (dry)
            continue;
        if (!fs::remove(file, error) || error)
            throw DeviceError(file.string() + ": cannot be removed: " + error.message());
        fs::remove(file.parent_path(), error); // where it was the last one
    }
    return removal;
}

/// The baseline with the hashes of its frames, and the entry that it would be. Writes nothing.
StoredBaseline name_baseline(Baseline& baseline) {
    for (BaselineFrame& frame : baseline.frames) {
        FilesRead opened;
        read_file(frame.exr, opened, max_object_bytes);
        frame.xxh128 = opened.front().xxh128;
    }
    const std::string object = baseline_object(baseline);
    return {content_hash(object.data(), object.size()), baseline.key, "", ""};
}

/// Copies frames and results into the store.
void write_baseline(const fs::path& store, const Baseline& baseline) {
    for (const BaselineFrame& frame : baseline.frames) {
        FilesRead opened;
        if (put_object(store, read_file(frame.exr, opened, max_object_bytes)) != frame.xxh128)
            throw InputError({frame.exr, 0, 0, {}}, "changed while it was read", "a run that has ended");
    }
    put_object(store, baseline_object(baseline));
}

/// Whether an entry holds the very results; one that is damaged does not.
bool holds(const fs::path& store, const StoredBaseline& entry, const Baseline& results) {
    try {
        return same_results(load_baseline(store, entry), results);
    } catch (const InputError&) {
        return false;
    }
}

/// Puts one baseline among the entries.
Stored place(const fs::path& store, std::vector<StoredBaseline>& entries, StoredBaseline entry, const Baseline& results, Acceptance how) {
    const auto same_key = [&](const StoredBaseline& other) { return other.key == entry.key; };
    const auto known = std::ranges::find_if(
        entries, [&](const StoredBaseline& other) { return same_key(other) && (other.id == entry.id || holds(store, other, results)); });
    Stored stored{known == entries.end() ? entry.id : known->id, known == entries.end(), 0};
    const auto is_other = [&](const StoredBaseline& other) { return same_key(other) && other.id != stored.id; };
    if (how == Acceptance::first && stored.is_new)
        if (const auto other = std::ranges::find_if(entries, is_other); other != entries.end())
            throw InputError({store, 0, 0, {}}, fmt::format("holds other results for {}: {}", key_text(entry.key), short_id(other->id)),
                             "--replace, if these are right in their place, or --also, if either is right");
    if (how == Acceptance::replace || how == Acceptance::replace_class)
        stored.removed = std::erase_if(entries, is_other);
    if (stored.is_new)
        entries.push_back(std::move(entry));
    return stored;
}

constexpr std::size_t fewest_digits = 4; // fewer are a word rather than an id
constexpr std::size_t max_listed = 6;

bool is_prefix(const std::string& word) {
    return word.size() >= fewest_digits && word.size() <= 32 && word.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// "straight/halogen" means "straight/halogen/photometric", "straight/hal" does not.
bool means(const std::string& word, const std::string& cell) { return cell == word || cell.starts_with(word + "/"); }

std::string listed(const std::vector<StoredBaseline>& entries) {
    std::string text;
    for (std::size_t i = 0; i < std::min(entries.size(), max_listed); ++i)
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", short_id(entries[i].id), printable(cell_text(entries[i].key)));
    return entries.size() > max_listed ? text + ", ..." : text;
}

} // namespace

JsonMembers stored_members(StoredBaseline& entry) {
    return {{"id", hash_part(entry.id)}, {"key", entry.key, key_members}, {"note", entry.note}, {"played_utc", entry.played_utc}};
}

std::string short_id(const std::string& id) { return id.substr(0, 12); }

std::vector<StoredBaseline> list_baselines(const fs::path& store) {
    std::error_code error;
    if (!fs::exists(store / "index.json", error) && !error)
        return {};
    const CheckedJson index = CheckedJson::read(store / "index.json");
    check_version(index, store);
    return from_json<std::vector<StoredBaseline>>(index.at("baselines"), stored_members);
}

Baseline load_baseline(const fs::path& store, const StoredBaseline& entry) {
    get_object(store, entry.id, "result that was accepted");
    Baseline baseline = read_baseline_object(object_path(store, entry.id));
    for (BaselineFrame& frame : baseline.frames) {
        frame.exr = object_path(store, frame.xxh128);
        get_object(store, frame.xxh128, "frame that was accepted");
    }
    return baseline;
}

std::vector<Stored> store_baselines(const fs::path& store, const std::vector<Baseline>& baselines, Acceptance how,
                                    const std::string& note) {
    make_folder(store);
    const FolderLock lock(store);
    remove_leftovers(store);
    std::vector<StoredBaseline> entries = list_baselines(store);
    std::vector<Baseline> to_write = baselines;
    std::vector<Stored> outcome;
    for (Baseline& baseline : to_write) {
        StoredBaseline entry = name_baseline(baseline);
        entry.note = note;
        entry.played_utc = baseline.played_utc;
        outcome.push_back(place(store, entries, std::move(entry), baseline, how));
    }
    // A note is about what is new; where nothing is, about what was accepted before.
    if (!note.empty() && std::ranges::none_of(outcome, &Stored::is_new))
        for (StoredBaseline& entry : entries)
            if (std::ranges::find(outcome, entry.id, &Stored::id) != outcome.end())
                entry.note = note;
    if (how == Acceptance::replace_class && !outcome.empty())
        outcome.front().removed += std::erase_if(entries, [&](const StoredBaseline& entry) {
            return std::ranges::any_of(to_write, [&](const auto& taken) { return device_text(taken.key) == device_text(entry.key); }) &&
                   std::ranges::none_of(outcome, [&](const Stored& stored) { return stored.id == entry.id; });
        });
    for (const Baseline& baseline : to_write)
        write_baseline(store, baseline);
    write_index(store, entries);
    if (std::ranges::any_of(outcome, [](const Stored& stored) { return stored.removed > 0; }))
        collect(store, needed(store, entries), false);
    return outcome;
}

void refuse_missing_store(const fs::path& store) {
    std::error_code ignored;
    if (!fs::is_directory(store, ignored))
        throw InputError({store, 0, 0, {}}, "is no folder", "one that `fernlicht accept` made, named by --baselines");
}

Removal remove_baselines(const fs::path& store, const std::vector<std::string>& ids, bool dry) {
    refuse_missing_store(store);
    const FolderLock lock(store);
    std::vector<StoredBaseline> entries = list_baselines(store);
    const std::size_t gone =
        std::erase_if(entries, [&](const StoredBaseline& entry) { return std::ranges::find(ids, entry.id) != ids.end(); });
    const std::set<std::string> hashes = needed(store, entries);
    if (!dry) {
        remove_leftovers(store);
        write_index(store, entries);
    }
    Removal removal = collect(store, hashes, dry);
    removal.baselines = gone;
    return removal;
}

StoredBaseline choose_baseline(const std::filesystem::path& store, const std::string& word) {
    const std::vector<StoredBaseline> all = list_baselines(store);
    if (all.empty())
        throw InputError({store, 0, 0, {}}, "holds nothing that was accepted", "a folder that `fernlicht accept` made");
    std::vector<StoredBaseline> found;
    const auto take = [&](const auto& fits) { std::ranges::copy_if(all, std::back_inserter(found), fits); };
    if (is_prefix(word))
        take([&](const StoredBaseline& entry) { return entry.id.starts_with(word); });
    if (found.empty())
        take([&](const StoredBaseline& entry) { return means(word, cell_text(entry.key)); });
    if (found.size() > 1)
        throw InputError({store, 0, 0, {}}, fmt::format("'{}' means {}: {}", printable(word), found.size(), listed(found)),
                         "more digits of one id");
    if (!found.empty())
        return found.front();
    std::vector<std::string> cells;
    for (const StoredBaseline& entry : all)
        cells.push_back(cell_text(entry.key));
    const std::string nearest = nearest_name(word, cells);
    throw InputError({store, 0, 0, {}}, "has nothing called '" + printable(word) + "'",
                     fmt::format("the first digits of an id, four or more, or DRIVE/LAMP SET/TECHNIQUE from the left{}",
                                 nearest.empty() ? "" : "; the nearest is " + printable(nearest)));
}

} // namespace fernlicht
