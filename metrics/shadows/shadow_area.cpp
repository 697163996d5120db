#include "metrics/shadows/shadow_area.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fernlicht {
namespace {

/// `area(x, y)`: of a pixel.
template <class Area> ShadowArea summed(const ShadowImages& images, double floor_lx, Area area) {
    if (!(floor_lx > 0.0))
        throw std::invalid_argument("shadows: the floor is not above 0 lx");
    ShadowArea sum;
    for (int y = 0; y < images.true_lx.height(); ++y)
        for (int x = 0; x < images.true_lx.width(); ++x) {
            const std::optional<ShadowDegrees> degrees = shadow_degrees(images, x, y, floor_lx);
            const double of_pixel = area(x, y);
            if (!degrees || !(of_pixel > 0.0))
                continue;
            sum.counted += of_pixel;
            sum.shadowed += of_pixel * degrees->truth;
            sum.wrongly_lit += of_pixel * std::max(0.0, degrees->truth - degrees->drawn);
            sum.wrongly_dark += of_pixel * std::max(0.0, degrees->drawn - degrees->truth);
        }
    return sum;
}

} // namespace

ShadowArea& ShadowArea::operator+=(const ShadowArea& other) {
    counted += other.counted;
    shadowed += other.shadowed;
    wrongly_lit += other.wrongly_lit;
    wrongly_dark += other.wrongly_dark;
    return *this;
}

void check_sizes(const ShadowImages& images) {
    const int width = images.true_lx.width(), height = images.true_lx.height();
    const auto fits = [&](const auto& image, bool may_be_empty) {
        return (may_be_empty && image.empty()) || (image.width() == width && image.height() == height);
    };
    if (!fits(images.drawn_lx, false) || !fits(images.unshadowed_lx, false) || !fits(images.drawn_unshadowed_lx, true) ||
        !fits(images.counts, true))
        throw std::invalid_argument("shadows: images of different sizes");
}

std::optional<ShadowDegrees> shadow_degrees(const ShadowImages& images, int x, int y, double floor_lx) {
    if (!images.counts.empty() && images.counts.at(x, y) == 0)
        return std::nullopt;
    const double free = static_cast<double>(images.unshadowed_lx.at(x, y)),
                 drawn_free = images.drawn_unshadowed_lx.empty() ? free : static_cast<double>(images.drawn_unshadowed_lx.at(x, y)),
                 drawn = static_cast<double>(images.drawn_lx.at(x, y)), truth = static_cast<double>(images.true_lx.at(x, y));
    if (!(free >= floor_lx) || !(drawn_free > 0.0) || !std::isfinite(free + drawn_free + drawn + truth))
        return std::nullopt;
    const auto degree = [](double lx, double free_lx) { return std::clamp(1.0 - lx / free_lx, 0.0, 1.0); };
    return ShadowDegrees{degree(drawn, drawn_free), degree(truth, free)};
}

ShadowArea shadow_area(const ShadowImages& images, double pixel_area, double floor_lx) {
    check_sizes(images);
    if (!(pixel_area > 0.0))
        throw std::invalid_argument("shadows: the area of a pixel is not above 0");
    return summed(images, floor_lx, [&](int, int) { return pixel_area; });
}

ShadowArea shadow_area(const ShadowImages& images, const Image<float>& areas, double floor_lx) {
    check_sizes(images);
    if (areas.width() != images.true_lx.width() || areas.height() != images.true_lx.height())
        throw std::invalid_argument("shadows: areas of another size than the images");
    return summed(images, floor_lx, [&](int x, int y) { return static_cast<double>(areas.at(x, y)); });
}

Image<float> shadow_differences(const ShadowImages& images, double floor_lx) {
    check_sizes(images);
    Image<float> out(images.true_lx.width(), images.true_lx.height());
    for (int y = 0; y < out.height(); ++y)
        for (int x = 0; x < out.width(); ++x)
            if (const auto degrees = shadow_degrees(images, x, y, floor_lx))
                out.at(x, y) = static_cast<float>(degrees->truth - degrees->drawn);
    return out;
}

} // namespace fernlicht
