#include "scenarios/models/gltf_file.h"

#include "scenarios/values/errors.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace fernlicht {
namespace {

constexpr int deepest_json = 64;
constexpr std::size_t max_json_values = 4'000'000;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

nlohmann::json parsed(const std::string& text, const std::filesystem::path& path) {
    std::size_t values = 0;
    const auto watch = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
        if (depth > deepest_json)
            throw InputError({path, 0, 0, {}}, fmt::format("nested deeper than {} levels", deepest_json), "a glTF model");
        if (++values > max_json_values)
            throw InputError({path, 0, 0, {}}, fmt::format("more than {} values of JSON", max_json_values), "a glTF model");
        return true;
    };
    try {
        nlohmann::json json = nlohmann::json::parse(text, watch);
        if (!json.is_object())
            throw InputError({path, 0, 0, {}}, "found JSON that is no object", "a glTF model");
        return json;
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t at = std::min(error.byte, text.size());
        const auto line = static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')) + 1;
        throw InputError({path, line, 0, {}}, fmt::format("no JSON at byte {}", at), "a glTF model");
    } catch (const nlohmann::json::out_of_range&) { // 1e999
        throw InputError({path, 0, 0, {}}, "found a number beyond what a double holds", "a glTF model");
    }
}

std::uint32_t little_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

/// The JSON of a .glb; its binary chunk goes to the file.
std::string unpacked_glb(const std::string& bytes, GltfFile& file) {
    const auto fail = [&](const std::string& found, const std::string& expected) {
        throw InputError({file.path, 0, 0, {}}, found, expected);
    };
    if (bytes.size() < 20)
        fail(fmt::format("{} bytes", bytes.size()), "a .glb with its header");
    if (const std::uint32_t version = little_endian(bytes, 4); version != 2)
        fail(fmt::format("a .glb of version {}", version), "version 2");
    if (const std::uint32_t length = little_endian(bytes, 8); length > bytes.size())
        fail(fmt::format("{} bytes where the header says {}", bytes.size(), length), "the whole file");
    std::string json;
    bool first = true;
    for (std::size_t at = 12; at + 8 <= bytes.size(); first = false) {
        const std::uint32_t length = little_endian(bytes, at), type = little_endian(bytes, at + 4);
        at += 8;
        if (length > bytes.size() - at)
            fail(fmt::format("a chunk of {} bytes at byte {} of {}", length, at, bytes.size()), "a chunk that ends within the file");
        if (first != (type == json_chunk))
            fail(first ? "a first chunk that is no JSON" : "a second chunk of JSON", "JSON first, and once");
        if (first)
            json = bytes.substr(at, length);
        else if (type == binary_chunk && file.binary.empty())
            file.binary = bytes.substr(at, length);
        at += (std::size_t{length} + 3) / 4 * 4;
    }
    return json;
}

std::string from_base64(std::string_view text, const GltfEntry& asked_by) {
    std::string out;
    out.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int count = 0;
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (const char c : text) {
        if (c == '=')
            break;
        const std::size_t value = c == '-' ? 62 : c == '_' ? 63 : alphabet.find(c);
        if (value == std::string_view::npos)
            asked_by.refuse(fmt::format("found '{}' in base64", printable(std::string(1, c))), "base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count >= 8) {
            count -= 8;
            out += static_cast<char>(bits >> count & 0xFF);
        }
    }
    return out;
}

/// %20 as a space. A percent sign that is followed by no such digits stays.
std::string percent_decoded(const std::string& text) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
    };
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && digit(text[i + 1]) >= 0 && digit(text[i + 2]) >= 0) {
            out += static_cast<char>(16 * digit(text[i + 1]) + digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

void read_buffers(GltfFile& file) {
    std::size_t index = 0;
    for (const GltfEntry& buffer : file.root().list("buffers")) {
        const std::size_t length = buffer.require("byteLength").whole(std::size_t{1} << 31);
        const auto uri = buffer.find("uri");
        ++index;
        const bool stands_in = std::ranges::any_of(std::array{"EXT_meshopt_compression", "KHR_meshopt_compression"}, [&](const char* name) {
            const auto extension = buffer.extension(name);
            return extension && extension->flag_or("fallback", false);
        });
        if (!uri && stands_in) { // what its views hold is compressed elsewhere
            file.buffers.emplace_back();
            continue;
        }
        if (!uri && index > 1)
            buffer.refuse("has no uri", "one: only the first buffer can be the .glb's own");
        std::string bytes = uri ? file.at_uri(*uri) : std::move(file.binary);
        if (bytes.size() < length)
            buffer.refuse(fmt::format("{} bytes where byteLength says {}", bytes.size(), length), "all of them");
        file.buffers.push_back(std::move(bytes));
    }
}

constexpr double largest = 1e9;

glm::dmat4 local_transform(const GltfEntry& node) {
    glm::dmat4 m(1.0);
    if (const auto matrix = node.find("matrix")) {
        const std::vector<double> v = matrix->numbers(16);
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                m[column][row] = v[static_cast<std::size_t>(4 * column + row)];
        if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
            matrix->refuse("found a matrix that is no affine transform", "a last row of 0 0 0 1");
    } else {
        if (const auto translation = node.find("translation")) {
            const std::vector<double> v = translation->numbers(3);
            m = glm::translate(m, {v[0], v[1], v[2]});
        }
        if (const auto rotation = node.find("rotation")) {
            const std::vector<double> v = rotation->numbers(4);
            const glm::dquat q(v[3], v[0], v[1], v[2]);
            if (!(glm::length(q) > 1e-6 && glm::length(q) < 1e6))
                rotation->refuse("a quaternion that is not 0");
            m *= glm::mat4_cast(glm::normalize(q));
        }
        if (const auto scale = node.find("scale")) {
            const std::vector<double> v = scale->numbers(3);
            m = glm::scale(m, {v[0], v[1], v[2]});
        }
    }
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(m[column][row]) < largest))
                node.refuse(fmt::format("a transform with {}", m[column][row]), "numbers below 1e9");
    return m;
}

