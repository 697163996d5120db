#include "scenarios/models/gltf_materials.h"

#include "scenarios/models/model.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/picture_decoding.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_pictures = 256, max_picture_pixels = std::size_t{4096} * 4096, max_pixels = 16 * max_picture_pixels;

float share(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

std::optional<GltfEntry> extension(const GltfEntry& entry, std::string_view name) {
    const auto all = entry.find("extensions");
    return all ? all->find(name) : std::nullopt;
}

/// KHR_texture_transform: scaled, turned counter-clockwise, then moved.
std::array<double, 6> uv_transform(const GltfEntry& transform) {
    const auto offset = transform.find("offset"), scale = transform.find("scale");
    const std::vector<double> o = offset ? offset->numbers(2) : std::vector<double>{0.0, 0.0};
    const std::vector<double> s = scale ? scale->numbers(2) : std::vector<double>{1.0, 1.0};
    const double angle = transform.number_or("rotation", 0.0), c = std::cos(angle), n = std::sin(angle);
    return {c * s[0], n * s[1], o[0], -n * s[0], c * s[1], o[1]};
}

/// Our own keys beside the file format's.
void read_retroreflection(const GltfEntry& extras, Material& material) {
    const auto angle = [&](const char* key, float otherwise) {
        return static_cast<float>(std::clamp(extras.number_or(key, static_cast<double>(otherwise)), 1e-5, 3.0));
    };
    material.retro_rl = static_cast<float>(std::clamp(extras.number_or("retro_rl", 0.0), 0.0, 1e4));
    material.retro_reference_rad = angle("retro_reference_rad", material.retro_reference_rad);
    material.retro_falloff_rad = angle("retro_falloff_rad", material.retro_falloff_rad);
    if (const auto colour = extras.find("retro_rgb")) {
        const std::vector<double> rgb = colour->numbers(3);
        if (*std::ranges::min_element(rgb) < 0.0 || !(*std::ranges::max_element(rgb) > 0.0) || *std::ranges::max_element(rgb) > 1.0)
            colour->refuse(fmt::format("[{}, {}, {}]", rgb[0], rgb[1], rgb[2]), "three shares from 0 to 1, not all 0");
        material.retro_rgb = {rgb[0], rgb[1], rgb[2]};
    } else if (material.albedo != glm::vec3(0.0F)) {
        material.retro_rgb = material.albedo; // coloured sheeting returns what its colour lets through
    }
}

} // namespace

void add_note(std::vector<std::string>& notes, std::string note) {
    if (std::ranges::find(notes, note) == notes.end())
        notes.push_back(std::move(note));
}

const GltfLook& GltfMaterials::look(const std::optional<GltfEntry>& reference) {
    if (!reference) {
        if (!default_) {
            default_ = GltfLook{static_cast<std::uint32_t>(model_.materials.size())};
            model_.materials.push_back({.name = "default", .albedo = glm::vec3(1.0F)});
            add_note(model_.notes, "triangles without a material are white, as glTF has it");
        }
        return *default_;
    }
    const std::size_t index = reference->index(file_.root().list_size("materials"), "materials");
    if (const auto known = looks_.find(index); known != looks_.end())
        return known->second;
    return looks_.emplace(index, made(file_.root().at("materials", index))).first->second;
}

