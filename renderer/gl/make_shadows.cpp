#include "renderer/gl/planar_shadows.h"
#include "renderer/gl/shadow_maps.h"
#include "renderer/gl/shadow_volumes.h"
#include "renderer/gl/under_car_shadows.h"

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
    case ShadowMethod::map:
        break;
    }
    return std::make_unique<ShadowMaps>(context, scene, settings);
}

} // namespace fernlicht::gl
