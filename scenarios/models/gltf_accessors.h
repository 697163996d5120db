// Numbers out of a glTF file's buffers, with every index, offset and length checked before a byte is touched.
#pragma once

#include "scenarios/models/gltf_file.h"

#include <cstdint>

namespace fernlicht {

inline constexpr std::size_t most_accessor_elements = 12'000'000;

/// What accessors of a file hold. Points into the file.
class GltfAccessors {
  public:
    explicit GltfAccessors(const GltfFile& file) : file_(file), root_(file.root()), count_(root_.list_size("accessors")) {}

    /// Follows every accessor to its bytes, also those that nothing uses, and every primitive to its accessors. Throws InputError.
    void check_all() const;
    /// The accessor that `reference` is the index of, as rows of `width` numbers; integers that are "normalized" as -1..1 or 0..1.
    /// Refuses another width, and numbers that are not finite.
    std::vector<float> floats(const GltfEntry& reference, std::size_t width) const;
    /// Unsigned integers, each below `bound`.
    std::vector<std::uint32_t> indices(const GltfEntry& reference, std::size_t bound) const;
    /// Bytes of a buffer view.
    std::string_view view_bytes(const GltfEntry& reference) const;

  private:
    struct Layout;
    struct Block;
    Layout layout(const GltfEntry& reference) const;
    Layout layout_of(const GltfEntry& accessor) const;
    Block block(const GltfEntry& view_reference, std::size_t offset, std::size_t count, std::size_t element, std::size_t stride) const;
    template <class Take> void each(const Layout& layout, Take take) const;

    const GltfFile& file_;
    GltfEntry root_;
    std::size_t count_;
};

} // namespace fernlicht
