// Accepted results on disk: index.json says what is accepted for which key, objects/ holds results and frames, each file named by the hash
// of its bytes. The index is replaced in one rename, so a reader sees all of a change or nothing of it.
#pragma once

#include "runner/judge/baseline.h"

namespace fernlicht {

/// One accepted result. Several may stand under one key.
struct StoredBaseline {
    std::string id; ///< 32 hexadecimal digits: the hash of its object
    BaselineKey key;
    std::string note;       ///< why it was accepted, in the words of who did; "" for none
    std::string played_utc; ///< when the run began that gave it
};

/// How an id is shown: its first 12 digits.
std::string short_id(const std::string& id);

/// All that is accepted, ordered by key and id; empty where there is no store. Throws InputError for a damaged index, or one that another
/// version wrote, with what to do.
std::vector<StoredBaseline> list_baselines(const std::filesystem::path& store);

/// The results behind an entry, their frames' paths set. Throws InputError where an object is missing or is not what was stored.
Baseline load_baseline(const std::filesystem::path& store, const StoredBaseline& entry);

enum class Acceptance {
    first,         ///< only where nothing else is accepted
    add,           ///< beside what is there: either will do
    replace,       ///< in place of all that is there under the same key
    replace_class, ///< in place of all that is there for the same device class, whatever its drive
};
struct Stored {
    std::string id;
    bool is_new = false;     ///< false: these results were accepted before
    std::size_t removed = 0; ///< others that were under the key; with replace_class the first has all that are gone
};
/// Takes all of these (their frames are copied) or none; other keys stay. Interrupted at any moment, the store holds either everything
/// from before or everything new. Waits while another process changes the store.
/// Throws InputError where `how` is `first` and other results are accepted, when a frame cannot be read or the index is damaged;
/// DeviceError when the folder cannot be written.
std::vector<Stored> store_baselines(const std::filesystem::path& store, const std::vector<Baseline>& baselines, Acceptance how,
                                    const std::string& note);

struct Removal {
    std::size_t baselines = 0, objects = 0;
    std::uintmax_t bytes = 0;
};
/// Throws InputError where there is no such folder. One without baselines is one without; one that is not there was misspelt.
void refuse_missing_store(const std::filesystem::path& store);

/// Takes these entries out, and every object that no entry needs then. `dry`: only says what would go.
/// Throws InputError for a damaged index or a damaged object of an entry that stays, DeviceError when the folder cannot be written.
Removal remove_baselines(const std::filesystem::path& store, const std::vector<std::string>& ids, bool dry);

/// What a word of the command line means: the entry whose id begins with `word` (at least four hexadecimal digits), or that whose cell
/// (drive/lamp set/technique) or a part of it from the left is `word`: "straight", "straight/halogen". Throws InputError where there is
/// none, naming the nearest, where there are several, listing them, or no store.
StoredBaseline choose_baseline(const std::filesystem::path& store, const std::string& word);

} // namespace fernlicht
