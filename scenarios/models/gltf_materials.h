// Materials of a glTF file as ours: base colour as diffuse reflectance, its texture, emission; the rest is noted as left out.
#pragma once

#include "scenarios/models/gltf_accessors.h"
#include "scenarios/models/model.h"

#include <array>
#include <map>

namespace fernlicht {

/// Adds a sentence once.
void add_note(std::vector<std::string>& notes, std::string note);

/// A material as primitives need it.
struct GltfLook {
    std::uint32_t material = 0; ///< into Model::materials
    bool double_sided = false;
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
    int picture(const GltfEntry& image, const std::string& name);

    GltfFile& file_;
    const GltfAccessors& accessors_;
    Model& model_;
    std::map<std::size_t, GltfLook> looks_; ///< by index in the file
    std::map<std::size_t, int> pictures_;   ///< Model::textures by image
    std::optional<GltfLook> default_;
    std::size_t decoded_pixels_ = 0;
};

} // namespace fernlicht
