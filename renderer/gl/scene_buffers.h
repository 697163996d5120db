// A scene on the GPU: all meshes in one vertex and one index buffer, drawn with one indirect call for those that are visible.
#pragma once

#include "renderer/gl/objects.h"
#include "scenarios/values/scene.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace fernlicht::gl {

class SceneBuffers {
  public:
    SceneBuffers(Context& context, const Scene& scene);

    /// Sets every mesh's place relative to the car. Once per moment.
    void place(const glm::dvec3& ego_m);
    /// Draws the meshes whose bounding sphere meets the clip volume; `ground_only` leaves out everything that stands on the ground.
    /// Returns how many were drawn. Positions must have been placed.
    int draw(const glm::dmat4& clip_from_ego, bool ground_only, double farthest_m);

    GLuint materials() const { return materials_; }
    bool retroreflecting() const { return retroreflecting_; }
    /// All vertices lie in one horizontal plane, so that nothing can stand in a beam.
    bool flat() const { return flat_; }
    std::size_t triangles() const { return triangles_; }

  private:
    struct Piece {
        glm::dvec3 origin_m, centre_m; ///< centre relative to the origin
        double radius_m = 0.0;
        bool ground = true;
        GLuint first_index = 0, index_count = 0;
        GLint base_vertex = 0;
    };
    struct Command {
        GLuint count, instances, first_index;
        GLint base_vertex;
        GLuint base_instance;
    };

    Context& context_;
    std::vector<Piece> pieces_;
    std::vector<glm::vec4> places_;
    std::vector<Command> commands_;
    Buffer vertices_, indices_, materials_, place_buffer_, command_buffer_;
    VertexArray layout_;
    bool retroreflecting_ = false, flat_ = true;
    std::size_t triangles_ = 0;
};

} // namespace fernlicht::gl
