#include "renderer/gl/shadows/ground_shadows.h"
#include "renderer/gl/shadows/projected_maps.h"
#include "renderer/gl/shadows/shadow_maps.h"
#include "renderer/gl/shadows/shadow_volumes.h"
#include "renderer/gl/shadows/warped_maps.h"

#include <stdexcept>

namespace fernlicht::gl {

std::unique_ptr<Shadows> make_shadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings, const ShadowUse& use) {
    switch (settings.method) {
    case ShadowMethod::none:
        return nullptr;
    case ShadowMethod::under_car:
        return std::make_unique<UnderCarShadows>(context, scene, settings, use);
    case ShadowMethod::planar:
        return std::make_unique<PlanarShadows>(context, scene, settings, use);
    case ShadowMethod::volumes:
        return std::make_unique<ShadowVolumes>(context, scene, settings, use);
    case ShadowMethod::automatic:
        throw std::invalid_argument("shadows: auto is to be chosen before rendering (choose_shadows.h)");
    case ShadowMethod::map:
        if (settings.redraw_texels > 0.0)
            return std::make_unique<ProjectedMaps>(context, scene, settings);
        break;
    case ShadowMethod::one_map:
        return std::make_unique<OneMap>(context, scene, settings);
    case ShadowMethod::perspective_map:
        return std::make_unique<WarpedMaps>(context, scene, settings, Warp::perspective, use.eye);
    case ShadowMethod::light_space_map:
        return std::make_unique<WarpedMaps>(context, scene, settings, Warp::light_space, use.eye);
    case ShadowMethod::soft_map:
        return std::make_unique<SoftMaps>(context, scene, settings);
    }
    return std::make_unique<ShadowMaps>(context, scene, settings);
}

} // namespace fernlicht::gl