GltfLook GltfMaterials::made(const GltfEntry& entry) {
    GltfLook look{static_cast<std::uint32_t>(model_.materials.size())};
    Material material;
    material.name = printable(entry.text_or("name", fmt::format("material {}", look.material)));
    std::vector<double> colour{1.0, 1.0, 1.0, 1.0};
    std::optional<GltfEntry> factor, picture;
    if (const auto specular = extension(entry, "KHR_materials_pbrSpecularGlossiness")) {
        factor = specular->find("diffuseFactor");
        picture = specular->find("diffuseTexture");
        add_note(model_.notes, "of specular and glossy materials the diffuse part was taken");
    } else if (const auto pbr = entry.find("pbrMetallicRoughness")) {
        factor = pbr->find("baseColorFactor");
        picture = pbr->find("baseColorTexture");
    }
    if (factor)
        colour = factor->numbers(4);
    material.albedo = {share(colour[0]), share(colour[1]), share(colour[2])};
    if (picture)
        material.texture = texture(*picture, look);
    if (const auto emissive = entry.find("emissiveFactor"); emissive && !entry.find("emissiveTexture")) {
        const auto strength = extension(entry, "KHR_materials_emissive_strength");
        const std::vector<double> rgb = emissive->numbers(3);
        const auto cdm2 = static_cast<float>(std::clamp(strength ? strength->number_or("emissiveStrength", 1.0) : 1.0, 0.0, 1e6));
        material.emission_cdm2 = {share(rgb[0]) * cdm2, share(rgb[1]) * cdm2, share(rgb[2]) * cdm2};
    }
    if (const auto extras = entry.find("extras"); extras && extras->is_object())
        read_retroreflection(*extras, material);
    look.double_sided = entry.flag_or("doubleSided", false);
    note_what_is_lost(entry, material.name);
    model_.materials.push_back(std::move(material));
    return look;
}

void GltfMaterials::note_what_is_lost(const GltfEntry& entry, const std::string& name) {
    const auto pbr = entry.find("pbrMetallicRoughness");
    if (pbr && (pbr->number_or("metallicFactor", 0.0) > 0.0 || pbr->find("metallicRoughnessTexture")))
        add_note(model_.notes, fmt::format("material {}: metal and gloss are left out, its base colour reflects diffusely", name));
    if (entry.text_or("alphaMode", "OPAQUE") != "OPAQUE")
        add_note(model_.notes, fmt::format("material {} is transparent in the file and opaque here", name));
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        if (entry.find(key))
            add_note(model_.notes, fmt::format("material {}: its {} is left out", name, key));
}

int GltfMaterials::texture(const GltfEntry& info, GltfLook& look) {
    const GltfEntry root = file_.root();
    const GltfEntry texture = root.at("textures", info.require("index").index(root.list_size("textures"), "textures"));
    look.uv_set = info.whole_or("texCoord", 0, 7);
    if (const auto transform = extension(info, "KHR_texture_transform")) {
        look.uv_transform = uv_transform(*transform);
        look.uv_set = transform->whole_or("texCoord", look.uv_set, 7);
    }
    if (const auto index = texture.find("sampler")) {
        const GltfEntry sampler = root.at("samplers", index->index(root.list_size("samplers"), "samplers"));
        if (sampler.whole_or("wrapS", 10497, 100'000) != 10497 || sampler.whole_or("wrapT", 10497, 100'000) != 10497)
            add_note(model_.notes, "textures repeat, also those that the file clamps or mirrors at their edges");
    }
    const auto source = texture.find("source");
    if (!source) {
        add_note(model_.notes, fmt::format("{} has no picture in PNG or JPEG and is left out", texture.way()));
        return -1;
    }
    const std::size_t index = source->index(root.list_size("images"), "images");
    if (const auto known = pictures_.find(index); known != pictures_.end())
        return known->second;
    const GltfEntry image = root.at("images", index);
    return pictures_.emplace(index, picture(image, printable(image.text_or("name", fmt::format("image {}", index))))).first->second;
}

int GltfMaterials::picture(const GltfEntry& image, const std::string& name) {
    if (pictures_.size() >= max_pictures)
        image.refuse(fmt::format("more than {} pictures", max_pictures), "fewer");
    const auto uri = image.find("uri");
    const std::string bytes = uri ? file_.at_uri(*uri) : std::string(accessors_.view_bytes(image.require("bufferView")));
    const DecodedPicture decoded =
        decode_picture(file_.path, image.way(), bytes, std::min(max_picture_pixels, max_pixels - decoded_pixels_));
    decoded_pixels_ += static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height);
    model_.textures.push_back(surface_texture(name, decoded.width, decoded.height, decoded.rgba, max_texture_px));
    const SurfaceTexture& made = model_.textures.back();
    if (made.width != decoded.width || made.height != decoded.height)
        add_note(model_.notes, fmt::format("picture {} of {} x {} texels is taken at {} x {}", name, decoded.width, decoded.height,
                                           made.width, made.height));
    return static_cast<int>(model_.textures.size()) - 1;
}

} // namespace fernlicht
