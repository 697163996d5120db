// Cells by their keys: what was computed once is not computed again.
#pragma once

#include "runner/files/packed_folder.h"
#include "runner/files/workplace.h"
#include "runner/findings/cell_inputs.h"
#include "scenarios/values/files.h"

#include <cstdint>
#include <optional>

namespace fernlicht {

/// What a store says of one cell.
struct StoredCell {
    std::string key, study, cell; ///< as who played it first called them
    std::string played_utc;       ///< ISO 8601
    CellInputs inputs;
    std::string object; ///< hash of its packed folder
    std::uint64_t bytes = 0;
    std::vector<std::pair<std::string, std::string>> files; ///< names and hashes of input files that are kept beside it
    double used_s = 0.0;                                    ///< when it was kept or last loaded, seconds since 1970: its entry's time
};

/// `$XDG_CACHE_HOME/fernlicht/store`, else `~/.cache/fernlicht/store`; throws InputError that names --store where there is neither.
std::filesystem::path default_store();

/// Any number of processes may read and write one store at once; a cell is there whole or not at all. Every function throws InputError for
/// a folder that is something else, DeviceError where the disk refuses.
class CellStore {
  public:
    explicit CellStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

    const std::filesystem::path& folder() const { return folder_; }

    /// nullopt where there is none, and where its entry is damaged: it is then as if it was never there.
    std::optional<StoredCell> find(const std::string& key) const;
    /// What is wrong with a cell that was kept, "its results are missing or damaged"; "" of one that is whole or was never there. Reads all
    /// of it.
    std::string damage(const std::string& key) const;
    /// Its folder; from then on it counts as used now, where the store can be written. Throws InputError where it is missing or damaged.
    PackedFiles load(const StoredCell& cell) const;
    /// Keeps the cell and the input files that it names; `cell.object`, `bytes` and `files` are set here. The entry comes last.
    void keep(StoredCell cell, const PackedFiles& files, const FilesRead& inputs) const;
    /// The entries, least recently used first; damaged ones are left out.
    std::vector<StoredCell> list() const;
    /// Why a cell has no results, by whoever tried to play it last; "" where nobody did, or where it has some. keep() takes it away.
    std::string failure(const std::string& key) const;
    /// "" takes it away. Where the disk refuses it is lost: whoever notes it tells it, too.
    void note_failure(const std::string& key, const std::string& why) const;
    /// So that it is played anew.
    void forget(const std::string& key) const;
    /// Why nothing can be kept here; "" where it can. Tries it.
    std::string refuses_writing() const;
    /// A folder of its own for what is being played, on the store's disk.
    Workplace new_workplace(const std::string& begins_with) const;
    /// Tells a store from other folders, out of which nothing is taken. Locked while objects are written that no entry names yet, and while
    /// those are taken out that none names.
    std::filesystem::path mark() const { return folder_ / "fernlicht-store"; }

  private:
    void make() const;
    std::filesystem::path entry_path(const std::string& key) const;
    std::filesystem::path failure_path(const std::string& key) const;
    std::filesystem::path folder_;
};

} // namespace fernlicht
