#include "runner/store/store_upkeep.h"

#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr double leftover_age_s = 3600.0, note_age_s = 30 * 86400.0;

std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    if (fs::is_directory(folder, error))
        for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
            if (entry->is_regular_file(error))
                files.push_back(entry->path());
    return files;
}

void take_out(const fs::path& path) {
    std::error_code error;
    if (!fs::remove(path, error) && error)
        throw DeviceError(path.string() + ": cannot be removed: " + error.message());
}

/// The hash or key of a file that a store wrote, whole or in part: two digits are its folder, the others its name; "" of all others.
std::string key_in(const fs::path& path, std::string_view ending) {
    constexpr std::size_t digits = 30;
    const std::string folder = path.parent_path().filename().string(), name = path.filename().string();
    const std::string key = folder + name.substr(0, digits);
    const bool is_ours = folder.size() == 2 && key.size() == 32 && key.find_first_not_of("0123456789abcdef") == std::string::npos;
    const std::string rest = name.substr(std::min(digits, name.size()));
    return is_ours && (rest == ending || rest.starts_with(std::string(ending) + ".part-")) ? key : "";
}
std::string name_of_object(const fs::path& path) { return key_in(path, ""); }
bool is_part(const fs::path& path) { return path.filename().string().find(".part-") != std::string::npos; }

/// Of the newest of its files, or of the file itself; 0 for what is gone meanwhile.
double age_s(const fs::path& path) {
    std::error_code error;
    const auto written = fs::last_write_time(path, error);
    double age = error ? 0.0 : std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
    for (const fs::path& file : files_of(path))
        age = std::min(age, age_s(file));
    return age;
}

std::uint64_t size_of(const fs::path& file) {
    std::error_code gone;
    const std::uintmax_t bytes = fs::file_size(file, gone);
    return gone ? 0 : bytes;
}

std::string sentence_name(const StoredCell& cell) { return fmt::format("cell {} of {}", printable(cell.cell), printable(cell.study)); }

std::set<std::string> objects_of(const StoredCell& cell) {
    std::set<std::string> objects{cell.object};
    for (const auto& [name, hash] : cell.files)
        objects.insert(hash);
    return objects;
}

/// With how many of the cells need each.
std::map<std::string, std::size_t> objects_of(const std::vector<StoredCell>& cells) {
    std::map<std::string, std::size_t> objects;
    for (const StoredCell& cell : cells)
        for (const std::string& object : objects_of(cell))
            ++objects[object];
    return objects;
}

/// Why a cell must be played again; "" where all of it is there.
std::string missing_of(const CellStore& store, const StoredCell& cell) {
    std::error_code error;
    if (!fs::exists(object_path(store.folder(), cell.object), error))
        return "its results are missing or damaged";
    for (const auto& [name, hash] : cell.files)
        if (!fs::exists(object_path(store.folder(), hash), error))
            return "the input file " + printable(name) + " that is kept with it is missing or damaged";
    return {};
}

/// Cells of which something is not there, and what is no entry.
std::vector<StoreDamage> damaged_entries(const CellStore& store, bool taken_out) {
    std::vector<StoreDamage> damage;
    std::set<std::string> whole;
    for (const StoredCell& cell : store.list()) {
        whole.insert(cell.key);
        const std::string missing = missing_of(store, cell);
        if (missing.empty())
            continue;
        damage.push_back({sentence_name(cell), missing + "; it is played again when it is asked for"});
        if (taken_out) {
            store.forget(cell.key);
            store.note_failure(cell.key, "in the store " + missing);
        }
    }
    for (const fs::path& path : files_of(store.folder() / "cells"))
        if (const std::string key = key_in(path, ".json"); !key.empty() && !is_part(path) && !whole.contains(key)) {
            damage.push_back({"entry " + key, "it is damaged, or of another version; its cell is played again when it is asked for"});
            if (taken_out)
                take_out(path);
        }
    return damage;
}

} // namespace

std::vector<StoreDamage> verify_store(const CellStore& store) {
    std::vector<fs::path> broken;
    {
        const FolderLock others_may_read(store.mark(), FolderLock::For::reading);
        for (const fs::path& path : files_of(store.folder() / "objects"))
            if (!name_of_object(path).empty() && !is_part(path) && !holds_object(store.folder(), name_of_object(path)))
                broken.push_back(path);
    }
    if (broken.empty() && damaged_entries(store, false).empty())
        return {};
    const FolderLock lock(store.mark());
    const std::map<std::string, std::size_t> needed = objects_of(store.list());
    std::vector<StoreDamage> damage;
    for (const fs::path& path : broken) {
        if (holds_object(store.folder(), name_of_object(path))) // written anew meanwhile
            continue;
        if (needed.contains(name_of_object(path))) // else its cell was played again
            damage.push_back({"object " + name_of_object(path), "its bytes are not those that were kept"});
        take_out(path);
    }
    std::ranges::move(damaged_entries(store, true), std::back_inserter(damage));
    return damage;
}

Pruned prune_store(const CellStore& store, const Pruning& pruning, double now_s) {
    const FolderLock lock(store.mark());
    const std::vector<StoredCell> cells = store.list();
    Pruned pruned;
    const auto is_of_study = [&](const StoredCell& cell) { return pruning.study.empty() || matches(pruning.study, cell.study); };
    const bool whole_study = !pruning.study.empty() && !pruning.older_than_s && !pruning.at_most_bytes;
    std::map<std::string, std::size_t> needed = objects_of(cells);
    const auto bytes_of = [&](const std::string& object) { return size_of(object_path(store.folder(), object)); };
    std::uint64_t bytes = 0;
    for (const auto& [object, users] : needed)
        bytes += bytes_of(object);
    for (const StoredCell& cell : cells) {
        const bool too_old = pruning.older_than_s && now_s - cell.used_s > *pruning.older_than_s;
        const bool too_much = pruning.at_most_bytes && bytes > *pruning.at_most_bytes;
        if (!is_of_study(cell) || !(whole_study || too_old || too_much)) {
            ++pruned.cells_left;
            continue;
        }
        ++pruned.cells;
        for (const std::string& object : objects_of(cell))
            if (--needed[object] == 0) {
                bytes -= bytes_of(object);
                needed.erase(object);
            }
        if (!pruning.dry)
            store.forget(cell.key);
    }
    const auto take_file = [&](const fs::path& path) {
        ++pruned.files;
        pruned.bytes += size_of(path);
        if (!pruning.dry)
            take_out(path);
    };
    for (const fs::path& path : files_of(store.folder() / "objects"))
        if (needed.contains(name_of_object(path)) && !is_part(path))
            pruned.bytes_left += size_of(path);
        else if (!name_of_object(path).empty())
            take_file(path);
    for (const fs::path& path : files_of(store.folder() / "cells"))
        if (!key_in(path, ".json").empty() && is_part(path) && age_s(path) >= leftover_age_s)
            take_file(path);
    for (const fs::path& path : files_of(store.folder() / "failed"))
        if (age_s(path) >= note_age_s)
            take_file(path);
    std::error_code none;
    for (fs::directory_iterator place(store.folder() / "playing", none), end; !none && place != end; place.increment(none)) {
        if (age_s(place->path()) < leftover_age_s || !FolderLock::at_once(place->path())) // a cell may write nothing for long
            continue;
        for (const fs::path& path : files_of(place->path()))
            take_file(path);
        std::error_code ignored;
        if (!pruning.dry)
            fs::remove_all(place->path(), ignored);
    }
    return pruned;
}

} // namespace fernlicht
