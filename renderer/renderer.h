// Draws scenes at night: (Moment, View) -> Frame. All GL state lives here.
#pragma once

#include "renderer/device.h"
#include "scenarios/drives/frame.h"
#include "scenarios/values/scene.h"

#include <map>

namespace fernlicht {

struct RendererSettings {
    ToneMapper tone_mapper;
    bool shadows = true;
    int shadow_width = 1024, shadow_height = 512;
    double shadow_tolerance_m = 0.03; ///< an occluder counts when it stands this far above the receiver's tangent plane
    double target_height_m = 0.25;
    bool profile = false; ///< finish after each pass and time it; slower, so never together with frame times
};

/// Names of passes with their time in the last frame drawn with `profile`.
using PassTimes = std::map<std::string, double>;

class Renderer {
  public:
    /// Uploads the scene. Device and scene must outlive the renderer. Throws DeviceError.
    Renderer(Device& device, const Scene& scene, const RendererSettings& settings);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Draws and reads back what is wanted. Maps draw ground surfaces only. At most 8 lamps. Throws DeviceError.
    Frame draw(const Moment& moment, const View& view, const Wanted& wanted);

    const PassTimes& pass_times() const;
    /// What the scene and this moment did not need, one sentence each.
    std::vector<std::string> left_out(const Moment& moment) const;
    /// Worst error of a lamp's texture against its table, relative to the peak.
    double beam_error(const LampFile& lamp) const;
    int compiled_programs() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace fernlicht
