#include "renderer/gl/shadow_maps.h"

namespace fernlicht::gl {

std::unique_ptr<Shadows> make_shadows(Context& context, const SceneBuffers& scene, const ShadowSettings& settings) {
    switch (settings.method) {
    case ShadowMethod::none:
        return nullptr;
    case ShadowMethod::map:
        break;
    }
    return std::make_unique<ShadowMaps>(context, scene, settings);
}

} // namespace fernlicht::gl
