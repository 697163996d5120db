#include "runner/experiments/aliasing/road_edges.h"

#include <algorithm>

namespace fernlicht {

Image<Ground> ground_of(Device& device, const Scene& scene, const Moment& moment, const View& view) {
    Scene glowing = scene; // nothing returns light; what is looked for glows
    for (Material& material : glowing.materials) {
        const float glow = material.kind == SurfaceKind::road ? 1.0F : material.kind == SurfaceKind::marking ? 2.0F : 0.0F;
        material.albedo = glm::vec3(0.0F);
        material.retro_rl = 0.0F;
        material.texture = -1;
        material.emission_cdm2 = glm::vec3(glow);
    }
    Moment dark = moment;
    dark.lamps.clear();
    dark.daylight = {};
    Renderer renderer(device, glowing, {});
    const Frame frame = renderer.draw(dark, view, {.luminance = true});
    Image<Ground> ground(view.width_px, view.height_px, Ground::other);
    std::ranges::transform(frame.luminance_cdm2.pixels(), ground.pixels().begin(), [](float glow) {
        return glow > 1.5F ? Ground::mark : glow > 0.5F ? Ground::road : Ground::other;
    });
    return ground;
}

} // namespace fernlicht
