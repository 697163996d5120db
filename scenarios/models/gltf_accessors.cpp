#include "scenarios/models/gltf_codecs.h"
#include "scenarios/models/gltf_materials.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t max_offset = std::size_t{1} << 31, max_decoded_bytes = std::size_t{1} << 28;

std::size_t component_bytes(std::size_t type) {
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : type == 5125 || type == 5126 ? 4 : 0;
}

std::size_t width_of(const std::string& type) {
    return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
}

template <class T> T load(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
}

/// A component as the number it stands for.
double number(const char* bytes, std::size_t type, bool normalized) {
    switch (type) {
    case 5120:
        return normalized ? std::max(load<std::int8_t>(bytes) / 127.0, -1.0) : load<std::int8_t>(bytes);
    case 5121:
        return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case 5122:
        return normalized ? std::max(load<std::int16_t>(bytes) / 32767.0, -1.0) : load<std::int16_t>(bytes);
    case 5123:
        return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case 5125:
        return load<std::uint32_t>(bytes);
    default:
        return static_cast<double>(load<float>(bytes));
    }
}

} // namespace

/// `count` elements at a stride.
struct GltfAccessors::Block {
    const char* first = nullptr; ///< nullptr: all zero
    std::size_t stride = 0;
};

struct GltfAccessors::Layout {
    explicit Layout(GltfEntry accessor) : entry(std::move(accessor)) {}

    GltfEntry entry;
    std::size_t count = 0, width = 0, type = 0, bytes = 0; ///< bytes: of a component
    bool normalized = false;
    Block dense;
    std::size_t sparse_count = 0, sparse_type = 0;
    Block sparse_indices, sparse_values;
};

std::string_view GltfAccessors::view_bytes(const GltfEntry& reference) const {
    const std::size_t index = reference.index(root_.list_size("bufferViews"), "buffer views");
    const GltfEntry view = root_.at("bufferViews", index);
    const auto compressed = view.extension("EXT_meshopt_compression");
    return compressed ? decoded(view, index, *compressed) : within(view);
}

std::string_view GltfAccessors::decoded(const GltfEntry& view, std::size_t index, const GltfEntry& compressed) const {
    if (const auto known = decoded_.find(index); known != decoded_.end())
        return known->second;
    MeshoptView given{within(compressed), compressed.require("count").whole(max_accessor_elements),
                      compressed.require("byteStride").whole(256), compressed.require("mode").text(), compressed.text_or("filter", "NONE")};
    decoded_bytes_ += given.count * given.stride;
    if (decoded_bytes_ > max_decoded_bytes)
        compressed.refuse(fmt::format("{} bytes once it is decoded, with what came before", decoded_bytes_),
                          fmt::format("at most {}", max_decoded_bytes));
    if (const std::size_t length = view.require("byteLength").whole(max_offset); length > given.count * given.stride)
        compressed.refuse(fmt::format("{} elements of {} bytes", given.count, given.stride),
                          fmt::format("the {} bytes of its view", length));
    static const auto decode = reinterpret_cast<DecodeMeshopt*>(module_function("fernlicht-gltf", "fernlicht_decode_meshopt"));
    std::string& bytes = decoded_[index];
    try {
        decode(given, bytes);
    } catch (const std::invalid_argument& error) {
        compressed.refuse(printable(error.what()), "elements compressed by meshoptimizer");
    }
    return bytes;
}

/// Bytes of a buffer that a view, or the extension of one, points to.
std::string_view GltfAccessors::within(const GltfEntry& view) const {
    const GltfEntry buffer_entry = view.require("buffer");
    const std::string& buffer = file_.buffers[buffer_entry.index(file_.buffers.size(), "buffers")];
    const std::size_t offset = view.whole_or("byteOffset", 0, max_offset), length = view.require("byteLength").whole(max_offset);
    if (offset > buffer.size() || length > buffer.size() - offset)
        view.refuse(fmt::format("bytes {} to {} of a buffer of {}", offset, offset + length, buffer.size()), "a view within its buffer");
    return std::string_view(buffer).substr(offset, length);
}

GltfAccessors::Block GltfAccessors::block(const GltfEntry& view_reference, std::size_t offset, std::size_t count, std::size_t element,
                                          std::size_t stride) const {
    const std::string_view bytes = view_bytes(view_reference);
    if (stride == 0)
        stride =
            root_.at("bufferViews", view_reference.index(root_.list_size("bufferViews"), "buffer views")).whole_or("byteStride", 0, 65536);
    if (stride == 0)
        stride = element;
    const std::size_t needed = count == 0 ? 0 : offset + stride * (count - 1) + element;
    if (needed > bytes.size())
        view_reference.refuse(fmt::format("{} elements that need {} bytes in a buffer view of {}", count, needed, bytes.size()),
                              "elements within their buffer view");
    return {bytes.data() + offset, stride};
}

