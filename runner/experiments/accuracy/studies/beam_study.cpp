#include "metrics/images/pixel_errors.h"
#include "renderer/beam_texture.h"
#include "renderer/projected_beam.h"
#include "runner/experiments/accuracy/studies/studies.h"
#include "scenarios/photometry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double min_of_peak = 0.01;

struct Direction {
    double h_deg, v_deg, cd;
};

/// Directions spread evenly over the table's front (the R2 sequence of Roberts 2018), where it has at least 1 % of the peak.
std::vector<Direction> bright_directions(const CandelaTable& table) {
    constexpr double g = 1.32471795724474602596; // x^3 = x + 1
    constexpr int count = 200'000;
    const double h_from = std::max(table.h_deg.front(), -54.0), h_to = std::min(table.h_deg.back(), 54.0);
    const double v_from = std::max(table.v_deg.front(), -24.0), v_to = std::min(table.v_deg.back(), 19.0),
                 least = min_of_peak * peak_of(table).cd;
    std::vector<Direction> directions;
    for (int i = 0; i < count; ++i) {
        const double a = std::fmod(0.5 + i / g, 1.0), b = std::fmod(0.5 + i / (g * g), 1.0);
        const double h = h_from + (h_to - h_from) * a, v = v_from + (v_to - v_from) * b, cd = intensity_cd(table, h, v);
        if (cd >= least && cd > 0.0)
            directions.push_back({h, v, cd});
    }
    return directions;
}

double looked_up_cd(const BeamTexture& t, const Direction& direction) {
    const glm::dvec2 at = photometry::beam_position({radians(direction.h_deg), radians(direction.v_deg)},
                                                    {t.h_first_rad, t.v_first_rad, 1.0 / t.h_step_rad, 1.0 / t.v_step_rad});
    if (photometry::beam_known(at, {t.width, t.height}) == 0.0)
        return 0.0;
    const auto x = static_cast<std::size_t>(at.x), y = static_cast<std::size_t>(at.y), width = static_cast<std::size_t>(t.width);
    const std::size_t right = std::min(x + 1, width - 1), upper = std::min(y + 1, static_cast<std::size_t>(t.height) - 1);
    const auto cd = [&](std::size_t row, std::size_t column) { return static_cast<double>(t.cd[row * width + column]); };
    return photometry::bilinear(cd(y, x), cd(y, right), cd(upper, x), cd(upper, right),
                                {at.x - static_cast<double>(x), at.y - static_cast<double>(y)});
}

double looked_up_cd(const ProjectedBeam& beam, const Direction& direction) {
    const double x = std::tan(radians(direction.h_deg)), y = std::tan(radians(direction.v_deg)) / std::cos(radians(direction.h_deg));
    const TangentWindow& w = beam.window;
    return 625.0 * projected_lx(beam, (x - w.left) / (w.right - w.left), (y - w.bottom) / (w.top - w.bottom));
}

template <class Made, class Make>
WorkPrecisionRow row_of(const std::string& label, const std::vector<Direction>& directions, Make make, std::uint64_t bytes) {
    PixelErrorFold fold(ErrorRule{1e-300});
    const Made made = make();
    for (const Direction& direction : directions)
        fold.add({looked_up_cd(made, direction), direction.cd, 0.0, {}, 0, 0, 0});
    WorkPrecisionRow row;
    row.label = label;
    if (const auto errors = fold.finish())
        row.error = {100.0 * errors->error.p95, 100.0 * errors->error.median, 100.0 * errors->error.p99};
    else
        row.why_not = "the lamp is dark";
    row.seconds = timed([&] { make(); });
    row.bytes = bytes;
    return row;
}

} // namespace

WorkPrecision beam_study(const LampSet& lamp_set, const StudyGoesOn& go_on) {
    WorkPrecision diagram{"beam", "Beam textures", "error of intensity, 95 % of the directions", "%", "time to make it", "", {}, {}};
    const CandelaTable& table = lamp_set.lamps.front().file->table;
    const std::vector<Direction> directions = bright_directions(table);
    diagram.notes = {
        fmt::format("{} directions with at least 1 % of the peak; bars from the median to 99 %. Over angles: as photometric looks "
                    "it up; projected: on the tangent plane, as the founding thesis did",
                    directions.size())};
    const auto bytes = [](const BeamTexels& t) {
        return static_cast<std::uint64_t>(t.width) * static_cast<std::uint64_t>(t.height * t.bits / 8);
    };
    for (const auto& [width, height] :
         {std::pair(128, 32), std::pair(256, 64), std::pair(512, 128), std::pair(1024, 512), std::pair(2048, 1024)})
        for (const int bits : {8, 16, 32}) {
            if (!go_on())
                return diagram;
            const BeamTexels texels{width, height, bits};
            const std::string size = beams_text(texels);
            diagram.rows.push_back(row_of<BeamTexture>(
                "angles " + size, directions, [&] { return make_beam_texture(table, texels); }, bytes(texels)));
            diagram.rows.push_back(row_of<ProjectedBeam>(
                "projected " + size, directions, [&] { return make_projected_beam(table, texels); }, bytes(texels)));
            if (texels == eight_bit_texels)
                diagram.rows.back().note = "the thesis";
        }
    if (go_on()) {
        const BeamTexture own = make_beam_texture(table);
        diagram.rows.push_back(row_of<BeamTexture>(
            fmt::format("the table's samples, {}x{}x32", own.width, own.height), directions, [&] { return make_beam_texture(table); },
            4U * own.cd.size()));
    }
    return diagram;
}

Interval timed(const std::function<void()>& work) {
    using Clock = std::chrono::steady_clock;
    constexpr double enough_s = 0.1;
    constexpr std::size_t fewest = 3, most = 25;
    std::vector<double> seconds;
    for (double sum = 0.0; seconds.size() < fewest || (sum < enough_s && seconds.size() < most); sum += seconds.back()) {
        const Clock::time_point start = Clock::now();
        work();
        seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
    return time_of(seconds).value();
}

} // namespace fernlicht
