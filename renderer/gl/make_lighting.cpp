#include "renderer/gl/naive_lighting.h"
#include "renderer/gl/photometric_lighting.h"
#include "renderer/gl/published_lighting.h"

namespace fernlicht::gl {

std::unique_ptr<Lighting> make_lighting(Context& context, const Scene& scene, const RendererSettings& settings) {
    const Technique& technique = technique_named(settings.technique);
    if (technique.kind != TechniqueKind::ours)
        return std::make_unique<PublishedLighting>(context, scene, settings);
    if (technique.name == "photometric-naive")
        return std::make_unique<NaiveLighting>(context, scene, settings);
    return std::make_unique<PhotometricLighting>(context, scene, settings, technique.name != "photometric-unpruned");
}

} // namespace fernlicht::gl
