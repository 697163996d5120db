// What is drawn in one pass: visible pieces, grouped by the variant that draws them, near ones first.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/scene_buffers.h"

#include <span>

namespace fernlicht::gl {

/// The four sides of a clip volume (the far plane lies at infinity, the near one culls next to nothing); unit normals point inside.
struct Frustum {
    glm::dvec4 planes[4];
    explicit Frustum(const glm::dmat4& clip_from_ego);
    bool outside(const glm::dvec3& centre_m, double radius_m) const;
};

class DrawList {
  public:
    DrawList(Context& context, const SceneBuffers& scene);

    /// Empties the list; positions from now on are relative to the car at `ego_m`.
    /// `extras`: what moves is among them, or lists of lamps go with them.
    void start(const glm::dvec3& ego_m, bool extras = false);
    /// Appends one call that draws these pieces (indices in SceneBuffers::pieces()); returns its number.
    /// `traffic`: lists by piece of the scene.
    int add(std::span<const std::uint32_t> pieces, const std::vector<PieceExtra>* traffic = nullptr);
    /// Appends a call that draws the scene's first triangle into targets that nobody reads: it makes the driver compile what it compiles
    /// late. The scene must have one.
    int add_nothing();
    void upload();
    void draw(int call) const;
    /// Makes the driver compile a program that draws depth alone, without drawing any: into a texture of this size that is thrown away.
    void compile_depth_pass(const Program& program, const Framebuffer& target, int width, int height);

    std::uint64_t triangles() const { return triangles_; }
    int calls() const { return static_cast<int>(calls_.size()); }

  private:
    struct Command {
        GLuint count, instances, first_index;
        GLint base_vertex;
        GLuint base_instance;
    };
    struct Call {
        std::size_t first = 0, count = 0;
    };
    Context& context_;
    const SceneBuffers& scene_;
    glm::dvec3 ego_m_{0.0};
    std::vector<glm::vec4> places_;
    std::vector<Command> commands_;
    std::vector<PieceExtra> extras_;
    bool with_extras_ = false;
    std::vector<Call> calls_;
    Buffer place_buffer_, command_buffer_, extra_buffer_;
    std::uint64_t triangles_ = 0;
};

/// Where a piece's bounding sphere stands relative to the car.
inline glm::dvec3 centre_of(const Piece& piece, const glm::dvec3& ego_m) { return piece.origin_m - ego_m + piece.centre_m; }

} // namespace fernlicht::gl
