// What is drawn into, and read back: one texture for each result that is wanted.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "scenarios/drives/play/frame.h"

#include <optional>

namespace fernlicht::gl {

class Targets {
  public:
    Targets(Context& context, int width, int height, const Wanted& wanted);

    /// Binds, sets the viewport and clears: everything 0, colour to `background`, luminance and light to the sky's.
    void begin(const glm::vec3& background, float sky_luminance_cdm2);
    /// Reads every wanted result; waits for the drawing to finish.
    Frame read();

    /// Pixels on their way into a buffer of the driver's, while the GPU and we go on.
    struct Reading {
        Buffer pixels;
        GLsync drawn = nullptr;
    };
    Reading start_read();
    Frame finish_read(Reading reading);

    /// WANT_* and OUT_* for the fragment shader; WANT_SEEN: any of what an eye sees.
    static std::vector<Program::Define> defines(const Wanted& wanted);

  private:
    enum Result { colour, illuminance, target, luminance, light, depth, ids, result_count };
    static bool is_wanted(const Wanted& wanted, Result result);
    static int slot(const Wanted& wanted, Result result);
    std::size_t bytes_of(Result result) const;
    /// glReadPixels of one result, to memory or, with a pack buffer bound, to an offset in it.
    void read_pixels(Result result, void* place);
    /// Makes the frame's pictures, each filled by fill(result, destination, bytes).
    template <class Fill> Frame make_frame(Fill fill);

    Context& context_;
    int width_, height_;
    Wanted wanted_;
    Framebuffer framebuffer_;
    Texture textures_[result_count];
    Texture depth_;
};

} // namespace fernlicht::gl
