#include "runner/files/object_store.h"

#include "runner/files/durable_files.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <system_error>

namespace fernlicht {
namespace {

constexpr std::size_t max_object_bytes = std::size_t{1} << 30;

/// nullopt where there is none; what cannot be read is not damaged.
std::optional<std::string> content_of_object(const std::filesystem::path& path) {
    const auto fail = [&] { throw DeviceError(path.string() + ": cannot be read: " + std::generic_category().message(errno)); };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rbe"), std::fclose);
    if (!file && (errno == ENOENT || errno == ENOTDIR))
        return std::nullopt;
    struct stat status {};
    if (!file || ::fstat(::fileno(file.get()), &status) != 0)
        fail();
    std::string content(std::min(static_cast<std::size_t>(status.st_size), max_object_bytes + 1), '\0');
    content.resize(std::fread(content.data(), 1, content.size(), file.get()));
    if (std::ferror(file.get()))
        fail();
    return content;
}

} // namespace

std::filesystem::path object_path(const std::filesystem::path& store, const std::string& hash) {
    return store / "objects" / hash.substr(0, 2) / hash.substr(2);
}

bool holds_object(const std::filesystem::path& store, const std::string& hash) {
    const std::optional<std::string> content = content_of_object(object_path(store, hash));
    return content && content_hash(content->data(), content->size()) == hash;
}

std::string put_object(const std::filesystem::path& store, const std::string& content) {
    std::string hash = content_hash(content.data(), content.size());
    const std::filesystem::path path = object_path(store, hash);
    if (content.size() > max_object_bytes)
        throw DeviceError(fmt::format("{}: {} bytes cannot be kept, at most {}", path.string(), content.size(), max_object_bytes));
    if (holds_object(store, hash))
        return hash;
    make_folder(path.parent_path());
    write_durably(path, content);
    return hash;
}

std::string get_object(const std::filesystem::path& store, const std::string& hash, const std::string& what) {
    const std::filesystem::path path = object_path(store, hash);
    std::optional<std::string> content = content_of_object(path);
    if (!content)
        throw InputError({path, 0, 0, {}}, "is missing", "the " + what);
    if (const std::string found = content_hash(content->data(), content->size()); found != hash)
        throw InputError({path, 0, 0, {}}, fmt::format("is not the {}: its hash is {}", what, found), hash);
    return std::move(*content);
}

} // namespace fernlicht
