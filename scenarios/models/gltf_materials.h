// Numbers out of a glTF file's buffers, with every index, offset and length checked before a byte is touched.
// Materials of a glTF file as ours: base colour as diffuse reflectance, its texture, emission; the rest is noted as left out.
#pragma once

#include "scenarios/models/gltf_file.h"
#include "scenarios/models/model.h"
#include "scenarios/values/picture_decoding.h"

#include <array>
#include <map>

namespace fernlicht {

inline constexpr std::size_t max_accessor_elements = 12'000'000;

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
    /// Bytes of a buffer view, decoded where it is compressed.
    std::string_view view_bytes(const GltfEntry& reference) const;
    /// An accessor's own words, for what KHR_draco_mesh_compression keeps in its place.
    GltfEntry accessor(const GltfEntry& reference) const { return root_.at("accessors", reference.index(count_, "accessors")); }
    std::size_t width(const GltfEntry& reference) const; ///< numbers an element

  private:
    struct Layout;
    struct Block;
    Layout layout(const GltfEntry& reference) const;
    std::string_view within(const GltfEntry& view) const;
    std::string_view decoded(const GltfEntry& view, std::size_t index, const GltfEntry& compressed) const;
    Layout layout_of(const GltfEntry& accessor) const;
    Block block(const GltfEntry& view_reference, std::size_t offset, std::size_t count, std::size_t element, std::size_t stride) const;
    template <class Take> void each(const Layout& layout, Take take) const;

    const GltfFile& file_;
    GltfEntry root_;
    std::size_t count_;
    mutable std::map<std::size_t, std::string> decoded_; ///< buffer views that were compressed
    mutable std::size_t decoded_bytes_ = 0;
};

/// Adds a sentence once.
void add_note(std::vector<std::string>& notes, std::string note);

/// A material as primitives need it.
struct GltfLook {
    std::uint32_t material = 0; ///< into Model::materials
    bool double_sided = false;
    double opacity = 1.0, cutoff = 0.0;                   ///< where opacity, times that of the picture, is less, nothing is
    std::size_t uv_set = 0;                               ///< TEXCOORD_n
    std::array<double, 6> uv_transform{1, 0, 0, 0, 1, 0}; ///< u' = a u + b v + c, v' = d u + e v + f
};

/// Makes each material and each picture when it is first asked for, so that what no triangle uses costs nothing.
class GltfMaterials {
  public:
    GltfMaterials(GltfFile& file, const GltfAccessors& accessors, Model& model) : file_(file), accessors_(accessors), model_(model) {}

    /// The material that `reference` is the index of, or the file format's default.
    const GltfLook& look(const std::optional<GltfEntry>& reference);

  private:
    GltfLook made(const GltfEntry& material);
    void note_what_is_lost(const GltfEntry& material, const std::string& name);
    int texture(const GltfEntry& info, GltfLook& look);
    struct Picture {
        int texture; ///< into Model::textures
        std::vector<std::string> doubts;
    };
    Picture picture(const GltfEntry& image, std::size_t index, bool cut_out);
    DecodedPicture decoded_webp(const GltfEntry& image, const std::string& bytes, std::size_t most_pixels);
    /// Images that hold something else than colours, and what.
    const std::map<std::size_t, const char*>& data_pictures();
    void doubt_factor(const std::vector<double>& colour, const Material& material);

    GltfFile& file_;
    const GltfAccessors& accessors_;
    Model& model_;
    std::map<std::size_t, GltfLook> looks_;                    ///< by index in the file
    std::map<std::pair<std::size_t, bool>, Picture> pictures_; ///< by image; those to cut out apart
    std::optional<std::map<std::size_t, const char*>> data_pictures_;
    std::optional<GltfLook> default_;
    std::size_t decoded_pixels_ = 0;
};

} // namespace fernlicht
