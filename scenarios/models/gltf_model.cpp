#include "scenarios/models/model.h"

#include "scenarios/models/cut_outs.h"
#include "scenarios/models/gltf_codecs.h"
#include "scenarios/models/gltf_file.h"
#include "scenarios/models/gltf_materials.h"
#include "scenarios/models/material_doubts.h"
#include "scenarios/models/triangle_soup.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/program_module.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr double sheets_apart_m = 0.0005; ///< of a surface that is lit from both sides
constexpr std::size_t max_nodes = 200'000, max_places = 1'000'000, max_visited_vertices = 64'000'000;

/// Extensions without which such a file can be read, or that are read.
constexpr std::string_view known_extensions[] = {"KHR_texture_transform",
                                                 "KHR_mesh_quantization",
                                                 "KHR_draco_mesh_compression",
                                                 "EXT_meshopt_compression",
                                                 "EXT_mesh_gpu_instancing",
                                                 "EXT_texture_webp",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_anisotropy",
                                                 "KHR_materials_clearcoat",
                                                 "KHR_materials_dispersion",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_ior",
                                                 "KHR_materials_iridescence",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_materials_sheen",
                                                 "KHR_materials_specular",
                                                 "KHR_materials_transmission",
                                                 "KHR_materials_unlit",
                                                 "KHR_materials_variants",
                                                 "KHR_materials_volume",
                                                 "KHR_xmp_json_ld"};

constexpr const char* compressed_by_draco = "KHR_draco_mesh_compression";
constexpr std::size_t max_draco_id = 65535;

class GltfReading {
  public:
    GltfReading(GltfFile& file, Model& model) : file_(file), model_(model), accessors_(file), materials_(file, accessors_, model) {}

    void read() {
        const GltfEntry root = file_.root();
        check_extensions(root);
        accessors_.check_all();
        if (root.list_size("nodes") > max_nodes)
            root.require("nodes").refuse(fmt::format("at most {} nodes", max_nodes));
        std::size_t triangles = 0, vertices = 0, places = 0; // counted before the first is made
        walk_nodes(root, [&](const GltfEntry& node, const glm::dmat4&) {
            const std::size_t here = place_count(node);
            places += here;
            for_meshes(node, [&](const GltfEntry& mesh) { triangles += here * count_mesh(mesh, vertices); });
            if (triangles > max_model_triangles)
                node.refuse(fmt::format("with it the model has {} triangles", triangles), fmt::format("at most {}", max_model_triangles));
            if (vertices > max_visited_vertices || places > max_places)
                node.refuse(fmt::format("with it {} vertices are read for {} places", vertices, places),
                            fmt::format("at most {} and {}", max_visited_vertices, max_places));
        });
        walk_nodes(root, [&](const GltfEntry& node, const glm::dmat4& world) { visit(node, world); });
        if (soup_.triangles.empty())
            root.refuse("a file without triangles in its scene", "a model");
        note_what_is_lost(root);
        if (cut_outs_.apply(soup_, model_.textures))
            add_note(model_.notes, "what is less opaque in the file than its cut-off, 0.5 where it blends, is cut out; the rest is opaque");
        if (soup_.triangles.empty())
            root.refuse("nothing but transparent triangles", "a model");
        colour_faces(soup_, model_.materials);
        add_meshes(model_, soup_);
    }

  private:
    struct Corners { ///< of one primitive: vertices, by three
        std::vector<std::uint32_t> indices;
        std::vector<float> positions, normals, uvs, colours; ///< colours: four a vertex
    };

    void check_extensions(const GltfEntry& root) const {
        for (const GltfEntry& name : root.list("extensionsRequired"))
            if (std::ranges::find(known_extensions, name.text()) == std::end(known_extensions))
                name.refuse(fmt::format("requires the extension {}", printable(name.text())),
                            "a file without it, with pictures in PNG, JPEG or WebP");
    }

