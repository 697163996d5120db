// Candela tables at their limits, read from files as a user's are.
#include "renderer/beam_texture.h"
#include "runner/experiments/compare/lamps/lamp_description.h"
#include "runner/experiments/stability/trial.h"
#include "scenarios/light/light.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <numeric>

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
    return read_lamp(bench.write(name + ".csv", matrix_text(table))).table;
}

/// A wall at 25 m, drawn and held against the twin.
AgainstTwin on_a_wall(StabilityBench& bench, const CandelaTable& table, double yaw_rad = 0.0, double pitch_rad = 0.0,
                      double fov_deg = 20.0) {
    Scene scene = empty_scene();
    add_sheet(scene, "wall", 0, {25.0, 40.0, -40.0}, {0.0, -80.0, 0.0}, {0.0, 0.0, 80.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment;
    moment.lamps = {lamp(table, {0.0, 0.0, 0.0}, yaw_rad, pitch_rad)};
    return against_twin(renderer, scene, moment, camera({0.0, 0.0, 0.0}, 0.0, 0.0, fov_deg, 64, 48));
}

Found found_on_a_wall(StabilityBench& bench, const CandelaTable& table) {
    const AgainstTwin found = on_a_wall(bench, table);
    Found worst;
    worst.add(found.error(), fmt::format("{}: {:.1e} relative over {} pixels", found.where, found.worst_relative, found.compared));
    return worst;
}

/// Everything that a report says of a lamp must be a number.
double not_numbers(const CandelaTable& table) {
    LampFile file;
    file.name = "trial";
    file.table = table;
    file.declared_flux_lm = 1000.0; // so that no number may be missing
    const LampDescription said = describe(file);
    const std::string text = text_of(said) + json_of(said);
    return text.find("nan") != std::string::npos || text.find("null") != std::string::npos || text.find(" inf") != std::string::npos ? 1.0
                                                                                                                                     : 0.0;
}

Found two_by_two(StabilityBench& bench) {
    return found_on_a_wall(bench, through_a_file(bench, "two", {{-30.0, 30.0}, {-30.0, 30.0}, {1.0, 1e5, 10.0, 0.0}, {}, {}}));
}

Found four_thousand(StabilityBench& bench) {
    const int count = 4000;
    const auto cd = [](std::size_t x, std::size_t y) { return static_cast<double>((x * 7 + y * 13) % 9); };
    const CandelaTable written = table_of(axis(-20.0, 0.01, count), axis(-20.0, 0.01, count), cd);
    const CandelaTable table = through_a_file(bench, "four-thousand", written);
    Found worst;
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
    return worst;
}

Found hot_cell(StabilityBench& bench) {
    const CandelaTable table = through_a_file(bench, "hot",
                                              table_of(axis(-10.0, 0.1, 201), axis(-10.0, 0.1, 201),
                                                       [](std::size_t x, std::size_t y) { return x == 103 && y == 98 ? 1e6 : 0.0; }));
    Found worst = found_on_a_wall(bench, table);
    // A tent over four cells: its volume is peak * step^2, times cos V.
    const double step = radians(0.1), flux = 1e6 * step * step * std::cos(radians(-0.2));
    worst.add(std::abs(flux_lm(table) / flux - 1.0) / 1e-5, "flux of the tent in units of 1e-5");
    return worst;
}

Found steep_steps(StabilityBench& bench) {
    return found_on_a_wall(bench, through_a_file(bench, "steps",
                                                 table_of(axis(-10.0, 0.1, 201), axis(-10.0, 0.1, 201),
                                                          [](std::size_t x, std::size_t y) { return (x + y) % 2 == 0 ? 1e5 : 1.0; })));
}

Found zero(StabilityBench& bench) {
    const CandelaTable table =
        through_a_file(bench, "zero", table_of(axis(-10.0, 1.0, 21), axis(-10.0, 1.0, 21), [](auto, auto) { return 0.0; }));
    Scene scene = empty_scene();
    add_sheet(scene, "board", 1, {25.0, 40.0, -40.0}, {0.0, -80.0, 0.0}, {0.0, 0.0, 80.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment;
    moment.lamps = {lamp(table, {0.0, 0.0, 0.0})};
    const Frame frame = renderer.draw(moment, camera({0.0, 0.0, 0.0}, 0.0, 0.0, 20.0, 16, 16), everything);
    Found worst;
    worst.add(static_cast<double>(std::ranges::count_if(frame.illuminance_lx.pixels(), [](float e) { return e != 0.0F; }) +
                                  std::ranges::count_if(frame.target_lx.pixels(), [](float e) { return e != 0.0F; }) +
                                  std::ranges::count_if(frame.luminance_cdm2.pixels(), [](float e) { return e != 0.0F; })),
              "pixels of the frame");
    worst.add(flux_lm(table) == 0.0 && peak_of(table).cd == 0.0 ? 0.0 : 1.0, "flux and peak");
    worst.add(not_numbers(table), "what is said of the lamp");
    return worst;
}

/// A whole turn: H 180 and -180 are one direction.
Found wrap_around(StabilityBench& bench) {
    const CandelaTable table =
        through_a_file(bench, "turn", table_of(axis(-180.0, 1.0, 361), axis(-10.0, 1.0, 21), [](std::size_t x, std::size_t) {
                           return 1000.0 + 900.0 * std::cos(radians(static_cast<double>(x)));
                       }));
    Found worst;
    for (const double near_deg : {0.0, 1e-12, 1e-6, 1e-3, 0.5})
        for (const double turns : {-720.0, -360.0, 0.0, 360.0, 720.0}) {
            const double right = intensity_cd(table, 180.0 - near_deg + turns, 0.3),
                         left = intensity_cd(table, -180.0 + near_deg + turns, 0.3);
            // cos is even about 180 degrees, so that both sides have one intensity.
            worst.add(std::abs(right - left) / 1900.0, fmt::format("{} degrees from the seam, turned by {}", near_deg, turns));
        }
    Moment moment;
    moment.lamps = {lamp(table, {0.0, 0.0, 0.0})};
    worst.add(target_illuminance_lx(moment, {-10.0, 1e-9, 0.0}), "behind the lamp there is no light");
    return worst;
}

/// Straight above and below a lamp H has no meaning.
Found poles(StabilityBench& bench) {
    const CandelaTable table =
        through_a_file(bench, "poles", table_of(axis(-90.0, 1.0, 181), axis(-90.0, 1.0, 181), [](auto, auto) { return 1000.0; }));
    Scene scene = empty_scene();
    add_sheet(scene, "floor", 0, {-3.0, -3.0, -1.0}, {6.0, 0.0, 0.0}, {0.0, 6.0, 0.0});
    add_sheet(scene, "ceiling", 0, {-3.0, -3.0, 1.0}, {0.0, 6.0, 0.0}, {6.0, 0.0, 0.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    Found worst;
    for (const double pitch : {-0.5 * pi, 0.5 * pi})
        for (const double lamp_pitch : {0.0, 1e-7, radians(1.0)}) {
            Moment moment;
            moment.lamps = {lamp(table, {0.0, 0.0, 0.0}, 0.0, lamp_pitch)};
            const View view = camera({0.0, 0.0, 0.0}, 0.0, pitch, 60.0, 33, 33);
            const Frame frame = renderer.draw(moment, view, everything);
            worst.add(static_cast<double>(not_finite(frame)),
                      fmt::format("looking {:.0f} degrees up, lamp {:.0e}", degrees(pitch), lamp_pitch));
        }
    Moment moment;
    moment.lamps = {lamp(table, {0.0, 0.0, 0.0})};
    for (const double h : {-180.0, -90.0, 0.0, 90.0})
        for (const double v : {-90.0, 90.0})
            worst.add(std::abs(intensity_cd(table, h, v) - (std::abs(h) > 90.0 ? 0.0 : 1000.0)), fmt::format("table at H {} V {}", h, v));
    for (const double x : {-1e-9, 0.0, 1e-9})
        worst.add(std::isfinite(target_illuminance_lx(moment, {x, 0.0, 1.0})) ? 0.0 : 1.0, "in double, straight above");
    return worst;
}

/// Table samples a few thousandths of a degree apart: steeper than a texel of the GPU's grid. What that costs must be announced.
Found cut_off_in_a_texel(StabilityBench& bench) {
    Found worst;
    for (const double width_deg : {0.05, 0.01, 0.004, 0.001, 1e-4}) {
        std::vector<double> v = axis(-5.0, 0.25, 19);
        v.push_back(-0.5713);
        v.push_back(-0.5713 + width_deg);
        v.insert(v.end(), {0.0, 1.0, 2.0, 3.0});
        std::ranges::sort(v);
        v.erase(std::unique(v.begin(), v.end()), v.end());
        const CandelaTable table = through_a_file(
            bench, "cut", table_of(axis(-10.0, 1.0, 21), v, [&](std::size_t, std::size_t y) { return v[y] <= -0.5713 ? 20000.0 : 100.0; }));
        const BeamTexture texture = make_beam_texture(table);
        double drawn_worst = 0.0;
        for (int i = 0; i <= 4000; ++i) {
            const double at_deg = -1.0 + i * 2e-4, y = (radians(at_deg) - texture.v_first_rad) / texture.v_step_rad;
            const auto row = static_cast<std::size_t>(std::floor(y));
            const auto cd = [&](std::size_t r) { return static_cast<double>(texture.cd[r * static_cast<std::size_t>(texture.width) + 3]); };
            drawn_worst =
                std::max(drawn_worst, std::abs(std::lerp(cd(row), cd(row + 1), y - std::floor(y)) - intensity_cd(table, 0.0, at_deg)));
        }
        const double announced = texture.worst_error_of_peak * 20000.0 + 20000.0 * 1e-6;
        worst.add(drawn_worst / announced,
                  fmt::format("over {} degrees: {:.3g} cd off, {:.3g} announced", width_deg, drawn_worst, announced));
    }
    return worst;
}

} // namespace

std::vector<StabilityCase> table_cases() {
    const std::string of_bound = "of the pixel's rounding bound";
    const std::string interpolation = "bilinear by hand in float: no look-up may weigh with a texture unit's 8 bits";
    return {
        {"table", "2x2", "one cell over 60 degrees, corners from 0 to 1e5 cd", 1.0, of_bound, interpolation, two_by_two},
        {"table", "4000x4000", "16 million samples: reader, memory, the GPU's texture of 4 M texels", 1.0, "of the error announced",
         "the texture is coarser than the table; `beam_error` must say by how much", four_thousand},
        {"table", "hot-cell", "one sample of 1e6 cd among zeros", 1.0, of_bound, interpolation, hot_cell},
        {"table", "steps-of-1e5", "every neighbour differs by a factor of 1e5", 1.0, of_bound, interpolation, steep_steps},
        {"table", "zero", "a dark lamp: peak 0, flux 0, shares of nothing", 0.0, "values that are not 0 or no number",
         "0 times anything finite is 0", zero},
        {"table", "wrap-around", "H = 180 and H = -180 are one direction", 1e-9, "of the peak",
         "reducing an angle by whole turns is exact in double; 1e-12 degrees of the seam round by 3e-14", wrap_around},
        {"table", "poles", "straight above and below the lamp H is 0/0", 0.0, "values that are not finite",
         "atan(0, 0) is 0, and light goes to the front half only", poles},
        {"table", "cut-off-in-a-texel", "a cut-off from 0.05 down to 0.0001 degrees wide, texels of 0.05", 1.0, "of the error announced",
         "a texel cannot show what is narrower: the report's note must say at least as much", cut_off_in_a_texel},
    };
}

} // namespace fernlicht
