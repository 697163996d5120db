#include "runner/experiments/aliasing/over_moments.h"

#include <cmath>

namespace fernlicht {
namespace {

void add_squares(AliasingPart& sum, const AliasingPart& part) {
    sum.rms += part.rms * part.rms;
    sum.contrast_percent += part.contrast_percent * part.contrast_percent;
    sum.visible += part.visible * part.visible;
}

void root(AliasingPart& sum, double count) {
    for (double* value : {&sum.rms, &sum.contrast_percent, &sum.visible})
        *value = std::sqrt(*value / count);
}

} // namespace

SpatialAliasing over_moments(std::vector<SpatialAliasing>& found, std::size_t shown) {
    SpatialAliasing all = std::move(found[shown]);
    const auto each = [&](auto use) {
        use([](SpatialAliasing& a) -> AliasingPart& { return a.aliasing; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.folded; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.rest; });
        use([](SpatialAliasing& a) -> AliasingPart& { return a.lost; });
        for (std::size_t b = 0; b < all.bands.size(); ++b) {
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].aliasing; });
            use([b](SpatialAliasing& a) -> AliasingPart& { return a.bands[b].lost; });
        }
    };
    found[shown].bands = all.bands;
    each([&](auto part) {
        AliasingPart sum;
        for (SpatialAliasing& one : found)
            add_squares(sum, part(one));
        root(sum, static_cast<double>(found.size()));
        part(all) = sum;
    });
    return all;
}

} // namespace fernlicht
