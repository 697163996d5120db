#include "scenarios/models/gltf_materials.h"

#include "scenarios/models/gltf_codecs.h"
#include "scenarios/models/model.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/picture_decoding.h"
#include "scenarios/values/program_module.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_pictures = 256, max_picture_pixels = std::size_t{4096} * 4096, max_pixels = 16 * max_picture_pixels;

float share(double value) { return static_cast<float>(std::clamp(value, 0.0, 1.0)); }

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

/// Below the cut-off there is nothing (cut_outs.h). What blends or lets light through is there from half its opacity on.
void read_opacity(const GltfEntry& material, double alpha, GltfLook& look) {
    const std::string mode = material.text_or("alphaMode", "OPAQUE");
    const auto clear = material.extension("KHR_materials_transmission");
    const double passed = clear ? std::clamp(clear->number_or("transmissionFactor", 0.0), 0.0, 1.0) : 0.0;
    look.opacity = (mode == "OPAQUE" ? 1.0 : std::clamp(alpha, 0.0, 1.0)) * (1.0 - passed);
    if (mode != "OPAQUE" || passed > 0.0)
        look.cutoff = mode == "MASK" ? std::clamp(material.number_or("alphaCutoff", 0.5), 0.0, 1.0) : 0.5;
}

/// Steps of 1/255 in all channels, as picture editors have them in sRGB; tenths people type.
bool in_srgb_steps(const std::vector<double>& colour) {
    bool coarse = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const double step = 255.0 * colour[c];
        if (std::abs(step - std::round(step)) > 1e-3 || colour[c] < 0.0 || colour[c] > 1.0)
            return false;
        coarse = coarse && std::abs(5.0 * colour[c] - std::round(5.0 * colour[c])) < 1e-5;
    }
    return !coarse;
}

/// Chunk gAMA of a PNG with exponent 1, where glTF takes all pictures of colours as sRGB.
bool says_linear(const std::string& bytes) {
    constexpr std::size_t from = 33; // behind the chunk with the size, which is the first
    const std::size_t at = bytes.starts_with("\x89PNG") ? bytes.substr(0, bytes.find("IDAT")).find("gAMA", from) : std::string::npos;
    return at != std::string::npos && bytes.substr(at + 4, 4) == std::string("\x00\x01\x86\xA0", 4);
}

/// Directions of a surface: about half red and green, all blue.
bool looks_like_normals(const DecodedPicture& picture) {
    std::array<double, 3> mean{};
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        if (i % 4 != 3)
            mean[i % 4] += picture.rgba[i] * 4.0 / static_cast<double>(picture.rgba.size());
    return std::abs(mean[0] - 128.0) < 12.0 && std::abs(mean[1] - 128.0) < 12.0 && mean[2] > 215.0;
}

