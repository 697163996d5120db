// Lamps as sources that are seen: their luminous faces in the picture, at any distance.
//
// A face is a rectangle parallel to the picture's plane that has the solid angle of the lamp's face seen from the eye, and the luminance
// I / A of its area seen. A pixel gets the share that the face covers: the integral of luminance over solid angle is I / d^2 to the float,
// from faces of many pixels to those far below one. Where a body stands before it the face is hidden as a whole.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/lighting.h"

#include <map>

namespace fernlicht::gl {

class LampFaces {
  public:
    LampFaces(Context& context, const ToneMapper& tone) : context_(context), tone_(tone) {}

    /// After the scene, into its targets. Nothing for maps and without lamps that shine towards the eye.
    void draw(const Shot& shot);
    void compile(const Shot& shot);

  private:
    struct Face {
        glm::vec4 place_px, light;
    };
    std::vector<Face> seen(const Shot& shot) const;
    const Program& program(const FrameOutputs& outputs);
    void draw_faces(const Shot& shot, const std::vector<Face>& faces);

    Context& context_;
    ToneMapper tone_;
    std::map<int, Program> programs_;
    GrowingBuffer buffer_;
    VertexArray layout_;
};

} // namespace fernlicht::gl
