#include "runner/files/object_store.h"

#include "runner/files/durable_files.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_object_bytes = std::size_t{1} << 30;

} // namespace

std::filesystem::path object_path(const std::filesystem::path& store, const std::string& hash) {
    return store / "objects" / hash.substr(0, 2) / hash.substr(2);
}

bool holds_object(const std::filesystem::path& store, const std::string& hash) {
    try {
        get_object(store, hash, "content");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::string put_object(const std::filesystem::path& store, const std::string& content) {
    const std::string hash = content_hash(content.data(), content.size());
    if (holds_object(store, hash))
        return hash;
    const std::filesystem::path path = object_path(store, hash);
    make_folder(path.parent_path());
    write_durably(path, content);
    return hash;
}

std::string get_object(const std::filesystem::path& store, const std::string& hash, const std::string& what) {
    const std::filesystem::path path = object_path(store, hash);
    FilesRead opened;
    std::string content = read_file(path, opened, max_object_bytes, true);
    if (opened.front().xxh128 != hash)
        throw InputError({path, 0, 0, {}}, fmt::format("is not the {}: its hash is {}", what, opened.front().xxh128), hash);
    return content;
}

} // namespace fernlicht
