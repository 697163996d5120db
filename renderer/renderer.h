// Draws scenes at night: (Moment, View) -> Frame. All GL state lives here.
#pragma once

#include "renderer/device.h"
#include "scenarios/drives/frame.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

/// plain: the pixels are fetched at once. overlapped: they travel while the GPU and the caller go on.
enum class ReadBack { plain, overlapped };

struct RendererSettings {
    ToneMapper tone_mapper;
    bool shadows = true;
    int shadow_width = 1024, shadow_height = 512;
    double shadow_tolerance_m = 0.03; ///< an occluder counts when it stands this far above the receiver's tangent plane
    double target_height_m = 0.25;
    ReadBack read_back = ReadBack::plain;
    bool profile = false;   ///< finish after each pass and time it; slower, so never together with frame times
    bool gpu_clock = false; ///< time passes by GL_TIME_ELAPSED; only where check_timer() has found it right
};

class Renderer {
  public:
    /// Uploads the scene. Device and scene must outlive the renderer. Throws DeviceError.
    Renderer(Device& device, const Scene& scene, const RendererSettings& settings);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws and reads back what is wanted. Maps draw ground surfaces only. At most 8 lamps. Throws DeviceError.
    Frame draw(const Moment& moment, const View& view, const Wanted& wanted) { return submit(moment, view, wanted)(); }
    /// The same in two steps, so that the caller can work meanwhile. Several frames may be on their way.
    Pending submit(const Moment& moment, const View& view, const Wanted& wanted);
    /// Only draws, flushed as for a display: nothing is read back, nothing waited for. finish() waits.
    void render(const Moment& moment, const View& view, const Wanted& wanted);
    void finish();

    /// What the scene and this moment did not need, one sentence each.
    std::vector<std::string> left_out(const Moment& moment) const;
    /// Worst error of a lamp's texture against its table, relative to the peak.
    double beam_error(const LampFile& lamp) const;
    int compiled_programs() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Which way of reading back is faster on this device, by trying both on frames of 1024 x 768.
struct ReadBackCheck {
    double plain_s = 0.0, overlapped_s = 0.0; ///< medians, submit to collected, with drawing
    ReadBack faster() const { return overlapped_s < 0.95 * plain_s ? ReadBack::overlapped : ReadBack::plain; }
};
ReadBackCheck check_read_back(Device& device);

} // namespace fernlicht