/// Clear texels take the mean colour of the others: what is cut away shall not colour the edge of what is left.
void fill_clear(DecodedPicture& picture) {
    std::array<std::uint64_t, 3> sum{};
    std::uint64_t count = 0;
    for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
        if (picture.rgba[i + 3] >= 128) {
            ++count;
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += picture.rgba[i + c];
        }
    for (std::size_t i = 0; count > 0 && i + 3 < picture.rgba.size(); i += 4)
        for (std::size_t c = 0; picture.rgba[i + 3] < 128 && c < 3; ++c)
            picture.rgba[i + c] = static_cast<std::uint8_t>(sum[c] / count);
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
    if (const auto specular = entry.extension("KHR_materials_pbrSpecularGlossiness")) {
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
    read_opacity(entry, colour[3], look);
    if (picture)
        material.texture = texture(*picture, look);
    doubt_factor(colour, material);
    if (const auto emissive = entry.find("emissiveFactor"); emissive && !entry.find("emissiveTexture")) {
        const auto strength = entry.extension("KHR_materials_emissive_strength");
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
    for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
        if (entry.find(key))
            add_note(model_.notes, fmt::format("material {}: its {} is left out", name, key));
}

int GltfMaterials::texture(const GltfEntry& info, GltfLook& look) {
    const GltfEntry root = file_.root();
    const GltfEntry texture = root.at("textures", info.require("index").index(root.list_size("textures"), "textures"));
    look.uv_set = info.whole_or("texCoord", 0, 7);
    if (const auto transform = info.extension("KHR_texture_transform")) {
        look.uv_transform = uv_transform(*transform);
        look.uv_set = transform->whole_or("texCoord", look.uv_set, 7);
    }
    if (const auto index = texture.find("sampler")) {
        const GltfEntry sampler = root.at("samplers", index->index(root.list_size("samplers"), "samplers"));
        if (sampler.whole_or("wrapS", 10497, 100'000) != 10497 || sampler.whole_or("wrapT", 10497, 100'000) != 10497)
            add_note(model_.notes, "textures repeat, also those that the file clamps or mirrors at their edges");
    }
    const auto webp = texture.extension("EXT_texture_webp");
    const auto source = webp ? webp->find("source") : texture.find("source");
    if (!source) {
        add_note(model_.notes, fmt::format("{} has no picture in PNG, JPEG or WebP and is left out", texture.way()));
        return -1;
    }
    const std::size_t index = source->index(root.list_size("images"), "images");
    const std::pair key(index, look.cutoff > 0.0);
    auto known = pictures_.find(key);
    if (known == pictures_.end())
        known = pictures_.emplace(key, picture(root.at("images", index), index, look.cutoff > 0.0)).first;
    for (const std::string& doubt : known->second.doubts)
        model_.doubts.push_back({look.material, doubt});
    return known->second.texture;
}

GltfMaterials::Picture GltfMaterials::picture(const GltfEntry& image, std::size_t index, bool cut_out) {
    if (pictures_.size() >= max_pictures)
        image.refuse(fmt::format("more than {} pictures", max_pictures), "fewer");
    const std::string name = printable(image.text_or("name", fmt::format("image {}", index)));
    const auto uri = image.find("uri");
    const std::string bytes = uri ? file_.at_uri(*uri) : std::string(accessors_.view_bytes(image.require("bufferView")));
    const std::size_t most = std::min(max_picture_pixels, max_pixels - decoded_pixels_);
    DecodedPicture decoded =
        bytes.starts_with("RIFF") ? decoded_webp(image, bytes, most) : decode_picture(file_.path, image.way(), bytes, most);
    decoded_pixels_ += static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height);
    Picture made_here{static_cast<int>(model_.textures.size()), {}};
    if (const auto other = data_pictures().find(index); other != data_pictures().end())
        made_here.doubts.push_back(fmt::format("its picture {} is {} elsewhere in the file", name, other->second));
    else if (looks_like_normals(decoded))
        made_here.doubts.push_back(fmt::format("its picture {} looks like directions of a surface", name));
    if (says_linear(bytes))
        made_here.doubts.push_back(fmt::format("its picture {} says it is linear, and glTF takes it as sRGB", name));
    if (cut_out)
        fill_clear(decoded);
    model_.textures.push_back(surface_texture(name, decoded.width, decoded.height, decoded.rgba, max_texture_px));
    const SurfaceTexture& made = model_.textures.back();
    if (made.width != decoded.width || made.height != decoded.height)
        add_note(model_.notes, fmt::format("picture {} of {} x {} texels is taken at {} x {}", name, decoded.width, decoded.height,
                                           made.width, made.height));
    return made_here;
}

DecodedPicture GltfMaterials::decoded_webp(const GltfEntry& image, const std::string& bytes, std::size_t most_pixels) {
    static const auto decode = reinterpret_cast<DecodeWebp*>(module_function("fernlicht-gltf", "fernlicht_decode_webp"));
    WebpPicture picture;
    picture.most_pixels = most_pixels;
    try {
        decode(bytes, picture);
    } catch (const std::invalid_argument& error) {
        image.refuse(printable(error.what()), "a picture in WebP");
    }
    return {picture.width, picture.height, std::move(picture.rgba)};
}

const std::map<std::size_t, const char*>& GltfMaterials::data_pictures() {
    if (!data_pictures_) {
        data_pictures_.emplace();
        const GltfEntry root = file_.root();
        const auto take = [&](const GltfEntry& of, const char* key, const char* what) {
            const Json::json_pointer way(std::string("/") + key + "/index"); // of pictures that are left out nothing is refused
            if (!of.value().contains(way) || !of.value()[way].is_number_unsigned())
                return;
            const auto index = of.value()[way].get<std::size_t>();
            const auto source = index < root.list_size("textures") ? root.at("textures", index).find("source") : std::nullopt;
            if (source && source->value().is_number_unsigned())
                data_pictures_->emplace(source->value().get<std::size_t>(), what);
        };
        for (const GltfEntry& material : root.list("materials")) {
            take(material, "normalTexture", "directions of a surface");
            take(material, "occlusionTexture", "occlusion");
            if (const auto pbr = material.find("pbrMetallicRoughness"))
                take(*pbr, "metallicRoughnessTexture", "metal and roughness");
        }
    }
    return *data_pictures_;
}

void GltfMaterials::doubt_factor(const std::vector<double>& colour, const Material& material) {
    if (material.texture < 0 && in_srgb_steps(colour))
        model_.doubts.push_back(
            {static_cast<std::uint32_t>(model_.materials.size()),
             fmt::format("its factor {:.3f} {:.3f} {:.3f} stands in steps of 1/255, as sRGB does: glTF takes it as linear", colour[0],
                         colour[1], colour[2])});
}

} // namespace fernlicht
