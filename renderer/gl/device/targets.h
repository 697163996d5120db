// What is drawn into and read back: one texture for each result that is asked for.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/gl/device/program.h"
#include "scenarios/drives/play/frame.h"

#include <optional>
#include <span>

namespace fernlicht::gl {

class Targets {
  public:
    Targets(Context& context, int width, int height, const FrameOutputs& outputs);

    /// Binds, sets the viewport and clears: everything 0, colour to `background`, luminance and light to the sky's. `looked_at`: beside
    /// these boxes, where there are any, nothing passes the depth test.
    void begin(const glm::vec3& background, float sky_luminance_cdm2, std::span<const PixelBox> looked_at = {});
    /// The same for visible.frag.glsl: which triangle a pixel shows, and its texel.
    void begin_visible(std::span<const PixelBox> looked_at = {});
    void read_visible(std::vector<std::uint32_t>& pixels);
    int width() const { return width_; }
    int height() const { return height_; }
    /// Reads every wanted result; waits for the drawing to finish.
    Frame read();

    /// Pixels on their way into a buffer of the driver's, while the GPU and we go on.
    struct Reading {
        Buffer pixels;
        std::size_t bytes = 0;
        GLsync drawn = nullptr;
    };
    Reading start_read();
    Frame finish_read(Reading reading);

    /// WANT_* and OUT_* for the fragment shader; WANT_SEEN: any of what an eye sees.
    static std::vector<Program::Define> defines(const FrameOutputs& outputs);

  private:
    enum Result { colour, illuminance, target, luminance, light, depth, ids, result_count };
    static std::vector<Result> results_of(const FrameOutputs& outputs);
    std::size_t bytes_of(Result result) const;
    void clear_depth(GLuint framebuffer, std::span<const PixelBox> looked_at);
    /// glReadPixels of one result, to memory or, with a pack buffer bound, to an offset in it.
    void read_pixels(std::size_t slot, void* place);
    /// Makes the frame's pictures, each filled by fill(slot, destination, bytes), in the order of the slots.
    template <class Fill> Frame make_frame(Fill fill);

    Context& context_;
    int width_, height_;
    std::vector<Result> results_; ///< those wanted; a slot each
    Framebuffer framebuffer_;
    std::vector<Texture> textures_;
    Texture depth_;
    Framebuffer visible_framebuffer_; ///< from the first begin_visible() on
    Texture visible_;
};

} // namespace fernlicht::gl
