// One way to light a scene on the GPU: what renderer.cpp asks of it.
#pragma once

#include "renderer/gl/device/pass_clock.h"
#include "renderer/gl/device/targets.h"
#include "renderer/renderer.h"
#include "scenarios/drives/play/camera.h"

#include <memory>

namespace fernlicht::gl {

/// What one view of one moment is drawn with.
struct Shot {
    const Moment& moment;
    const View& view;
    const FrameOutputs& outputs; ///< only what the technique has
    const Camera& camera;
    Targets& targets;
    glm::vec3 background; ///< the sky as it is shown
    float sky_luminance_cdm2 = 0.0F;
    PassClock& clock;
    Work& work;                ///< counted up
    std::optional<Frame>& lit; ///< what the CPU lights goes here, over what it held, and nothing to `targets`; else it is emptied
};

class Lighting {
  public:
    virtual ~Lighting() = default;
    virtual void draw(const Shot& shot) = 0;
    /// Compiles every variant that drawing moments with these lamps and this sky can need, and makes the driver compile it too.
    virtual void prepare(const Shot& shot) = 0;
    /// Only those that drawing this very shot needs, where that is less.
    virtual void prepare_here(const Shot& shot) { prepare(shot); }
    /// Drops the programs that no shot with the lamps of these moments is drawn with, and what the driver holds of them.
    virtual void keep_programs_of(const std::vector<Moment>&) {}
    /// What the last drawn shot did not need.
    virtual std::vector<PrunedFeature> pruned() const = 0;
    virtual std::string why_shader(const Shot&) const { return ""; }
    /// Of the beam as it is drawn with against its table, relative to the peak; nullopt where no beam of one lamp is drawn with.
    virtual std::optional<double> beam_error(const LampFile& lamp) const = 0;
};

} // namespace fernlicht::gl
