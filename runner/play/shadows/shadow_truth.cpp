#include "runner/play/shadows/shadow_truth.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {
namespace {

/// Where less light is drawn than there is (faint lamps of others are left out), a share of the one is no share of the other.
bool like_light(float drawn_lx, float true_lx) {
    constexpr float max_apart = 0.2F;
    return std::abs(drawn_lx - true_lx) <= max_apart * std::max(drawn_lx, true_lx);
}

} // namespace

Image<float> true_degrees(const ShadowTruth::Found& truth, double floor_lx) {
    const ShadowImages images{truth.true_lx, truth.true_lx, truth.unshadowed_lx, {}, {}};
    Image<float> out(truth.true_lx.width(), truth.true_lx.height(), -1.0F);
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx))
                out.at(x, y) = static_cast<float>(degrees->truth);
    return out;
}

RendererSettings without_shadows(RendererSettings settings) {
    settings.shadows.method = ShadowMethod::none;
    settings.profile = settings.gpu_clock = false;
    return settings;
}

ShadowTruth::ShadowTruth(const Reference& rays, Renderer& unshadowed, const std::vector<Moment>& moments, const View& view,
                         double lamp_radius_m, double floor_lx)
    : rays_(rays), unshadowed_(unshadowed), moments_(moments), view_(view), lamp_radius_m_(lamp_radius_m), floor_lx_(floor_lx),
      found_(moments.size()) {}

const ShadowTruth::Found& ShadowTruth::of(std::size_t moment) {
    std::optional<Found>& found = found_.at(moment);
    if (found)
        return *found;
    ReferenceSettings settings;
    settings.footprint = Footprint::centre;
    settings.lamp_radius_m = lamp_radius_m_;
    settings.target_error = 0.01;
    settings.max_samples = 256;
    const bool half_shadows = lamp_radius_m_ > 0.0; // samples go on until luminance is sure, too
    ReferenceImage shadowed = rays_.render(moments_[moment], view_, {.illuminance = true, .luminance = half_shadows}, settings);
    settings.shadows = false;
    ReferenceImage free = rays_.render(moments_[moment], view_, {.illuminance = true}, settings);
    Frame drawn = unshadowed_.draw(moments_[moment], view_, {.illuminance = true});
    found = Found{std::move(shadowed.illuminance_lx.mean), std::move(free.illuminance_lx.mean), std::move(drawn.illuminance_lx),
                  std::move(shadowed.ids)};
    return *found;
}

ShadowImages ShadowTruth::images(Renderer& renderer, std::size_t moment) {
    const Found& truth = of(moment);
    Frame drawn = renderer.draw(moments_[moment], view_, {.illuminance = true, .ids = true});
    ShadowImages images{std::move(drawn.illuminance_lx), truth.true_lx, truth.unshadowed_lx, truth.drawn_unshadowed_lx,
                        Image<std::uint8_t>(view_.width_px, view_.height_px)};
    for (std::size_t i = 0; i < images.counts.pixels().size(); ++i) {
        const std::uint32_t id = truth.ids.pixels()[i];
        const float free_lx = truth.unshadowed_lx.pixels()[i];
        const bool counts = id != 0 && drawn.ids.pixels()[i] == id && static_cast<double>(free_lx) > floor_lx_ &&
                            like_light(truth.drawn_unshadowed_lx.pixels()[i], free_lx);
        images.counts.pixels()[i] = static_cast<std::uint8_t>(counts ? 1 : 0);
    }
    return images;
}

} // namespace fernlicht
