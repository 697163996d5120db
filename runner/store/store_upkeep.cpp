#include "runner/store/store_upkeep.h"

#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/glob.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fmt/format.h>
#include <iomanip>
#include <set>
#include <sstream>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr double leftover_age_s = 3600.0;

std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    if (fs::is_directory(folder, error))
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
            if (entry.is_regular_file())
                files.push_back(entry.path());
    return files;
}

void take_out(const fs::path& path) {
    std::error_code error;
    if (!fs::remove(path, error) && error)
        throw DeviceError(path.string() + ": cannot be removed: " + error.message());
}

/// Seconds since 1970; nullopt for what is no time.
std::optional<double> seconds_of(const std::string& utc) {
    std::tm time{};
    std::istringstream stream(utc);
    stream >> std::get_time(&time, "%Y-%m-%dT%H:%M:%SZ");
    return stream.fail() ? std::nullopt : std::optional(static_cast<double>(::timegm(&time)));
}

std::string name_of_object(const fs::path& path) { return path.parent_path().filename().string() + path.filename().string(); }

bool is_left_over(const fs::path& path) {
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(path);
    return std::chrono::duration<double>(age).count() >= leftover_age_s;
}

std::string sentence_name(const StoredCell& cell) { return fmt::format("cell {} of {}", printable(cell.cell), printable(cell.study)); }

} // namespace

std::vector<StoreDamage> verify_store(const CellStore& store) {
    const FolderLock lock(store.folder());
    std::vector<StoreDamage> damage;
    for (const fs::path& path : files_of(store.folder() / "objects")) {
        const std::string hash = name_of_object(path);
        if (hash.size() != 32 || holds_object(store.folder(), hash)) // the first: half written
            continue;
        damage.push_back({"object " + hash, "its bytes are not those that were kept"});
        take_out(path);
    }
    std::set<std::string> whole;
    for (const StoredCell& cell : store.list()) {
        whole.insert(cell.key);
        std::error_code error;
        if (fs::exists(object_path(store.folder(), cell.object), error))
            continue;
        damage.push_back({sentence_name(cell), "its results are missing or damaged; it is played again when it is asked for"});
        store.forget(cell.key);
        store.note_failure(cell.key, "its results in the store were damaged");
    }
    for (const fs::path& path : files_of(store.folder() / "cells"))
        if (path.extension() == ".json" && !whole.contains(path.parent_path().filename().string() + path.stem().string())) {
            damage.push_back(
                {"entry " + path.filename().string(), "is none that this version wrote; its cell is played again when it is asked for"});
            take_out(path);
        }
    return damage;
}

Pruned prune_store(const CellStore& store, const Pruning& pruning, double now_s) {
    const FolderLock lock(store.folder());
    std::vector<StoredCell> cells = store.list(), stay;
    Pruned pruned;
    const auto is_of_study = [&](const StoredCell& cell) { return pruning.study.empty() || matches(pruning.study, cell.study); };
    const bool whole_study = !pruning.study.empty() && !pruning.older_than_s && !pruning.at_most_bytes;
    std::uint64_t bytes = 0;
    for (const StoredCell& cell : cells)
        bytes += cell.bytes;
    for (StoredCell& cell : cells) { // the oldest first
        const bool too_old = pruning.older_than_s && now_s - seconds_of(cell.played_utc).value_or(now_s) > *pruning.older_than_s;
        const bool too_much = pruning.at_most_bytes && bytes > *pruning.at_most_bytes;
        if (!is_of_study(cell) || !(whole_study || too_old || too_much)) {
            stay.push_back(std::move(cell));
            continue;
        }
        ++pruned.cells;
        bytes -= cell.bytes;
        if (!pruning.dry)
            store.forget(cell.key);
    }
    pruned.cells_left = stay.size();
    std::set<std::string> needed;
    for (const StoredCell& cell : stay) {
        needed.insert(cell.object);
        for (const auto& [name, hash] : cell.files)
            needed.insert(hash);
    }
    const auto take_file = [&](const fs::path& path) {
        ++pruned.files;
        pruned.bytes += fs::file_size(path);
        if (!pruning.dry)
            take_out(path);
    };
    for (const fs::path& path : files_of(store.folder() / "objects"))
        if (needed.contains(name_of_object(path)))
            pruned.bytes_left += fs::file_size(path);
        else
            take_file(path);
    for (const char* const part : {"playing", "cells", "failed"})
        for (const fs::path& path : files_of(store.folder() / part))
            if (path.extension() != ".json" || std::string_view(part) == "playing")
                if (is_left_over(path))
                    take_file(path);
    return pruned;
}

} // namespace fernlicht
