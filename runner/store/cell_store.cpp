#include "runner/store/cell_store.h"

#include "runner/files/described_json.h"
#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;

constexpr const char* cell_schema = "fernlicht cell";
constexpr int cell_version = 1;

JsonMembers kept_file_members(std::pair<std::string, std::string>& file) { return {{"name", file.first}, {"xxh128", file.second}}; }

JsonMembers stored_cell_members(StoredCell& cell) {
    return {{"schema", json_constant(cell_schema)},
            {"schema_version", json_constant(cell_version)},
            {"key", cell.key},
            {"study", cell.study},
            {"cell", cell.cell},
            {"played_utc", cell.played_utc},
            {"object", cell.object},
            {"bytes", cell.bytes},
            {"inputs", cell.inputs, cell_input_members},
            {"files", cell.files, kept_file_members}};
}

/// The entry's text ends with a hash of what comes before.
constexpr std::string_view before_hash = ",\"xxh128\":\"", after_hash = "\"}\n";

std::string with_hash(std::string object) {
    object.pop_back();
    return object + std::string(before_hash) + content_hash(object.data(), object.size()) + std::string(after_hash);
}

/// nullopt for an entry whose text was changed, for another cell's, and for what is none.
std::optional<StoredCell> read_entry(const fs::path& path, const std::string& key) {
    try {
        FilesRead opened;
        const std::string text = read_file(path, opened, std::size_t{1} << 24, true);
        const std::size_t at = text.rfind(before_hash);
        if (at == std::string::npos || with_hash(text.substr(0, at) + "}") != text)
            return std::nullopt;
        const CheckedJson json = CheckedJson::parse(text, path);
        json.expect_schema(cell_schema, cell_version);
        StoredCell cell = from_json<StoredCell>(json, stored_cell_members);
        std::error_code gone;
        if (const auto used = fs::last_write_time(path, gone); !gone)
            cell.used_s = std::chrono::duration<double>(fs::file_time_type::clock::to_sys(used).time_since_epoch()).count();
        if (cell.key == key && cell.object.size() == 32)
            return cell;
    } catch (const InputError&) { // as if it was never there
    }
    return std::nullopt;
}

} // namespace

fs::path default_store() {
    if (const char* const cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/')
        return fs::path(cache) / "fernlicht/store";
    if (const char* const home = std::getenv("HOME"); home && *home == '/')
        return fs::path(home) / ".cache/fernlicht/store";
    throw InputError({{}, 0, 0, "--store"}, "found none, and neither XDG_CACHE_HOME nor HOME", "--store DIR, where played cells are kept");
}

fs::path CellStore::entry_path(const std::string& key) const { return folder_ / "cells" / key.substr(0, 2) / (key.substr(2) + ".json"); }

std::optional<StoredCell> CellStore::find(const std::string& key) const {
    std::error_code error;
    if (!fs::exists(entry_path(key), error))
        return std::nullopt;
    std::optional<StoredCell> cell = read_entry(entry_path(key), key);
    if (cell && fs::file_size(object_path(folder_, cell->object), error) != cell->bytes)
        return std::nullopt;
    return cell;
}

std::string CellStore::damage(const std::string& key) const {
    std::error_code error;
    if (!fs::exists(entry_path(key), error))
        return "";
    const std::optional<StoredCell> cell = read_entry(entry_path(key), key);
    return !cell ? "its entry is damaged" : holds_object(folder_, cell->object) ? "" : "its results are missing or damaged";
}

fs::path CellStore::failure_path(const std::string& key) const { return folder_ / "failed" / key; }

std::string CellStore::failure(const std::string& key) const {
    try {
        FilesRead opened;
        return read_file(failure_path(key), opened, std::size_t{1} << 16, true);
    } catch (const InputError&) { // there is none
        return {};
    }
}

void CellStore::note_failure(const std::string& key, const std::string& why) const {
    std::error_code ignored;
    if (why.empty()) {
        fs::remove(failure_path(key), ignored);
        return;
    }
    try {
        make();
        make_folder(failure_path(key).parent_path());
        write_durably(failure_path(key), why.substr(0, 4000));
    } catch (const DeviceError&) {
        return;
    }
}

PackedFiles CellStore::load(const StoredCell& cell) const {
    PackedFiles files = unpacked(get_object(folder_, cell.object, "cell that was kept"), object_path(folder_, cell.object));
    std::error_code ignored;
    fs::last_write_time(entry_path(cell.key), fs::file_time_type::clock::now(), ignored);
    return files;
}

void CellStore::keep(StoredCell cell, const PackedFiles& files, const FilesRead& inputs) const {
    make();
    const FolderLock against_pruning(mark(), FolderLock::For::reading);
    for (const FileRead& input : inputs) {
        FilesRead opened;
        const std::string content = read_file(input.path, opened, std::size_t{1} << 30, true);
        if (opened.front().xxh128 != input.xxh128)
            throw InputError({input.path, 0, 0, {}}, "changed while its cell was played", "a file that stays as it is");
        cell.files.emplace_back(input.path.filename().string(), put_object(folder_, content));
    }
    const std::string content = packed(files);
    cell.object = put_object(folder_, content);
    cell.bytes = content.size();
    make_folder(entry_path(cell.key).parent_path());
    write_durably(entry_path(cell.key), with_hash(as_json(cell, stored_cell_members).dump()));
    note_failure(cell.key, "");
}

std::vector<StoredCell> CellStore::list() const {
    std::vector<StoredCell> cells;
    std::error_code error;
    if (!fs::is_directory(folder_ / "cells", error))
        return cells;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "cells"))
        if (entry.is_regular_file() && entry.path().extension() == ".json")
            if (std::optional<StoredCell> cell =
                    read_entry(entry.path(), entry.path().parent_path().filename().string() + entry.path().stem().string()))
                cells.push_back(std::move(*cell));
    std::ranges::sort(cells, {}, [](const StoredCell& cell) { return std::pair(cell.used_s, cell.key); });
    return cells;
}

void CellStore::forget(const std::string& key) const {
    std::error_code ignored;
    fs::remove(entry_path(key), ignored);
}

std::string CellStore::refuses_writing() const {
    const fs::path trial = folder_ / fmt::format(".trial-{}", ::getpid());
    try {
        make();
        write_durably(trial, "trial\n");
    } catch (const DeviceError& error) {
        return error.what();
    }
    std::error_code ignored;
    fs::remove(trial, ignored);
    return {};
}

void CellStore::make() const {
    // What a disk and its server leave at the root of a volume is nobody's.
    const auto is_somebodys = [](const fs::directory_entry& entry) {
        const std::string name = entry.path().filename().string();
        return name != "lost+found" && !name.starts_with('.');
    };
    std::error_code ignored;
    const auto is_marked = [&] { return fs::exists(mark(), ignored); };
    if (!is_marked() && std::any_of(fs::directory_iterator(folder_, ignored), fs::directory_iterator(), is_somebodys) &&
        !is_marked()) // another process may have made the store in between, its mark first
        throw InputError({folder_, 0, 0, "--store"}, "is a folder with other files in it",
                         "a new or empty one, or one that `fernlicht study` made");
    make_folder(folder_);
    std::ofstream(mark(), std::ios::app); // what is written next says what a disk refuses
}

Workplace CellStore::new_workplace(const std::string& begins_with) const {
    make();
    return {folder_ / "playing", begins_with};
}

} // namespace fernlicht
