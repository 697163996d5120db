#include "runner/judge/old_baselines.h"

#include "runner/files/durable_files.h"
#include "runner/files/object_store.h"
#include "runner/judge/baseline_json.h"
#include "runner/judge/input_hashes.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/files.h"
#include "scenarios/yaml/old_names.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <unistd.h>

namespace fernlicht {
namespace {

/// Of each cell played from its beginning to each of its moments: the hash over its text, and today's.
std::map<std::string, std::string> hashes_of_today(const std::vector<Drive>& cells) {
    std::map<std::string, std::string> hashes;
    for (const Drive& drive : cells) {
        const std::string text = text_hashed_before(drive);
        for (int last = 0; last < tick_count(drive); ++last) {
            const std::string whole = text + fmt::format("moments: [0, {}]\n", last);
            const std::string now = input_hashes(drive, drive.lamp_sets.front(), {}, 0, last).front().second;
            hashes[content_hash(whole.data(), whole.size())] = now;
            hashes[now] = now;
        }
    }
    return hashes;
}

void replace_all(std::string& text, const std::string& old, const std::string& now) {
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at + now.size()))
        text.replace(at, old.size(), now);
}

} // namespace

std::vector<std::string> convert_baselines(const std::filesystem::path& store, const std::vector<Drive>& cells) {
    const std::filesystem::path index_file = store / "index.json";
    const FolderLock lock(store);
    FilesRead opened;
    const std::string before = read_file(index_file, opened);
    std::string index = baseline_text_of_today(before);
    std::vector<std::string> unmatched;
    if (index == before)
        return unmatched;
    const CheckedJson json = CheckedJson::parse(index, index_file);
    if (json.at("schema_version").whole() != 2)
        json.at("schema_version").refuse("2: a store that knows the inputs of its results");
    const std::map<std::string, std::string> hashes = hashes_of_today(cells);
    std::vector<std::filesystem::path> replaced;
    std::vector<std::pair<std::filesystem::path, std::string>> objects;
    for (const StoredBaseline& entry : from_json<std::vector<StoredBaseline>>(json.at("baselines"), stored_members)) {
        const std::filesystem::path path = object_path(store, entry.id);
        std::string object = baseline_text_of_today(read_file(path, opened));
        auto producer = from_json<Producer>(CheckedJson::parse(object, path).at("producer"), producer_members);
        const auto drive = std::ranges::find(producer.inputs, "drive", &std::pair<std::string, std::string>::first);
        if (const auto known = drive == producer.inputs.end() ? hashes.end() : hashes.find(drive->second); known != hashes.end()) {
            replace_all(object, drive->second, known->second);
            drive->second = known->second;
            const std::string inputs = hash_of_inputs(producer.inputs);
            replace_all(object, entry.key.inputs, inputs);
            replace_all(index, entry.key.inputs, inputs);
        } else if (drive != producer.inputs.end()) // pictures of others have no drive, and keep their inputs
            unmatched.push_back(
                fmt::format("{}:{}: no drive or study that was given has the inputs of {}", index_file.string(),
                            1 + std::count(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(before.find(entry.id)), '\n'),
                            key_text(entry.key)));
        const std::string id = content_hash(object.data(), object.size());
        objects.emplace_back(object_path(store, id), std::move(object));
        replace_all(index, entry.id, id);
        if (id != entry.id)
            replaced.push_back(path);
    }
    if (!unmatched.empty()) // half converted it would belong to neither version
        return unmatched;
    for (const auto& [path, object] : objects) {
        make_folder(path.parent_path());
        write_durably(path, object);
    }
    const std::filesystem::path next = store / fmt::format(".index-{}.json", ::getpid());
    write_durably(next, index);
    rename_durably(next, index_file); // here the change takes hold
    for (const std::filesystem::path& path : replaced) {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
        std::filesystem::remove(path.parent_path(), ignored); // where it was the last one
    }
    return unmatched;
}

} // namespace fernlicht