    void visit(const GltfEntry& node, const glm::dmat4& world) {
        if (const std::string name = node.text_or("name", ""); name.starts_with("lamp."))
            add_mount(node, name, world);
        if (node.find("skin"))
            add_note(model_.notes, "skins are left out: the model keeps the shape in which it was made");
        const std::vector<glm::dmat4> places = places_of(node, world);
        for_meshes(node, [&](const GltfEntry& mesh) { add_mesh(mesh, places); });
    }

    template <class Use> void for_meshes(const GltfEntry& node, Use use) const {
        const std::size_t meshes = file_.root().list_size("meshes");
        if (const auto mesh = node.find("mesh"))
            use(file_.root().at("meshes", mesh->index(meshes, "meshes")));
        for (const GltfEntry& mesh : node.list("meshes")) // as glTF 1.0 has them
            use(file_.root().at("meshes", mesh.index(meshes, "meshes")));
    }

    std::size_t count_of(const GltfEntry& accessor) const {
        return accessors_.accessor(accessor).require("count").whole(max_accessor_elements);
    }

    /// Triangles as a mesh's accessors declare them; its vertices are added.
    std::size_t count_mesh(const GltfEntry& mesh, std::size_t& vertices) const {
        std::size_t triangles = 0;
        for (const GltfEntry& primitive : mesh.list("primitives")) {
            const auto attributes = primitive.find("attributes");
            const auto position = attributes ? attributes->find("POSITION") : std::nullopt;
            const auto indices = primitive.find("indices"), corners = indices ? indices : position;
            vertices += position ? count_of(*position) : 0;
            if (!corners)
                continue;
            const std::size_t count = count_of(*corners), mode = primitive.whole_or("mode", 4, 6);
            triangles += mode == 4 ? count / 3 : mode > 4 && count > 2 ? count - 2 : 0;
        }
        return triangles;
    }

    static std::optional<GltfEntry> instances(const GltfEntry& node) {
        const auto instancing = node.extension("EXT_mesh_gpu_instancing");
        return instancing ? std::optional(instancing->require("attributes")) : std::nullopt;
    }

    /// Where a node puts its meshes: once, or at each instance.
    std::size_t place_count(const GltfEntry& node) const {
        const auto given = instances(node);
        std::optional<std::size_t> count;
        for (const char* key : {"TRANSLATION", "ROTATION", "SCALE"})
            if (const auto attribute = given ? given->find(key) : std::nullopt) {
                if (count && *count != count_of(*attribute))
                    attribute->refuse(fmt::format("{} of {} instances", count_of(*attribute), *count), "as many of all");
                count = count_of(*attribute);
            }
        return count.value_or(1);
    }

