#include "runner/experiments/shadows/sheet_picture.h"

#include <algorithm>

namespace fernlicht {
namespace {

bool shows_ground(const Scene& scene, std::uint32_t id) {
    return id > 0 && std::ranges::all_of(scene.meshes.at(id - 1).batches,
                                         [&](const Batch& batch) { return is_ground(scene.materials.at(batch.material).kind); });
}

} // namespace

Image<float> shaded_by_rays(const Image<float>& unshadowed_cdm2, const Image<float>& degree) {
    Image<float> out = unshadowed_cdm2;
    for (std::size_t i = 0; i < out.size(); ++i)
        out.pixels()[i] *= 1.0F - std::clamp(degree.pixels()[i], 0.0F, 1.0F);
    return out;
}

double white_of_ground(const Image<float>& luminance_cdm2, const Image<std::uint32_t>& ids, const Scene& scene) {
    std::vector<float> sorted;
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (shows_ground(scene, ids.pixels()[i]))
            sorted.push_back(luminance_cdm2.pixels()[i]);
    if (sorted.empty())
        sorted = luminance_cdm2.pixels();
    std::ranges::sort(sorted);
    return sorted.empty() ? 1.0 : std::max(1e-3, static_cast<double>(sorted[sorted.size() * 99 / 100]));
}

} // namespace fernlicht
