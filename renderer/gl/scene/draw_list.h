// What is drawn in one pass: visible pieces, grouped by the variant that draws them, near ones first.
#pragma once

#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/scene_buffers.h"
#include "renderer/renderer.h"

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
    /// `extras`: what moves is among them, or lists of lamps go with them. `numbered`: drawn by visible.vert.glsl, as drawn_pieces() says.
    void start(const glm::dvec3& ego_m, bool extras = false, bool numbered = false);
    /// Appends one call that draws these pieces (indices in SceneBuffers::pieces()); returns its number.
    /// `traffic`: lists by piece of the scene.
    int add(std::span<const std::uint32_t> pieces, const std::vector<PieceExtra>* traffic = nullptr);
    /// Appends a call that draws the scene's first triangle into targets that nobody reads: it makes the driver compile what it compiles
    /// late. The scene must have one.
    int add_nothing();
    void upload();
    /// With `clip`: back faces of closed pieces are culled, but not in parallel projections. Returns the number of draw calls.
    int draw(int call, const glm::dmat4* clip = nullptr) const;
    /// Such a call by itself.
    void draw_nothing(const glm::dvec3& ego_m, bool extras);

    std::uint64_t triangles() const { return triangles_; }
    /// Of a numbered list, in its order; whether lamps and shadows reach them is not said.
    std::vector<DrawnPiece>& drawn_pieces() { return drawn_pieces_; }

  private:
    struct Command {
        GLuint count, instances, first_index;
        GLint base_vertex;
        GLuint base_instance;
    };
    struct Call {
        std::size_t first = 0, count = 0;
    };
    void draw_commands(std::size_t first, std::size_t end) const;
    Context& context_;
    const SceneBuffers& scene_;
    glm::dvec3 ego_m_{0.0};
    std::vector<glm::vec4> places_;
    std::vector<Command> commands_;
    std::vector<bool> closed_; ///< by command
    std::vector<PieceExtra> extras_;
    bool with_extras_ = false, numbered_ = false;
    std::vector<DrawnPiece> drawn_pieces_;
    std::vector<Call> calls_;
    Buffer place_buffer_, command_buffer_, extra_buffer_;
    std::uint64_t triangles_ = 0;
};

/// Draws depth alone, by depth.vert.glsl.
Program depth_program(Context& context, bool moving);

/// Shadow maps: depth alone, whose outermost texels stay empty, so that what lies outside is lit. Row 0 is the lowest, as look-ups take it.
class DepthPass {
  public:
    /// `moving`: bodies are turned.
    DepthPass(Context& context, const SceneBuffers& scene, bool moving);

    /// For maps of this size; the clip volume ends so many texels inside them.
    void begin(int width, int height, int beside = 1);
    void set_pieces(const glm::dvec3& ego_m, std::span<const std::uint32_t> pieces);
    /// These pieces alone, into a map or one layer of several. Ground is drawn so much lower, over the distance along the light's axis.
    void draw(GLuint map, const glm::dmat4& clip, Work& work, GLint layer = -1, double ground_lowered = 0.0);
    void end(const char* doing);
    /// Makes the driver compile what draw() needs.
    void compile(int width, int height);

  private:
    Context& context_;
    bool moving_;
    Program program_;
    DrawList list_;
    Framebuffer target_;
    int width_ = 0, height_ = 0, pieces_ = 0;
};

/// Where a piece's bounding sphere stands relative to the car.
inline glm::dvec3 centre_of(const Piece& piece, const glm::dvec3& ego_m) { return piece.origin_m - ego_m + piece.centre_m; }

} // namespace fernlicht::gl
