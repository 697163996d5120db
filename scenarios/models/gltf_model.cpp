#include "scenarios/models/model.h"

#include "scenarios/models/gltf_file.h"
#include "scenarios/models/gltf_materials.h"
#include "scenarios/models/triangle_soup.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace fernlicht {
namespace {

constexpr double sheets_apart_m = 0.0005; ///< of a surface that is lit from both sides
constexpr std::size_t max_nodes = 200'000;

/// Extensions without which such a file can be read, or that are read.
constexpr std::string_view known_extensions[] = {"KHR_texture_transform",
                                                 "KHR_materials_pbrSpecularGlossiness",
                                                 "KHR_mesh_quantization",
                                                 "KHR_lights_punctual",
                                                 "KHR_materials_emissive_strength",
                                                 "KHR_materials_unlit",
                                                 "KHR_materials_transmission",
                                                 "KHR_materials_ior",
                                                 "KHR_materials_clearcoat",
                                                 "KHR_materials_specular",
                                                 "KHR_materials_volume",
                                                 "KHR_materials_sheen"};

class GltfReading {
  public:
    GltfReading(GltfFile& file, Model& model) : file_(file), model_(model), accessors_(file), materials_(file, accessors_, model) {}

    void read() {
        const GltfEntry root = file_.root();
        check_extensions(root);
        accessors_.check_all();
        if (root.list_size("nodes") > max_nodes)
            root.require("nodes").refuse(fmt::format("at most {} nodes", max_nodes));
        std::size_t triangles = 0; // counted before the first is made
        walk_nodes(root, [&](const GltfEntry& node, const glm::dmat4&) {
            for_meshes(node, [&](const GltfEntry& mesh) { triangles += max_triangles(mesh); });
            if (triangles > max_model_triangles)
                node.refuse(fmt::format("with it the model has {} triangles", triangles), fmt::format("at most {}", max_model_triangles));
        });
        walk_nodes(root, [&](const GltfEntry& node, const glm::dmat4& world) { visit(node, world); });
        if (soup_.triangles.empty())
            root.refuse("a file without triangles in its scene", "a model");
        note_what_is_lost(root);
        add_meshes(model_, soup_);
    }

  private:
    struct Corners { ///< of one primitive: vertices, by three
        std::vector<std::uint32_t> indices;
        std::vector<float> positions, normals, uvs;
    };

    void check_extensions(const GltfEntry& root) const {
        for (const GltfEntry& name : root.list("extensionsRequired"))
            if (std::ranges::find(known_extensions, name.text()) == std::end(known_extensions))
                name.refuse(fmt::format("requires the extension {}", printable(name.text())),
                            "a file without it (no compressed meshes or textures)");
    }

    void visit(const GltfEntry& node, const glm::dmat4& world) {
        if (const std::string name = node.text_or("name", ""); name.starts_with("lamp."))
            add_mount(node, name, world);
        if (node.find("skin"))
            add_note(model_.notes, "skins are left out: the model keeps the shape in which it was made");
        for_meshes(node, [&](const GltfEntry& mesh) { add_mesh(mesh, world); });
    }

    template <class Use> void for_meshes(const GltfEntry& node, Use use) const {
        const std::size_t meshes = file_.root().list_size("meshes");
        if (const auto mesh = node.find("mesh"))
            use(file_.root().at("meshes", mesh->index(meshes, "meshes")));
        for (const GltfEntry& mesh : node.list("meshes")) // as glTF 1.0 has them
            use(file_.root().at("meshes", mesh.index(meshes, "meshes")));
    }

    /// What a mesh's accessors declare.
    std::size_t max_triangles(const GltfEntry& mesh) const {
        const std::size_t accessors = file_.root().list_size("accessors");
        std::size_t triangles = 0;
        for (const GltfEntry& primitive : mesh.list("primitives")) {
            const auto attributes = primitive.find("attributes");
            auto corners = primitive.find("indices");
            if (!corners && attributes)
                corners = attributes->find("POSITION");
            if (!corners)
                continue;
            const GltfEntry accessor = file_.root().at("accessors", corners->index(accessors, "accessors"));
            const std::size_t count = accessor.require("count").whole(max_accessor_elements), mode = primitive.whole_or("mode", 4, 6);
            triangles += mode == 4 ? count / 3 : mode > 4 && count > 2 ? count - 2 : 0;
        }
        return triangles;
    }