/// Indices of the nodes to begin with: of the default scene, of the first, or all that are nobody's children.
std::vector<std::size_t> first_nodes(const GltfEntry& root, const std::vector<bool>& has_parent) {
    std::vector<std::size_t> first;
    const std::size_t scenes = root.list_size("scenes");
    if (scenes > 0) {
        const auto chosen = root.find("scene");
        const GltfEntry scene = root.at("scenes", chosen ? chosen->index(scenes, "scenes") : 0);
        for (const GltfEntry& node : scene.list("nodes"))
            first.push_back(node.index(has_parent.size(), "nodes"));
        return first;
    }
    for (std::size_t i = 0; i < has_parent.size(); ++i)
        if (!has_parent[i])
            first.push_back(i);
    return first;
}

} // namespace

std::string GltfFile::at_uri(const GltfEntry& uri) {
    const std::string text = uri.text();
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
            uri.refuse("found a data URI without base64", "base64");
        return from_base64(std::string_view(text).substr(comma + 1), uri);
    }
    const std::filesystem::path folder = path.parent_path();
    std::error_code error;
    std::filesystem::path relative(text);
    if (!std::filesystem::exists(folder / relative, error))
        relative = percent_decoded(text);
    const std::filesystem::path normal = relative.lexically_normal();
    if (text.empty() || text.find("://") != std::string::npos || normal.is_absolute() || normal.string().starts_with(".."))
        uri.refuse("a file beside or below the model's");
    if (!std::filesystem::exists(folder / normal, error))
        uri.refuse("there is no file " + printable((folder / normal).string(), 400), "a file beside or below the model's");
    return read_file(folder / normal, opened);
}

GltfFile open_gltf(const std::filesystem::path& path) {
    GltfFile file;
    file.path = path;
    const std::string bytes = read_file(path, file.opened);
    const bool packed = bytes.starts_with("glTF");
    file.json = parsed(packed ? unpacked_glb(bytes, file) : bytes, path);
    const GltfEntry root = file.root();
    const auto asset = root.find("asset");
    const auto version_entry = asset ? asset->find("version") : std::nullopt;
    const std::string version = !version_entry                       ? ""
                                : version_entry->value().is_string() ? version_entry->text()
                                                                     : version_entry->value().dump();
    const bool named_parts = root.find("meshes") && root.require("meshes").is_object();
    if (version.starts_with("1") || (version.empty() && named_parts))
        file.json = upgraded_gltf1(file.json, path, file.notes);
    else if (!version.starts_with("2"))
        throw InputError({path, 0, 0, "asset.version"}, version.empty() ? "no version" : fmt::format("version '{}'", printable(version)),
                         "glTF 2.0, or 1.0");
    read_buffers(file);
    return file;
}

void walk_nodes(const GltfEntry& root, const std::function<void(const GltfEntry&, const glm::dmat4&)>& visit) {
    const std::size_t count = root.list_size("nodes");
    std::vector<std::vector<std::size_t>> children(count);
    std::vector<bool> has_parent(count), met(count);
    for (std::size_t i = 0; i < count; ++i)
        for (const GltfEntry& child : root.at("nodes", i).list("children")) {
            const std::size_t index = child.index(count, "nodes");
            if (has_parent[index] || index == i)
                child.refuse(fmt::format("node {}, which {}", index, index == i ? "is its own child" : "has a parent already"), "a tree");
            has_parent[index] = true;
            children[i].push_back(index);
        }
    std::vector<std::pair<std::size_t, glm::dmat4>> waiting;
    const std::vector<std::size_t> first = first_nodes(root, has_parent);
    for (auto it = first.rbegin(); it != first.rend(); ++it)
        waiting.emplace_back(*it, glm::dmat4(1.0));
    // One parent each at most: what is met twice is a root named twice, or stands in a cycle that a scene leads into.
    while (!waiting.empty()) {
        const auto [index, parent] = waiting.back();
        waiting.pop_back();
        const GltfEntry node = root.at("nodes", index);
        if (met[index])
            node.refuse("it is reached twice", "a tree of nodes");
        met[index] = true;
        const glm::dmat4 world = parent * local_transform(node);
        visit(node, world);
        for (auto it = children[index].rbegin(); it != children[index].rend(); ++it)
            waiting.emplace_back(*it, world);
    }
    for (std::size_t i = 0; i < count && root.list_size("scenes") == 0; ++i)
        if (!met[i])
            root.at("nodes", i).refuse("it is its own ancestor", "a tree of nodes");
}

} // namespace fernlicht