void GltfAccessors::check_all() const {
    for (std::size_t i = 0; i < count_; ++i)
        if (const GltfEntry accessor = root_.at("accessors", i);
            accessor.find("type") && !accessor.require("type").text().starts_with("MAT"))
            layout_of(accessor);
    for (const GltfEntry& image : root_.list("images"))
        if (const auto view = image.find("bufferView"))
            view_bytes(*view);
    for (const GltfEntry& mesh : root_.list("meshes"))
        for (const GltfEntry& primitive : mesh.list("primitives")) {
            if (const auto indices = primitive.find("indices"))
                indices->index(count_, "accessors");
            const auto attributes = primitive.find("attributes");
            for (const char* name : {"POSITION", "NORMAL"})
                if (const auto attribute = attributes ? attributes->find(name) : std::nullopt)
                    attribute->index(count_, "accessors");
        }
}

GltfAccessors::Layout GltfAccessors::layout(const GltfEntry& reference) const { return layout_of(accessor(reference)); }

std::size_t GltfAccessors::width(const GltfEntry& reference) const { return width_of(accessor(reference).require("type").text()); }

GltfAccessors::Layout GltfAccessors::layout_of(const GltfEntry& entry) const {
    Layout l(entry);
    l.count = entry.require("count").whole(max_accessor_elements);
    l.type = entry.require("componentType").whole(10'000);
    l.bytes = component_bytes(l.type);
    if (l.bytes == 0)
        entry.require("componentType").refuse("5120 to 5123, 5125 or 5126");
    l.width = width_of(entry.require("type").text());
    if (l.width == 0)
        entry.require("type").refuse("SCALAR, VEC2, VEC3 or VEC4");
    l.normalized = entry.flag_or("normalized", false);
    if (const auto view = entry.find("bufferView"))
        l.dense =
            block(*view, entry.whole_or("byteOffset", 0, max_offset), l.count, l.width * l.bytes, entry.whole_or("stride1", 0, 65536));
    if (const auto sparse = entry.find("sparse")) {
        l.sparse_count = sparse->require("count").whole(l.count);
        const GltfEntry indices = sparse->require("indices"), values = sparse->require("values");
        l.sparse_type = indices.require("componentType").whole(10'000);
        if (l.sparse_type != 5121 && l.sparse_type != 5123 && l.sparse_type != 5125)
            indices.require("componentType").refuse("5121, 5123 or 5125");
        l.sparse_indices = block(indices.require("bufferView"), indices.whole_or("byteOffset", 0, max_offset), l.sparse_count,
                                 component_bytes(l.sparse_type), component_bytes(l.sparse_type));
        l.sparse_values = block(values.require("bufferView"), values.whole_or("byteOffset", 0, max_offset), l.sparse_count,
                                l.width * l.bytes, l.width * l.bytes);
    }
    return l;
}

/// take(element, component, where its bytes are) for all that is not zero, in the end for what is replaced.
template <class Take> void GltfAccessors::each(const Layout& l, Take take) const {
    for (std::size_t i = 0; l.dense.first && i < l.count; ++i)
        for (std::size_t k = 0; k < l.width; ++k)
            take(i, k, l.dense.first + i * l.dense.stride + k * l.bytes);
    for (std::size_t s = 0; s < l.sparse_count; ++s) {
        const auto i = static_cast<std::size_t>(number(l.sparse_indices.first + s * l.sparse_indices.stride, l.sparse_type, false));
        if (i >= l.count)
            l.entry.refuse(fmt::format("replaces element {} of {}", i, l.count), "one of its elements");
        for (std::size_t k = 0; k < l.width; ++k)
            take(i, k, l.sparse_values.first + s * l.sparse_values.stride + k * l.bytes);
    }
}

std::vector<float> GltfAccessors::floats(const GltfEntry& reference, std::size_t width) const {
    const Layout l = layout(reference);
    if (l.width != width)
        reference.refuse(fmt::format("an accessor of {}", l.entry.require("type").text()), fmt::format("{} numbers an element", width));
    std::vector<float> all(l.count * width);
    each(l, [&](std::size_t i, std::size_t k, const char* bytes) {
        all[i * width + k] = static_cast<float>(number(bytes, l.type, l.normalized));
        if (!std::isfinite(all[i * width + k]))
            l.entry.refuse(fmt::format("element {} is not finite", i), "finite numbers");
    });
    return all;
}

std::vector<std::uint32_t> GltfAccessors::indices(const GltfEntry& reference, std::size_t bound) const {
    const Layout l = layout(reference);
    if (l.width != 1 || (l.type != 5121 && l.type != 5123 && l.type != 5125))
        reference.refuse("an accessor that holds no unsigned integers", "indices");
    std::vector<std::uint32_t> all(l.count);
    each(l, [&](std::size_t i, std::size_t, const char* bytes) { all[i] = static_cast<std::uint32_t>(number(bytes, l.type, false)); });
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i] >= bound)
            reference.refuse(fmt::format("index {} is {}", i, all[i]), fmt::format("below {}, the number of vertices", bound));
    return all;
}

} // namespace fernlicht
