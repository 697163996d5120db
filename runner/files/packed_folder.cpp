#include "runner/files/packed_folder.h"

#include "runner/files/checked_json.h"
#include "runner/files/durable_files.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/files.h"

#include <algorithm>
#include <fmt/format.h>

namespace fernlicht {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* packed_schema = "fernlicht packed folder";
constexpr std::size_t largest_packed_bytes = std::size_t{1} << 30;

bool leads_out(const fs::path& name) {
    return name.empty() || name.is_absolute() || std::ranges::any_of(name, [](const fs::path& part) { return part == ".."; });
}

} // namespace

PackedFiles files_below(const fs::path& folder) {
    PackedFiles files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) {
            FilesRead opened;
            files[fs::relative(entry.path(), folder).generic_string()] = read_file(entry.path(), opened, largest_packed_bytes, true);
        }
    return files;
}

std::string packed(const PackedFiles& files) {
    Json list = Json::array();
    std::size_t bytes = 0;
    for (const auto& [name, content] : files) {
        list.push_back(Json{{"name", name}, {"bytes", content.size()}});
        bytes += content.size();
    }
    std::string text = Json{{"schema", packed_schema}, {"schema_version", 1}, {"files", list}}.dump() + "\n";
    text.reserve(text.size() + bytes);
    for (const auto& [name, content] : files)
        text += content;
    return text;
}

PackedFiles unpacked(const std::string& text, const fs::path& from) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const CheckedJson head = CheckedJson::parse(text.substr(0, end), from);
    head.expect_schema(packed_schema, 1);
    PackedFiles files;
    std::size_t at = std::min(end + 1, text.size());
    for (const CheckedJson& file : head.at("files").items()) {
        const std::string name = file.at("name").text();
        if (leads_out(name))
            file.at("name").refuse("a name below the folder");
        const std::uint64_t bytes = file.at("bytes").count();
        if (bytes > text.size() - at)
            file.at("bytes").refuse(fmt::format("at most the {} bytes that are left", text.size() - at));
        files[name] = text.substr(at, bytes);
        at += bytes;
    }
    if (at != text.size())
        throw InputError({from, 0, 0, {}}, fmt::format("found {} bytes behind the last file", text.size() - at), "none");
    return files;
}

void write_files(const PackedFiles& files, const fs::path& folder) {
    for (const auto& [name, content] : files) {
        make_folder((folder / name).parent_path());
        write_file(folder / name, content);
    }
}

} // namespace fernlicht
