// Other lamps in fog: how much of their light the air between eye and scene sends to the eye.
//
// By single scattering as of the own lamps (photometric.frag.glsl), for any number of lamps. With l the least luminance
// (min_airlight_cdm2) what a lamp adds along a ray is ramped from nothing at l to all at 2 l, so that it is off by at most 2 l. A bound
// says where it stays below l, and there nothing is integrated: for a ray that passes a lamp at the distance D, by the angle it spans at
// the lamp,
//   L <= s I p(turned least) angle / D * exp(-e * distance between eye and lamp),
// I the most of the beam, s and e scattering and extinction. For the whole picture D is how near any of its rays passes (1 mm
// for a lamp in view), and lamps that stay below l there are not taken along at all; each fragment then asks by its own D. Without fog
// nothing of this is there.
// Lamps as sources that are seen: their luminous faces in the picture, at any distance.
//
// A face is a rectangle parallel to the picture's plane that has the solid angle of the lamp's face seen from the eye, and the luminance
// I / A of its area seen. A pixel gets the share that the face covers: the integral of luminance over solid angle is I / d^2 to the float,
// from faces of many pixels to those far below one. Where a body stands before it the face is hidden as a whole.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "renderer/gl/scene/beams.h"
#include "renderer/gl/scene/lighting.h"
#include "renderer/renderer.h"
#include "scenarios/drives/play/camera.h"

#include <map>

namespace fernlicht::gl {

class LampsInFog {
  public:
    LampsInFog(Context& context, Beams& beams, bool pruned) : context_(context), beams_(beams), pruned_(pruned) {}

    /// Packs the lamps of the moment that the eye may see in the air. None without fog.
    void set(const Moment& moment, const Camera& camera);
    int count() const { return static_cast<int>(packed_.size()); }
    std::size_t left_out() const { return left_out_; }
    float min_cdm2() const { return min_cdm2_; }
    void bind() const; ///< nothing before the first fog

  private:
    struct Packed { // std430, as in lamps_in_fog.glsl
        glm::vec4 position_m, right, up, forward, colour, grid, beam;
    };
    int beam_offset(const Beam& beam);

    Context& context_;
    Beams& beams_;
    bool pruned_;
    std::vector<Packed> packed_;
    std::vector<float> cd_;
    std::map<int, int> offsets_;
    GrowingBuffer lamp_buffer_, cd_buffer_;
    std::size_t left_out_ = 0;
    float min_cdm2_ = 0.0F;
};

class LampFaces {
  public:
    LampFaces(Context& context, const ToneMapper& tone, const std::optional<glm::dmat3>& white)
        : context_(context), tone_(tone), white_(white) {}

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
    std::optional<glm::dmat3> white_;
    std::map<int, Program> programs_;
    GrowingBuffer buffer_;
    VertexArray layout_;
};

} // namespace fernlicht::gl