    void add_mount(const GltfEntry& node, const std::string& name, const glm::dmat4& world) {
        const glm::dvec3 forward = from_gltf_axes(glm::dvec3(world[2])), up = from_gltf_axes(glm::dvec3(world[1]));
        const glm::dvec3 left = glm::cross(up, forward);
        if (!(glm::length(forward) > 0.0) || !(glm::length(left) > 0.0))
            node.refuse("a lamp's node without directions", "axes that are not 0");
        const glm::dvec3 x = glm::normalize(forward), y = glm::normalize(left);
        model_.mounts.push_back({printable(name), {from_gltf_axes(glm::dvec3(world[3])), {x, y, glm::cross(x, y)}}});
    }

    void add_mesh(const GltfEntry& mesh, const glm::dmat4& world) {
        for (const GltfEntry& primitive : mesh.list("primitives"))
            add_primitive(primitive, world);
        if (mesh.list_size("weights") > 0)
            add_note(model_.notes, "shapes to blend with (morph targets) are left out");
    }

    void add_primitive(const GltfEntry& primitive, const glm::dmat4& world) {
        const std::size_t mode = primitive.whole_or("mode", 4, 6);
        if (mode < 4) {
            add_note(model_.notes, "points and lines are left out");
            return;
        }
        const GltfEntry attributes = primitive.require("attributes");
        if (primitive.find("targets"))
            add_note(model_.notes, "shapes to blend with (morph targets) are left out");
        if (attributes.find("COLOR_0"))
            add_note(model_.notes, "colours of vertices are left out");
        const auto position = attributes.find("POSITION");
        if (!position) {
            add_note(model_.notes, fmt::format("{} has no positions and is left out", primitive.way()));
            return;
        }
        Corners corners;
        corners.positions = accessors_.floats(*position, 3);
        const std::size_t count = corners.positions.size() / 3;
        const auto member = [&](const std::string& name, std::size_t width) {
            const auto given = attributes.find(name);
            std::vector<float> values = given ? accessors_.floats(*given, width) : std::vector<float>{};
            if (given && values.size() != count * width)
                given->refuse(fmt::format("{} of {} vertices", values.size() / width, count), "as many as there are positions");
            return values;
        };
        const GltfLook& look = materials_.look(primitive.find("material"));
        corners.normals = member("NORMAL", 3);
        corners.uvs = member(fmt::format("TEXCOORD_{}", look.uv_set), 2);
        if (const auto indices = primitive.find("indices"))
            corners.indices = accessors_.indices(*indices, count);
        else
            for (std::uint32_t i = 0; i < count; ++i)
                corners.indices.push_back(i);
        corners.indices = by_three(std::move(corners.indices), mode);
        const std::size_t fresh = corners.indices.size() / 3 * (look.double_sided ? 2 : 1);
        if (fresh > max_model_triangles - soup_.triangles.size())
            throw InputError({file_.path, 0, 0, primitive.way()}, fmt::format("more than {} triangles", max_model_triangles), "fewer");
        add_triangles(corners, look, world, position->way());
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
            SoupTriangle triangle{{}, look.material};
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
        }
        if (look.double_sided)
            add_note(model_.notes, "surfaces seen from both sides are two sheets, 0.5 mm apart");
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
};

} // namespace

Model read_model(const std::filesystem::path& path) {
    GltfFile file = open_gltf(path);
    Model model;
    model.name = printable(path.stem().string());
    model.notes = file.notes;
    GltfReading(file, model).read();
    std::ranges::sort(model.mounts, {}, &Mount::name);
    model.opened = std::move(file.opened);
    return model;
}

} // namespace fernlicht
