// What is drawn into, and read back: one texture for each result that is wanted.
#pragma once

#include "renderer/gl/objects.h"
#include "renderer/gl/program.h"
#include "scenarios/drives/frame.h"

#include <optional>

namespace fernlicht::gl {

class Targets {
  public:
    Targets(Context& context, int width, int height, const Wanted& wanted);

    /// Binds, sets the viewport and clears: everything 0, colour to `background`, luminance to the sky's.
    void begin(const glm::vec3& background, float sky_luminance_cdm2);
    /// Reads every wanted result; waits for the drawing to finish.
    void read(Frame& frame);

    /// WANT_* and OUT_* for the fragment shader.
    static std::vector<Program::Define> defines(const Wanted& wanted);

  private:
    enum Result { colour, illuminance, target, luminance, depth, ids, result_count };
    static bool is_wanted(const Wanted& wanted, Result result);
    static int slot(const Wanted& wanted, Result result);

    Context& context_;
    int width_, height_;
    Wanted wanted_;
    Framebuffer framebuffer_;
    Texture textures_[result_count];
    Texture depth_;
    std::vector<unsigned char> rgba_;
};

} // namespace fernlicht::gl
