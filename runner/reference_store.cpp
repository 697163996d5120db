#include "runner/reference_store.h"

#include "runner/capture.h"
#include "runner/checked_json.h"
#include "runner/durable_files.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* index_schema = "fernlicht references";
constexpr const char* reference_schema = "fernlicht reference";
constexpr std::size_t most_frame_bytes = std::size_t{1} << 30;

Json key_json(const ReferenceKey& key) {
    return {{"drive", key.drive},     {"variant", key.variant},         {"technique", key.technique},
            {"backend", key.backend}, {"gl_renderer", key.gl_renderer}, {"simd", key.simd}};
}

ReferenceKey read_key(const CheckedJson& json) {
    return {json.at("drive").text(),   json.at("variant").text(),     json.at("technique").text(),
            json.at("backend").text(), json.at("gl_renderer").text(), json.at("simd").text()};
}

/// A name from a file of ours: one plain part, so that it cannot lead out of its folder.
std::string read_name(const CheckedJson& json) {
    const std::string name = json.text();
    if (name.empty() || name == "." || name == ".." || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
        json.refuse("a plain name");
    return name;
}

/// A key and the folder in the store that holds its reference.
struct IndexEntry {
    ReferenceKey key;
    std::string folder;
};

std::vector<IndexEntry> read_index(const fs::path& store) {
    std::vector<IndexEntry> entries;
    std::error_code error;
    if (!fs::exists(store / "index.json", error) && !error)
        return entries;
    const CheckedJson index = CheckedJson::read(store / "index.json");
    index.expect_schema(index_schema, 1);
    for (const CheckedJson& entry : index.at("references").items())
        entries.push_back({read_key(entry.at("key")), read_name(entry.at("folder"))});
    return entries;
}

std::string index_text(const std::vector<IndexEntry>& entries) {
    Json references = Json::array();
    for (const IndexEntry& entry : entries)
        references.push_back({{"key", key_json(entry.key)}, {"folder", entry.folder}});
    return Json{{"schema", index_schema}, {"schema_version", 1}, {"references", references}}.dump(2) + "\n";
}

Json reading_json(const Reading& reading) {
    Json json{{"name", reading.name}, {"value", nullptr}, {"unit", reading.unit}, {"frame", reading.tick}};
    if (reading.value)
        json["value"] = *reading.value;
    return json;
}

Reading read_reading(const CheckedJson& json) {
    return {json.at("name").text(), json.at("value").number_or_null(), json.at("unit").text(), "", json.at("frame").whole(), ""};
}

/// Copies the frames into `folder`, under names of the store, and returns what reference.json says of them.
Json copy_frames(const std::vector<ReferenceFrame>& frames, const fs::path& folder) {
    Json list = Json::array();
    for (const ReferenceFrame& frame : frames) {
        FilesRead opened;
        const std::string content = read_file(frame.exr, opened, most_frame_bytes);
        const std::string name = fmt::format("{:06}-{}-{}.exr", frame.tick, list.size(), file_name_of(frame.view));
        write_durably(folder / name, content);
        list.push_back({{"frame", frame.tick}, {"view", frame.view}, {"exr", name}, {"xxh128", opened.front().xxh128}});
    }
    return list;
}

AcceptedReference read_reference(const fs::path& folder) {
    const CheckedJson json = CheckedJson::read(folder / "reference.json");
    json.expect_schema(reference_schema, 1);
    AcceptedReference reference;
    reference.key = read_key(json.at("key"));
    for (const CheckedJson& reading : json.at("readings").items())
        reference.readings.push_back(read_reading(reading));
    for (const CheckedJson& frame : json.at("frames").items()) {
        const fs::path exr = folder / read_name(frame.at("exr"));
        FilesRead opened;
        read_file(exr, opened, most_frame_bytes);
        if (opened.front().xxh128 != frame.at("xxh128").text())
            throw InputError({exr, 0, 0, {}}, "is not the frame that was accepted: its hash is " + opened.front().xxh128,
                             frame.at("xxh128").text());
        reference.frames.push_back({frame.at("frame").whole(), frame.at("view").text(), exr});
    }
    return reference;
}

bool is_whole(const fs::path& folder) {
    try {
        read_reference(folder);
        return true;
    } catch (const InputError&) {
        return false;
    }
}

/// What a killed process left half written. Nobody else is at it: the store is locked.
void remove_leftovers(const fs::path& store) {
    std::vector<fs::path> leftovers;
    for (const fs::directory_entry& entry : fs::directory_iterator(store))
        if (const std::string name = entry.path().filename().string(); name.starts_with(".part-") || name.starts_with(".index-"))
            leftovers.push_back(entry.path());
    for (const fs::path& leftover : leftovers) {
        std::error_code ignored;
        fs::remove_all(leftover, ignored);
    }
}

/// A folder that is gone with this value unless it was renamed into place.
struct PartFolder {
    fs::path path;
    explicit PartFolder(fs::path p) : path(std::move(p)) { make_folder(path); }
    ~PartFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    PartFolder(const PartFolder&) = delete;
    PartFolder& operator=(const PartFolder&) = delete;
};

/// Writes one reference beside the others; nothing refers to it yet. Its folder is named by its content, so that the same results
/// accepted again are the same folder.
IndexEntry write_reference(const fs::path& store, const AcceptedReference& reference) {
    const PartFolder part(store / fmt::format(".part-{}", ::getpid()));
    Json readings = Json::array();
    for (const Reading& reading : reference.readings)
        readings.push_back(reading_json(reading));
    const Json json{{"schema", reference_schema},
                    {"schema_version", 1},
                    {"key", key_json(reference.key)},
                    {"readings", readings},
                    {"frames", copy_frames(reference.frames, part.path)}};
    const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    write_durably(part.path / "reference.json", text);
    sync_folder(part.path);
    const std::string name =
        fmt::format("{}-{}-{}", file_name_of(reference.key.drive).substr(0, 60), file_name_of(reference.key.variant).substr(0, 60),
                    content_hash(text.data(), text.size()).substr(0, 16));
    if (!is_whole(store / name)) {
        std::error_code ignored;
        fs::remove_all(store / name, ignored); // damaged: the rename needs an empty place
        rename_durably(part.path, store / name);
    }
    return {reference.key, name};
}

} // namespace

std::optional<AcceptedReference> find_reference(const fs::path& store, const ReferenceKey& key) {
    for (const IndexEntry& entry : read_index(store))
        if (entry.key == key)
            return read_reference(store / entry.folder);
    return std::nullopt;
}

void store_references(const fs::path& store, const std::vector<AcceptedReference>& references) {
    make_folder(store);
    const FolderLock lock(store);
    remove_leftovers(store);
    const std::vector<IndexEntry> before = read_index(store);
    std::vector<IndexEntry> after = before;
    for (const AcceptedReference& reference : references) {
        IndexEntry entry = write_reference(store, reference);
        const auto known = std::ranges::find(after, entry.key, &IndexEntry::key);
        if (known == after.end())
            after.push_back(std::move(entry));
        else
            *known = std::move(entry);
    }
    const auto order = [](const IndexEntry& entry) { return key_text(entry.key); };
    std::ranges::sort(after, {}, order);
    const fs::path next = store / fmt::format(".index-{}.json", ::getpid());
    write_durably(next, index_text(after));
    rename_durably(next, store / "index.json"); // here the new references hold
    for (const IndexEntry& entry : before)
        if (std::ranges::find(after, entry.folder, &IndexEntry::folder) == after.end()) {
            std::error_code ignored;
            fs::remove_all(store / entry.folder, ignored);
        }
}

} // namespace fernlicht
