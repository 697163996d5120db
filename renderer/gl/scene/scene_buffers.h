// A scene on the GPU: all vertices in one buffer, all triangles in another, cut into pieces that are culled, sorted and lit as a whole.
// Bounds of a piece of a scene, for deciding what can shade what.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/light_pass/light_pass.h"
#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <optional>

namespace fernlicht::gl {

/// What shading a surface takes: pieces of one class can share a shader variant.
struct SurfaceClass {
    int texture = 0; ///< 0: none, else 1 + TextureMode
    bool retroreflecting = false, emissive = false;
    bool moving = false;                ///< turned and placed by its body
    bool tinted = false;                ///< retroreflected light has a colour of its own
    bool glossy = false, beads = false; ///< mirrors while dry; retroreflects while wet

    auto operator<=>(const SurfaceClass&) const = default;
};

/// Corners of a box, relative to the mesh's origin.
using Corners = std::array<glm::dvec3, 8>;

/// Triangles of one mesh and one surface class.
struct Piece {
    glm::dvec3 origin_m{0.0}, centre_m{0.0}; ///< centre of the bounding sphere, relative to the origin
    double radius_m = 0.0;
    double lowest_m = 0.0, highest_m = 0.0; ///< z in the world
    bool ground = true;                     ///< of a mesh of which nothing stands on the ground
    bool casts = true;                      ///< of its mesh
    bool closed = false;                    ///< of its mesh
    bool measured_alone = false;            ///< of its mesh
    bool above_ground = false;              ///< ground that has other ground below it, as a bridge has
    SurfaceClass surface;
    std::uint32_t mesh = 0; ///< index in the scene
    GLuint first_index = 0, index_count = 0;
    GLint base_vertex = 0;
    GLuint vertex_count = 0;
    std::size_t first_plane = 0, planes = 0; ///< ground only: of its triangles, in SceneBuffers::planes()
    Corners corners_m;                       ///< of a box round it that lies along its longest extent; relative to the origin
    int body = -1;                           ///< of its mesh
    glm::vec4 turn{0.0F, 0.0F, 0.0F, 1.0F};  ///< quaternion of its body
    double min_up = 1.0;                     ///< ground only: the least z of its normals
    std::vector<Corners> bodies_m;           ///< what stands on the ground: a box round each body; else the one round all

    bool is_shown(bool in_map) const { return in_map ? ground : !measured_alone; }
};

inline glm::dquat turn_of(const Piece& piece) {
    return {static_cast<double>(piece.turn.w), static_cast<double>(piece.turn.x), static_cast<double>(piece.turn.y),
            static_cast<double>(piece.turn.z)};
}

/// Of the ground, relative to its piece's origin.
struct GroundTriangle {
    glm::vec3 corners_m[3];
    /// For the normal at each corner n, and the least that the interpolated normals' length can be as a divisor: n / length, and the least
    /// n . place / length over the triangle. With a lamp at L, n . (L - place) / length <= (n / length) . L - that.
    glm::vec4 normals[3];
};

/// What goes with a piece that moves or that lamps of others light: the instance's attributes 5 and 6.
struct PieceExtra {
    glm::vec4 turn{0.0F, 0.0F, 0.0F, 1.0F};
    std::uint32_t traffic[4] = {0, 0, 0, 0}; ///< entries by fragment: first, count; by vertex: first, count (traffic_lights.h)
};

/// Pieces farther than this from the car are not drawn.
inline constexpr double farthest_drawn_m = 2000.0;

class SceneBuffers {
  public:
    /// `encoded`: colours and textures are put through the sRGB curve, for techniques that light pictures instead of reflectances.
    /// `lit_by_cpu`: surfaces() are kept, and each triangle gets a last corner of its own, by which pixels name it.
    SceneBuffers(Context& context, const Scene& scene, bool encoded, bool lit_by_cpu = false);

    const std::vector<Piece>& pieces() const { return pieces_; }
    /// Puts the pieces of bodies where the moment has them; what is not visible or not there is left out of near().
    void place(const std::vector<Body>& bodies);
    bool moves() const { return !resting_.empty(); }
    /// Changes with every place() that moved something.
    std::uint64_t placed() const { return placed_; }
    /// Indices of all pieces that may lie within farthest_drawn_m of the car, ascending: what a frame looks through, however long the road.
    const std::vector<std::uint32_t>& near(const glm::dvec3& ego_m) const;
    /// (unit normal, -normal . vertex) of ground triangles, relative to their piece's origin.
    const std::vector<glm::vec4>& planes() const { return planes_; }
    /// The same triangles.
    const std::vector<GroundTriangle>& ground() const { return ground_; }
    /// The piece's triangles, three places each, relative to its origin and not yet turned; read back from the GPU, so not for every frame.
    std::vector<glm::vec3> corners_of(const Piece& piece) const;
    /// Each class of the scene once.
    const std::vector<SurfaceClass>& classes() const { return classes_; }
    /// Binds vertices, materials (storage block 1) and textures (unit 15), with the places of the pieces to be drawn and, where it is not
    /// 0, what else goes with them (DrawList::Extra).
    void bind(GLuint places, GLuint extras = 0) const;
    bool has(bool (*property)(const SurfaceClass&)) const;
    const DrawnSurfaces& surfaces() const { return surfaces_; }

    /// All vertices lie in one horizontal plane, so that nothing can stand in a beam.
    bool flat() const { return flat_; }
    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    void find_bridges();
    using Cell = std::pair<std::int64_t, std::int64_t>;

    Context& context_;
    std::vector<Piece> pieces_;
    std::vector<std::pair<std::uint32_t, Piece>> resting_; ///< those of bodies, in their frames
    std::vector<Body> bodies_;                             ///< as placed last
    std::uint64_t placed_ = 0;
    std::vector<glm::vec4> planes_;
    std::vector<GroundTriangle> ground_;
    std::vector<SurfaceClass> classes_;
    DrawnSurfaces surfaces_;
    std::map<Cell, std::vector<std::uint32_t>> cells_; ///< pieces by where their centre is
    double largest_radius_m_ = 0.0;
    mutable std::optional<Cell> near_cell_;
    mutable std::vector<std::uint32_t> near_;
    Buffer vertices_, indices_, materials_;
    VertexArray layout_;
    Texture textures_;
    bool flat_ = true;
    std::size_t texture_bytes_ = 0;
};

/// Corners of an upright box round triangles (three places each) that lies along the world's axes or along their longest edge. Bit 0 of a
/// corner's place in the array says which end along the box, bit 1 which side, bit 2 bottom or top.
Corners box_round(const std::vector<glm::dvec3>& triangles);

/// A box round each body: triangles that share a place belong to one. `triangles` holds three places each.
std::vector<Corners> boxes_round_bodies(const std::vector<glm::dvec3>& triangles);

/// Of the pictures of surfaces: one array texture with mipmaps.
inline constexpr GLuint surface_texture_unit = 15;

/// One layer a texture, in the order given, repeating, looked up by the context's surface_filter. `encoded`: texels go through the sRGB
/// curve. Nothing for no textures. Throws InputError when sizes differ or are no powers of two; `bytes` gets the memory taken.
Texture upload_surface_textures(Context& context, const std::vector<SurfaceTexture>& textures, bool encoded, std::size_t& bytes);

} // namespace fernlicht::gl
