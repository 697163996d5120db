// Candela tables at their limits, read from files as a user's are.
#include "renderer/beam_texture.h"
#include "runner/experiments/stability/trial.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace fernlicht {
namespace {

using namespace stability;

std::vector<double> axis(double from, double step, int count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i)
        values.push_back(from + step * i);
    return values;
}

CandelaTable table_of(std::vector<double> h, std::vector<double> v, const std::function<double(std::size_t, std::size_t)>& cd) {
    CandelaTable table{std::move(h), std::move(v), {}, {}, BetweenSamples::linear_cd};
    for (std::size_t y = 0; y < table.v_deg.size(); ++y)
        for (std::size_t x = 0; x < table.h_deg.size(); ++x)
            table.cd.push_back(cd(x, y));
    return table;
}

CandelaTable through_a_file(StabilityBench& bench, const std::string& name, const CandelaTable& table) {
    return read_lamp(write_matrix(bench, name + ".csv", table)).table;
}

void four_thousand(StabilityBench& bench, Found& worst) {
    const int count = 4000;
    const auto cd = [](std::size_t x, std::size_t y) { return static_cast<double>((x * 7 + y * 13) % 9); };
    const CandelaTable written = table_of(axis(-20.0, 0.01, count), axis(-20.0, 0.01, count), cd);
    const CandelaTable table = through_a_file(bench, "four-thousand", written);
    worst.add(table == written ? 0.0 : 1.0, "read back");
    // Steps of 0.01 degrees are coarsened to the texture's 4 M texels; what that costs must be said and be so.
    const BeamTexture texture = make_beam_texture(table);
    worst.add(static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height) <= (std::size_t{4} << 20) ? 0.0 : 1.0,
              fmt::format("texture of {} x {}", texture.width, texture.height));
    const double announced_cd = texture.worst_error_of_peak * peak_of(table).cd;
    for (int i = 0; i < 100'000; ++i) {
        const double h = radians(-19.9 + 39.7 * std::fmod(i * 0.6180339887498949, 1.0)), v = radians(-19.9 + 39.7 * i / 100'000.0);
        const double x = (h - texture.h_first_rad) / texture.h_step_rad, y = (v - texture.v_first_rad) / texture.v_step_rad;
        const auto at = [&](double column, double row) {
            return static_cast<double>(
                texture.cd.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) + static_cast<std::size_t>(column)));
        };
        const double fx = x - std::floor(x), fy = y - std::floor(y), cx = std::floor(x), cy = std::floor(y);
        const double drawn = std::lerp(std::lerp(at(cx, cy), at(cx + 1, cy), fx), std::lerp(at(cx, cy + 1), at(cx + 1, cy + 1), fx), fy);
        const double off = std::abs(drawn - intensity_cd(table, degrees(h), degrees(v)));
        worst.add(off / std::max(announced_cd, 1e-6),
                  fmt::format("{:.3f} {:.3f} degrees: {:.3g} cd off, {:.3g} announced", degrees(h), degrees(v), off, announced_cd));
    }
}

/// On a wall at 25 m, drawn and held against the twin.
void steep_steps(StabilityBench& bench, Found& worst) {
    const auto cd = [](std::size_t x, std::size_t y) { return (x + y) % 2 == 0 ? 1e5 : 1.0; };
    Scene scene = scene_of_sheet("wall", 0, {25.0, 40.0, -40.0}, {0.0, -80.0, 0.0}, {0.0, 0.0, 80.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment =
        moment_of(lamp(through_a_file(bench, "steps", table_of(axis(-10.0, 0.1, 201), axis(-10.0, 0.1, 201), cd)), {0.0, 0.0, 0.0}));
    const AgainstTwin found = against_twin(renderer, scene, moment, camera({0.0, 0.0, 0.0}, 0.0, 0.0, 20.0, 64, 48));
    worst.add(found.error(), fmt::format("{}: {:.1e} relative over {} pixels", found.where, found.worst_relative, found.compared),
              found.compared);
}

/// Straight above and below a lamp H has no meaning.
void poles(StabilityBench& bench, Found& worst) {
    const CandelaTable table =
        through_a_file(bench, "poles", table_of(axis(-90.0, 1.0, 181), axis(-90.0, 1.0, 181), [](auto, auto) { return 1000.0; }));
    Scene scene = scene_of_sheet("floor", 0, {-3.0, -3.0, -1.0}, {6.0, 0.0, 0.0}, {0.0, 6.0, 0.0});
    add_sheet(scene, "ceiling", 0, {-3.0, -3.0, 1.0}, {0.0, 6.0, 0.0}, {6.0, 0.0, 0.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double pitch : {-0.5 * pi, 0.5 * pi})
        for (const double lamp_pitch : {0.0, 1e-7, radians(1.0)}) {
            Moment moment = moment_of(lamp(table, {0.0, 0.0, 0.0}, 0.0, lamp_pitch));
            const View view = camera({0.0, 0.0, 0.0}, 0.0, pitch, 60.0, 33, 33);
            const Frame frame = renderer.draw(moment, view, everything);
            worst.add(static_cast<double>(not_finite(frame)),
                      fmt::format("looking {:.0f} degrees up, lamp {:.0e}", degrees(pitch), lamp_pitch), pixels_in(frame));
        }
    Moment moment = moment_of(lamp(table, {0.0, 0.0, 0.0}));
    for (const double h : {-180.0, -90.0, 0.0, 90.0})
        for (const double v : {-90.0, 90.0})
            worst.add(std::abs(intensity_cd(table, h, v) - (std::abs(h) > 90.0 ? 0.0 : 1000.0)), fmt::format("table at H {} V {}", h, v));
    for (const double x : {-1e-9, 0.0, 1e-9})
        worst.add(std::isfinite(target_illuminance_lx(moment, {x, 0.0, 1.0})) ? 0.0 : 1.0, "in double, straight above");
}

} // namespace

std::vector<StabilityCase> table_cases() {
    return {
        {"table", "4000x4000", "16 million samples: reader, memory, the GPU's texture of 4 M texels", 1.0, "of the error announced",
         "the texture is coarser than the table; `beam_error` must say by how much", four_thousand},
        {"table", "steps-of-1e5", "every neighbour differs by a factor of 1e5", 1.0, "of the pixel's rounding bound",
         "bilinear by hand in float: no look-up may weigh with a texture unit's 8 bits", steep_steps},
        {"table", "poles", "straight above and below the lamp H is 0/0", 0.0, "values that are not finite",
         "atan(0, 0) is 0, and light goes to the front half only", poles},
    };
}

} // namespace fernlicht
