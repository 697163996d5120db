// Tone mappers at the ends of their domain, in pictures and in drive files.
#include "runner/experiments/stability/trial.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

using namespace stability;

/// A white wall under skies of every luminance, in 8 bits, against the formula in double.
Found pictures(StabilityBench& bench) {
    Scene scene = empty_scene();
    scene.materials[0].albedo = glm::vec3(1.0F);
    add_sheet(scene, "floor", 0, {-5.0, -5.0, -1.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0});
    const View view = camera({0.0, 0.0, 0.0}, 0.0, -0.5 * pi, 40.0, 4, 4);
    Found worst;
    for (const ToneMapperKind kind : {ToneMapperKind::linear, ToneMapperKind::rational, ToneMapperKind::logarithmic})
        for (const double s : {1.0, 1.0 + 1e-7, 20.0, 1e6})
            for (const double l_max : {1e-6, 100.0, 1e9}) {
                if (kind == ToneMapperKind::linear && s != 1.0)
                    continue;
                RendererSettings settings;
                settings.tone_mapper = {kind, s, l_max, {}};
                Renderer renderer(bench.device(), scene, settings);
                for (const double l : {0.0, 1e-42, 1e-30, 1e-6 * l_max, 0.5 * l_max, l_max * (1.0 - 1e-7), l_max, l_max * (1.0 + 1e-7),
                                       10.0 * l_max, 1e30}) {
                    Moment moment;
                    moment.daylight.horizontal_illuminance_lx = pi * l;
                    const Frame frame = renderer.draw(moment, view, {.colour = true, .luminance = true});
                    const double shown = 255.0 * photometry::srgb_encoded(toned(settings.tone_mapper, l));
                    const double error =
                        not_finite(frame) > 0 ? std::numeric_limits<double>::infinity() : std::abs(frame.colour.at(1, 1).g - shown);
                    worst.add(error, fmt::format("{}, s = {:g}, L_max = {:g}, L = {:g}", name(kind), s, l_max, l));
                }
            }
    return worst;
}

} // namespace

std::vector<StabilityCase> tone_cases() {
    return {
        {"tone", "pictures",
         "s = 1, just above it, and 1e6; L = 0, denormal, L_max and far above; L_max from 1e-6 to 1e9: 0/0 and overflow", 0.52,
         "8-bit steps", "half a step by rounding to 8 bits, 0.01 by the polynomial in place of the sRGB power, 0.01 by floats", pictures},
    };
}

} // namespace fernlicht