    std::vector<glm::dmat4> places_of(const GltfEntry& node, const glm::dmat4& world) const {
        const auto given = instances(node);
        std::vector<glm::dmat4> places(place_count(node), world);
        const auto numbers = [&](const char* key, std::size_t width) {
            const auto attribute = given ? given->find(key) : std::nullopt;
            return attribute ? accessors_.floats(*attribute, width) : std::vector<float>{};
        };
        const std::vector<float> moves = numbers("TRANSLATION", 3), turns = numbers("ROTATION", 4), scales = numbers("SCALE", 3);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!moves.empty())
                places[i] = glm::translate(places[i], glm::dvec3(moves[3 * i], moves[3 * i + 1], moves[3 * i + 2]));
            if (!turns.empty()) {
                const glm::dquat turn(turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2]);
                if (!(glm::length(turn) > 1e-6 && glm::length(turn) < 1e6))
                    given->require("ROTATION")
                        .refuse(fmt::format("instance {} has a quaternion without direction", i), "one that is not 0");
                places[i] *= glm::mat4_cast(glm::normalize(turn));
            }
            if (!scales.empty())
                places[i] = glm::scale(places[i], glm::dvec3(scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]));
        }
        return places;
    }

    void add_mount(const GltfEntry& node, const std::string& name, const glm::dmat4& world) {
        const glm::dvec3 forward = from_gltf_axes(glm::dvec3(world[2])), up = from_gltf_axes(glm::dvec3(world[1]));
        const glm::dvec3 left = glm::cross(up, forward);
        if (!(glm::length(forward) > 0.0) || !(glm::length(left) > 0.0))
            node.refuse("a lamp's node without directions", "axes that are not 0");
        const glm::dvec3 x = glm::normalize(forward), y = glm::normalize(left);
        model_.mounts.push_back({printable(name), {from_gltf_axes(glm::dvec3(world[3])), {x, y, glm::cross(x, y)}}});
    }

    void add_mesh(const GltfEntry& mesh, const std::vector<glm::dmat4>& places) {
        for (const GltfEntry& primitive : mesh.list("primitives"))
            add_primitive(primitive, places);
        if (mesh.list_size("weights") > 0)
            add_note(model_.notes, "shapes to blend with (morph targets) are left out");
    }

    void add_primitive(const GltfEntry& primitive, const std::vector<glm::dmat4>& places) {
        const std::size_t mode = primitive.whole_or("mode", 4, 6);
        if (mode < 4) {
            add_note(model_.notes, "points and lines are left out");
            return;
        }
        const GltfEntry attributes = primitive.require("attributes");
        if (primitive.find("targets"))
            add_note(model_.notes, "shapes to blend with (morph targets) are left out");
        const auto position = attributes.find("POSITION");
        if (!position) {
            add_note(model_.notes, fmt::format("{} has no positions and is left out", primitive.way()));
            return;
        }
        const GltfLook& look = materials_.look(primitive.find("material"));
        const Corners corners = corners_of(primitive, attributes, look, mode);
        const std::size_t fresh = corners.indices.size() / 3 * (look.double_sided ? 2 : 1);
        if (fresh * places.size() > max_model_triangles - soup_.triangles.size())
            throw InputError({file_.path, 0, 0, primitive.way()}, fmt::format("more than {} triangles", max_model_triangles), "fewer");
        for (const glm::dmat4& place : places)
            add_triangles(corners, look, place, position->way());
    }

    Corners corners_of(const GltfEntry& primitive, const GltfEntry& attributes, const GltfLook& look, std::size_t mode) const {
        const auto compressed = primitive.extension(compressed_by_draco);
        const DracoMesh decoded = compressed ? decode(*compressed, primitive, attributes, look) : DracoMesh{};
        const std::size_t count = compressed ? decoded.vertices : count_of(attributes.require("POSITION"));
        const auto member = [&](const std::string& name) {
            const auto given = attributes.find(name);
            if (!given)
                return std::vector<float>{};
            const std::size_t width = width_of(name, *given);
            const auto id = compressed ? compressed->require("attributes").find(name) : std::nullopt;
            if (id)
                return std::ranges::find(decoded.attributes, id->whole(max_draco_id), &DracoMesh::Attribute::id)->values;
            std::vector<float> values = accessors_.floats(*given, width);
            if (values.size() != count * width)
                given->refuse(fmt::format("{} of {} vertices", values.size() / width, count), "as many as there are positions");
            return values;
        };
        Corners corners;
        corners.positions = member("POSITION");
        corners.normals = member("NORMAL");
        corners.uvs = member(fmt::format("TEXCOORD_{}", look.uv_set));
        corners.colours = member("COLOR_0");
        if (!corners.colours.empty() && corners.colours.size() == 3 * count) { // opaque
            std::vector<float> four(4 * count, 1.0F);
            for (std::size_t i = 0; i < 3 * count; ++i)
                four[i / 3 * 4 + i % 3] = corners.colours[i];
            corners.colours = std::move(four);
        }
        if (compressed) {
            corners.indices = decoded.indices;
            return corners;
        }
        if (const auto indices = primitive.find("indices"))
            corners.indices = accessors_.indices(*indices, count);
        else
            for (std::uint32_t i = 0; i < count; ++i)
                corners.indices.push_back(i);
        corners.indices = by_three(std::move(corners.indices), mode);
        return corners;
    }

    /// How many numbers a vertex an attribute has to have.
    std::size_t width_of(const std::string& name, const GltfEntry& accessor) const {
        if (name == "COLOR_0")
            return accessors_.width(accessor) == 4 ? 4 : 3;
        return name.starts_with("TEXCOORD") ? 2 : 3;
    }

    /// What KHR_draco_mesh_compression has in place of the accessors' bytes.
    DracoMesh decode(const GltfEntry& compressed, const GltfEntry& primitive, const GltfEntry& attributes, const GltfLook& look) const {
        DracoMesh mesh;
        const GltfEntry ids = compressed.require("attributes");
        mesh.most_vertices = count_of(attributes.require("POSITION"));
        const auto indices = primitive.find("indices");
        mesh.most_triangles = (indices ? count_of(*indices) : mesh.most_vertices) / 3;
        for (const std::string& name :
             {std::string("POSITION"), std::string("NORMAL"), fmt::format("TEXCOORD_{}", look.uv_set), std::string("COLOR_0")})
            if (const auto given = attributes.find(name), id = ids.find(name); given && id)
                mesh.attributes.push_back({static_cast<std::uint32_t>(id->whole(max_draco_id)),
                                           width_of(name, *given),
                                           accessors_.accessor(*given).flag_or("normalized", false),
                                           {}});
        static const auto decode_draco = reinterpret_cast<DecodeDraco*>(module_function("fernlicht-gltf", "fernlicht_decode_draco"));
        try {
            decode_draco(accessors_.view_bytes(compressed.require("bufferView")), mesh);
        } catch (const std::invalid_argument& error) {
            compressed.refuse(printable(error.what()), "a mesh compressed by Draco");
        }
        for (const DracoMesh::Attribute& attribute : mesh.attributes)
            if (!std::ranges::all_of(attribute.values, [](float value) { return std::isfinite(value); }))
                compressed.refuse("a number that is not finite", "finite numbers");
        return mesh;
    }

    /// Strips (5) and fans (6) as single triangles (4).
    static std::vector<std::uint32_t> by_three(std::vector<std::uint32_t> indices, std::size_t mode) {
        if (mode == 4) {
            indices.resize(indices.size() / 3 * 3);
            return indices;
        }
        std::vector<std::uint32_t> all;
        for (std::size_t i = 2; i < indices.size(); ++i) {
            const bool turned = mode == 5 && i % 2 == 1;
            const std::uint32_t first = mode == 5 ? indices[i - 2] : indices[0], second = indices[i - 1];
            all.insert(all.end(), {turned ? second : first, turned ? first : second, indices[i]});
        }
        return all;
    }

    void add_triangles(const Corners& c, const GltfLook& look, const glm::dmat4& world, const std::string& way) {
        const glm::dmat3 linear(world);
        const double determinant = glm::determinant(linear);
        const glm::dmat3 for_normals = determinant != 0.0 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
        const auto place = [&](std::uint32_t i) {
            const glm::dvec3 p(c.positions[3 * i], c.positions[3 * i + 1], c.positions[3 * i + 2]);
            return from_gltf_axes(glm::dvec3(world * glm::dvec4(p, 1.0)));
        };
        std::vector<std::uint32_t> known(c.positions.size() / 3, ~std::uint32_t{0}); // vertices with normals of the file
        for (std::size_t k = 0; k + 2 < c.indices.size(); k += 3) {
            std::array<std::uint32_t, 3> corner{c.indices[k], c.indices[k + 1], c.indices[k + 2]};
            if (determinant < 0.0)
                std::swap(corner[1], corner[2]);
            const std::array<glm::dvec3, 3> at{place(corner[0]), place(corner[1]), place(corner[2])};
            for (const glm::dvec3& p : at)
                if (!(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= farthest_model_m))
                    throw InputError({file_.path, 0, 0, way}, fmt::format("a vertex at {:.3g}, {:.3g}, {:.3g} m", p.x, p.y, p.z),
                                     fmt::format("coordinates within {:.0f} m", farthest_model_m));
            const glm::dvec3 flat = glm::cross(at[1] - at[0], at[2] - at[0]);
            if (!(glm::length(flat) > 0.0))
                continue;
            const glm::vec4 colour = mean_colour(c, corner);
            SoupTriangle triangle{{}, look.material, glm::vec3(colour)};
            for (std::size_t i = 0; i < 3; ++i) {
                std::uint32_t& vertex = known[corner[i]];
                if (vertex == ~std::uint32_t{0} || c.normals.empty()) {
                    vertex = static_cast<std::uint32_t>(soup_.vertices.size());
                    soup_.vertices.push_back({at[i], normal(c, corner[i], for_normals, flat), uv(c, corner[i], look)});
                }
                triangle.corners[i] = vertex;
            }
            soup_.triangles.push_back(triangle);
            if (look.double_sided)
                add_back(triangle);
            const double opacity = look.opacity * static_cast<double>(colour.a), level = 256.0 * look.cutoff / std::max(opacity, 1e-3);
            for (std::size_t sheets = look.double_sided ? 2 : 1; look.cutoff > 0.0 && sheets > 0; --sheets)
                cut_outs_.add({soup_.triangles.size() - sheets, model_.materials[look.material].texture,
                               static_cast<int>(std::lround(std::min(level, 257.0)))});
        }
        if (look.double_sided)
            add_note(model_.notes, "surfaces seen from both sides are two sheets, 0.5 mm apart");
    }

    /// Of a triangle, from its corners; white where vertices have none.
    static glm::vec4 mean_colour(const Corners& c, const std::array<std::uint32_t, 3>& corners) {
        if (c.colours.empty())
            return glm::vec4(1.0F);
        glm::vec4 sum(0.0F);
        for (const std::uint32_t i : corners)
            sum += glm::vec4(c.colours[4 * i], c.colours[4 * i + 1], c.colours[4 * i + 2], c.colours[4 * i + 3]);
        return glm::clamp(sum / 3.0F, 0.0F, 1.0F);
    }

    static glm::dvec3 normal(const Corners& c, std::uint32_t i, const glm::dmat3& for_normals, const glm::dvec3& flat) {
        if (!c.normals.empty()) {
            const glm::dvec3 n = for_normals * glm::dvec3(c.normals[3 * i], c.normals[3 * i + 1], c.normals[3 * i + 2]);
            if (const double length = glm::length(n); length > 1e-12 && length < 1e12)
                return from_gltf_axes(n / length);
        }
        return glm::normalize(flat);
    }

    static glm::vec2 uv(const Corners& c, std::uint32_t i, const GltfLook& look) {
        if (c.uvs.empty())
            return glm::vec2(0.0F);
        const double u = c.uvs[2 * i], v = c.uvs[2 * i + 1];
        const auto& t = look.uv_transform;
        return {t[0] * u + t[1] * v + t[2], t[3] * u + t[4] * v + t[5]};
    }

    void add_back(const SoupTriangle& front) {
        SoupTriangle back = front;
        std::swap(back.corners[1], back.corners[2]);
        for (std::uint32_t& corner : back.corners) {
            SoupVertex vertex = soup_.vertices[corner];
            vertex.position_m -= sheets_apart_m * vertex.normal;
            vertex.normal = -vertex.normal;
            corner = static_cast<std::uint32_t>(soup_.vertices.size());
            soup_.vertices.push_back(vertex);
        }
        soup_.triangles.push_back(back);
    }

    void note_what_is_lost(const GltfEntry& root) {
        for (const auto& [key, what] : {std::pair("animations", "animations"), std::pair("cameras", "cameras")})
            if (const std::size_t count = root.list_size(key); count > 0)
                add_note(model_.notes, fmt::format("{} left out: {}", what, count));
        if (const auto all = root.find("extensions"); all && all->find("KHR_lights_punctual"))
            add_note(model_.notes, "lights of the file are left out: lamps come from lamp files, at nodes named lamp...");
    }

    GltfFile& file_;
    Model& model_;
    GltfAccessors accessors_;
    GltfMaterials materials_;
    TriangleSoup soup_;
    CutOuts cut_outs_;
};

} // namespace

Model read_model(const std::filesystem::path& path) {
    GltfFile file = open_gltf(path);
    Model model;
    model.name = printable(path.stem().string());
    model.notes = file.notes;
    GltfReading(file, model).read();
    std::ranges::sort(model.mounts, {}, &Mount::name);
    add_doubts(model);
    model.opened = std::move(file.opened);
    return model;
}

} // namespace fernlicht
