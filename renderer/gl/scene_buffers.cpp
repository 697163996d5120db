#include "renderer/gl/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <unordered_map>

namespace fernlicht::gl {
namespace {

constexpr double flat_within_m = 1e-3;

struct GpuVertex {
    glm::vec3 position_m, normal;
    std::uint32_t material;
};

struct GpuMaterial { // std430, as in photometric.frag.glsl
    glm::vec4 albedo, emission, retro;
};

GpuMaterial packed(const Material& m) {
    return {{m.albedo, m.retro_rl}, {m.emission_cdm2, 0.0F}, {m.retro_reference_rad, m.retro_falloff_rad, 0.0F, 0.0F}};
}

/// Row i of a matrix that GLM stores by columns.
glm::dvec4 row(const glm::dmat4& m, int i) { return {m[0][i], m[1][i], m[2][i], m[3][i]}; }

/// Signed distance test of a sphere against the plane dot(plane, (x, y, z, 1)) >= 0.
bool outside(const glm::dvec4& plane, const glm::dvec3& centre, double radius) {
    const glm::dvec3 normal(plane);
    return glm::dot(normal, centre) + plane.w < -radius * glm::length(normal);
}

} // namespace

SceneBuffers::SceneBuffers(Context& context, const Scene& scene) : context_(context) {
    std::vector<GpuVertex> vertices;
    std::vector<GLuint> indices;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (const Mesh& mesh : scene.meshes) {
        Piece piece;
        piece.origin_m = mesh.origin_m;
        piece.first_index = static_cast<GLuint>(indices.size());
        piece.base_vertex = static_cast<GLint>(vertices.size());
        glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
        for (const Batch& batch : mesh.batches) {
            // Each batch gets vertices of its own, so that the material can travel with them.
            std::unordered_map<std::uint32_t, GLuint> copied;
            const Material& material = scene.materials.at(batch.material);
            piece.ground = piece.ground && is_ground(material.kind);
            retroreflecting_ = retroreflecting_ || material.retro_rl > 0.0F;
            for (std::uint32_t k = batch.first; k < batch.first + batch.count; ++k) {
                const std::uint32_t index = mesh.indices.at(k);
                const auto [it, fresh] =
                    copied.try_emplace(index, static_cast<GLuint>(vertices.size() - static_cast<std::size_t>(piece.base_vertex)));
                if (fresh) {
                    const Vertex& vertex = mesh.vertices.at(index);
                    vertices.push_back({vertex.position_m, vertex.normal, batch.material});
                    low = glm::min(low, glm::dvec3(vertex.position_m));
                    high = glm::max(high, glm::dvec3(vertex.position_m));
                }
                indices.push_back(it->second);
            }
        }
        piece.index_count = static_cast<GLuint>(indices.size()) - piece.first_index;
        if (piece.index_count == 0)
            continue;
        piece.centre_m = 0.5 * (low + high);
        piece.radius_m = 0.5 * glm::length(high - low);
        lowest = std::min(lowest, mesh.origin_m.z + low.z);
        highest = std::max(highest, mesh.origin_m.z + high.z);
        pieces_.push_back(piece);
        // The id that a pixel shows is the mesh's place in the scene + 1, exact in a float up to 16 million meshes.
        places_.emplace_back(0.0F, 0.0F, 0.0F, static_cast<float>(&mesh - scene.meshes.data() + 1));
    }
    flat_ = pieces_.empty() || highest - lowest < flat_within_m;
    triangles_ = indices.size() / 3;
    std::vector<GpuMaterial> materials;
    for (const Material& material : scene.materials)
        materials.push_back(packed(material));

    vertices_ = make_buffer(context, vertices);
    indices_ = make_buffer(context, indices);
    materials_ = make_buffer(context, materials);
    place_buffer_ = make_buffer(context, places_, GL_DYNAMIC_STORAGE_BIT);
    command_buffer_ = make_buffer(context, std::vector<Command>(pieces_.size()), GL_DYNAMIC_STORAGE_BIT);
    layout_ = make_vertex_array(context);
    const GladGLContext& gl = context.gl;
    gl.VertexArrayVertexBuffer(layout_, 0, vertices_, 0, sizeof(GpuVertex));
    gl.VertexArrayVertexBuffer(layout_, 1, place_buffer_, 0, sizeof(glm::vec4));
    gl.VertexArrayElementBuffer(layout_, indices_);
    gl.VertexArrayBindingDivisor(layout_, 1, 1);
    const auto attribute = [&](GLuint location, GLint size, GLuint offset, GLuint binding) {
        gl.EnableVertexArrayAttrib(layout_, location);
        gl.VertexArrayAttribFormat(layout_, location, size, GL_FLOAT, GL_FALSE, offset);
        gl.VertexArrayAttribBinding(layout_, location, binding);
    };
    attribute(0, 3, offsetof(GpuVertex, position_m), 0);
    attribute(1, 3, offsetof(GpuVertex, normal), 0);
    attribute(3, 4, 0, 1);
    gl.EnableVertexArrayAttrib(layout_, 2);
    gl.VertexArrayAttribIFormat(layout_, 2, 1, GL_UNSIGNED_INT, offsetof(GpuVertex, material));
    gl.VertexArrayAttribBinding(layout_, 2, 0);
    context.check("uploading the scene");
}

void SceneBuffers::place(const glm::dvec3& ego_m) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const glm::vec3 offset(pieces_[i].origin_m - ego_m);
        places_[i] = {offset, places_[i].w};
    }
    update_buffer(context_, place_buffer_, places_);
}

int SceneBuffers::draw(const glm::dmat4& clip_from_ego, bool ground_only, double farthest_m) {
    const glm::dvec4 x = row(clip_from_ego, 0), y = row(clip_from_ego, 1), w = row(clip_from_ego, 3);
    commands_.clear();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const Piece& piece = pieces_[i];
        const glm::dvec3 centre = glm::dvec3(places_[i]) + piece.centre_m;
        if ((ground_only && !piece.ground) || glm::length(centre) - piece.radius_m > farthest_m || outside(w + x, centre, piece.radius_m) ||
            outside(w - x, centre, piece.radius_m) || outside(w + y, centre, piece.radius_m) || outside(w - y, centre, piece.radius_m))
            continue;
        commands_.push_back({piece.index_count, 1, piece.first_index, piece.base_vertex, static_cast<GLuint>(i)});
    }
    if (commands_.empty())
        return 0;
    update_buffer(context_, command_buffer_, commands_);
    context_.gl.BindVertexArray(layout_);
    context_.gl.BindBuffer(GL_DRAW_INDIRECT_BUFFER, command_buffer_);
    context_.gl.MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(commands_.size()), 0);
    return static_cast<int>(commands_.size());
}

} // namespace fernlicht::gl
