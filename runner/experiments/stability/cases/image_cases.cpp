// Cameras, tone mappers and pictures at the ends of what may be asked for: their numbers on their way into files, and pictures that are
// hard to compare.
#include "runner/experiments/stability/stability_case.h"
#include "runner/experiments/stability/trial.h"
#include "runner/files/picture_file.h"
#include "scenarios/display/tone_mapper.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace fernlicht {
namespace {

using namespace stability;

struct Size {
    double fov_deg;
    int width_px, height_px;
};

StabilityCase::Measure against_a_street(const std::vector<Size>& sizes) {
    return [sizes](StabilityBench& bench, Found& worst) {
        Scene scene = scene_of_sheet("road", 0, {-20.0, -30.0, 0.0}, {120.0, 0.0, 0.0}, {0.0, 60.0, 0.0});
        add_sheet(scene, "board", 1, {30.0, 1.0, 0.5}, {0.0, -2.0, 0.0}, {0.0, 0.0, 1.5});
        Renderer renderer(bench.device(), scene, unshadowed());
        const Moment moment = moment_of(lamp(cut_off_table(), {3.5, 0.6, 0.65}));
        for (const Size& size : sizes) {
            const AgainstTwin found =
                against_twin(renderer, scene, moment, camera({1.3, 0.35, 1.2}, 0.0, -0.05, size.fov_deg, size.width_px, size.height_px));
            worst.add(found.error(),
                      fmt::format("{} degrees, {} x {}: {}, {:.1e} relative over {} pixels", size.fov_deg, size.width_px, size.height_px,
                                  found.where, found.worst_relative, found.compared),
                      found.compared);
        }
    };
}

/// What is stored in EXR comes back to the bit.
void stored(StabilityBench& bench, Found& worst) {
    Frame frame;
    const float values[] = {0.0F,     1e-42F,  1.17549435e-38F, 1e-20F,   5.9e-8F, 0.01F,       0.25F, 1.0F,
                            1.00001F, 2049.0F, 65504.0F,        65520.0F, 1e5F,    16777217.0F, 1e18F, std::numeric_limits<float>::max()};
    frame.illuminance_lx = Image<float>(16, 1);
    std::ranges::copy(values, frame.illuminance_lx.pixels().begin());
    frame.luminance_cdm2 = frame.illuminance_lx;
    const std::filesystem::path path = bench.file("stored.exr");
    write_exr(frame, Moment{}, View{}, path);
    std::size_t channels = 0;
    for (const PictureChannel& channel : read_exr(path)) {
        ++channels;
        for (int x = 0; x < 16; ++x)
            worst.add(channel.values.at(x, 0) == values[x] ? 0.0 : 1.0, fmt::format("{}: {:g}", channel.name, values[x]));
    }
    worst.add(channels == 2 ? 0.0 : 1.0, fmt::format("{} channels", channels));
}

/// A white wall under skies of every luminance, in 8 bits, against the formula in double.
void pictures(StabilityBench& bench, Found& worst) {
    Scene scene = empty_scene();
    scene.materials[0].albedo = glm::vec3(1.0F);
    add_sheet(scene, "floor", 0, {-5.0, -5.0, -1.0}, {10.0, 0.0, 0.0}, {0.0, 10.0, 0.0});
    const View view = camera({0.0, 0.0, 0.0}, 0.0, -0.5 * pi, 40.0, 4, 4);
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
                    const double error = not_finite(frame) > 0 ? unbounded : std::abs(frame.colour.at(1, 1).g - shown);
                    worst.add(error, fmt::format("{}, s = {:g}, L_max = {:g}, L = {:g}", name(kind), s, l_max, l));
                }
            }
}

} // namespace

std::vector<StabilityCase> image_cases() {
    const std::string of_bound = "of the pixel's rounding bound";
    return {
        {"image", "field-of-view", "0.1 to 179 degrees: tangents of 0.0009 and 115", 1.0, of_bound,
         "the projection only decides where a pixel looks; light comes from positions relative to the car",
         against_a_street({{0.1, 48, 32}, {1.0, 48, 32}, {90.0, 48, 32}, {170.0, 48, 32}, {179.0, 48, 32}})},
        {"image", "sizes", "1 x 1, one row, one column, 16384 x 16: the widest that OpenGL 4.5 promises", 1.0, of_bound,
         "a pixel does not know of its neighbours",
         against_a_street({{2.0, 1, 1}, {40.0, 1, 64}, {4.0, 64, 1}, {10.0, 1, 16384}, {0.1, 16384, 1}, {0.112, 16384, 16}})},
        {"image", "stored", "numbers on their way into EXR: 1e5 lx, denormals, the largest float", 0.0, "values changed",
         "channels are 32-bit floats; half floats end at 65504 lx and keep 11 bits", stored},
    };
}

std::vector<StabilityCase> tone_cases() {
    return {
        {"tone", "pictures",
         "s = 1, just above it, and 1e6; L = 0, denormal, L_max and far above; L_max from 1e-6 to 1e9: 0/0 and overflow", 0.52,
         "8-bit steps", "half a step by rounding to 8 bits, 0.01 by the polynomial in place of the sRGB power, 0.01 by floats", pictures},
    };
}

} // namespace fernlicht
