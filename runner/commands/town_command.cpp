#include "runner/commands/flag_values.h"
#include "runner/commands/model_command.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/town/town.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/files/picture_file.h"
#include "runner/findings/lux_figure.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>

namespace fernlicht {
namespace {

/// The flags as typed.
struct TownFlags {
    std::filesystem::path model;
    std::vector<double> at;
    std::optional<double> heading_deg;
    double yaw_deg = 0.0;
    std::string out;
    TownRequest request;
};

std::string town_text(const Model& model, const TownFound& found) {
    const glm::dvec3& p = found.car.position_m;
    std::string text = fmt::format("{}: x {:.0f} to {:.0f} m, y {:.0f} to {:.0f} m, {} triangles\n", model.name, model.low_m.x,
                                   model.high_m.x, model.low_m.y, model.high_m.y, model.triangles());
    text += fmt::format("car at {:.1f}, {:.1f}, {:.1f} m, heading {:.0f} degrees, free way of {:.0f} m\n\n", p.x, p.y, p.z,
                        std::round(degrees(found.heading_rad)) + 0.0, found.free_way_m);
    text += "lux on the ground\n  m ahead of the lamps   3 m left   straight ahead   3 m right\n";
    for (const TownFound::Row& row : found.rows) {
        const auto lux = [&](std::size_t i) { return row.ground_lx[i] ? fmt::format("{:.2f}", *row.ground_lx[i]) : "no ground"; };
        text += fmt::format("  {:>20} {:>10} {:>16} {:>11}\n", row.ahead_m, lux(0), lux(1), lux(2));
    }
    for (const MaterialDoubt& doubt : model.doubts)
        text += fmt::format("{}material {} {}\n", &doubt == &model.doubts.front() ? "\n" : "", model.materials[doubt.material].name,
                            doubt.text);
    return text;
}

int tell_town(const TownFlags& flags) {
    TownRequest request = flags.request;
    if (!flags.at.empty())
        request.at_m = glm::dvec2(flags.at[0], flags.at[1]);
    if (flags.heading_deg)
        request.heading_rad = radians(*flags.heading_deg);
    request.yaw_rad = radians(flags.yaw_deg);
    const Model model = read_model(flags.model);
    const TownFound found = look_at_town(model, request);
    OutputFolder made(result_folder(flags.out, model.name + "-night"));
    const std::filesystem::path& folder = made.path();
    write_png(found.view, folder / "driver.png");
    auto figure = lux_map_figure(found.map, fmt::format("{} in two lamps, {}", model.name, request.lamp));
    figure->subtitle = "lux on the ground; lines at 1, 3, 5, 10, 30 and 50 lx";
    write_file(folder / "lux.png", plots::png_of_svg(plots::svg_of(*figure, 0)));
    const std::string text = town_text(model, found);
    write_file(folder / "town.txt", text);
    if (!found.doubt.empty())
        tell(LogLevel::warning, found.doubt);
    made.finish();
    fmt::print("{}\n{}\n{}\n{}\n", text, (folder / "driver.png").string(), (folder / "lux.png").string(), (folder / "town.txt").string());
    return 0;
}

} // namespace

void add_town_command(CLI::App& app, std::function<int()>& chosen) {
    const auto flags = std::make_shared<TownFlags>();
    CLI::App* sub = app.add_subcommand("town", "render a model of streets at night in the light of a car, without a road");
    sub->add_option("MODEL", flags->model, "glTF: .gltf or .glb")->required();
    sub->add_option("--place", flags->at,
                    "place of the rear axle in the model, in metres, x along glTF's z (default: where the way ahead is longest, on any "
                    "side of the road)")
        ->option_text("X,Y")
        ->delimiter(',')
        ->expected(2);
    sub->add_option("--heading", flags->heading_deg,
                    "where the car looks, in degrees to the left of x (default: along the longest free way)")
        ->option_text("DEG")
        ->check(CLI::Range(-360.0, 360.0));
    add_shared(*sub, "--low-beams", flags->request.lamp)->capture_default_str();
    add_shared(*sub, "--yaw", flags->yaw_deg)->check(CLI::Range(-360.0, 360.0))->capture_default_str();
    sub->add_option("--metres-per-unit", flags->request.scale, "size of the file's unit")
        ->option_text("M")
        ->check(CLI::Range(1.0e-4, 1.0e4))
        ->capture_default_str();
    add_shared(*sub, "--technique", flags->request.technique)->capture_default_str();
    add_shared(*sub, "--backend", flags->request.backend)->capture_default_str();
    add_shared(*sub, "--out", flags->out);
    sub->footer("docs/models.md tells more.");
    sub->callback([flags, &chosen] { chosen = [flags] { return tell_town(*flags); }; });
}

} // namespace fernlicht
