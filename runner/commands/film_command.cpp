#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "renderer/technique.h"
#include "runner/commands/flag_values.h"
#include "runner/experiments/film/film_run.h"
#include "runner/files/film_file.h"
#include "runner/files/output_folder.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <tuple>

namespace fernlicht {
namespace {

constexpr int least_width_px = 160, least_height_px = 120, highest_rate = 1000;

/// The flags as typed.
struct FilmFlags {
    std::vector<std::filesystem::path> drives;
    FilmRequest request;
    std::vector<std::string> overlays, lamp_sets;
    double vertical_fov_deg = 0.0;
    std::string frames, rate, resolution, technique, aim, shadows;
    std::filesystem::path film;
    bool side_by_side = false, wipe = false, grid = false, force = false;
};

FilmOverlays overlays_of(const std::vector<std::string>& lists) {
    FilmOverlays overlays;
    if (lists.empty())
        return overlays;
    for (const std::string& item : items_of("--overlay", lists)) {
        bool* const one = item == "lux"        ? &overlays.lux
                          : item == "isolux"   ? &overlays.isolux
                          : item == "readings" ? &overlays.readings
                          : item == "speed"    ? &overlays.speed
                                               : (refuse_flag("--overlay", item, "some of lux, isolux, readings, speed"), nullptr);
        *one = true;
    }
    return overlays;
}

/// "25" or "30000/1001"
FrameRate rate_of(const std::string& text) {
    constexpr const char* expected = "frames a second, up to 1000: 25, or a fraction such as 30000/1001";
    const auto [frames, seconds] = two_numbers("--rate", text.find('/') == std::string::npos ? text + "/1" : text, '/', false, expected);
    if (frames < 1 || seconds < 1 || frames > seconds * std::int64_t{highest_rate})
        refuse_flag("--rate", text, expected);
    return {frames, seconds};
}

DriveEdits film_edits(const FilmFlags& flags) {
    DriveEdits edits;
    if (!flags.aim.empty())
        edits.aim = flags.aim == "auto"    ? BeamAim::automatic
                    : flags.aim == "as-is" ? BeamAim::as_is
                                           : (refuse_flag("--aim", flags.aim, "as-is or auto"), BeamAim::as_is);
    if (!flags.technique.empty())
        edits.technique = std::string(technique_named(flags.technique, {}, "--technique").name);
    if (!flags.shadows.empty())
        edits.shadows = name(shadow_method_named(flags.shadows, {}, "--shadows"));
    return edits;
}

FilmRequest request_of(const FilmFlags& flags) {
    FilmRequest request = flags.request;
    request.overlays = overlays_of(flags.overlays);
    request.arrangement = flags.side_by_side ? FilmArrangement::side_by_side
                          : flags.wipe       ? FilmArrangement::wipe
                          : flags.grid       ? FilmArrangement::grid
                                             : FilmArrangement::automatic;
    if (!flags.lamp_sets.empty())
        request.lamp_sets = items_of("--lamp-set", flags.lamp_sets);
    if (flags.vertical_fov_deg != 0.0) {
        if (!(flags.vertical_fov_deg >= 1.0 && flags.vertical_fov_deg <= 120.0))
            refuse_flag("--vertical-fov", fmt::format("{}", flags.vertical_fov_deg), "1 to 120 degrees");
        request.vertical_fov_rad = radians(flags.vertical_fov_deg);
    }
    request.rate = rate_of(flags.rate);
    request.frames = tick_range(flags.frames);
    std::tie(request.width_px, request.height_px) = resolution_of(flags.resolution);
    if (request.width_px < least_width_px || request.height_px < least_height_px || request.width_px % 2 != 0 || request.height_px % 2 != 0)
        refuse_flag("--resolution", flags.resolution, "even numbers from 160x120 on");
    return request;
}

/// Before anything is drawn: nobody waits for a film that cannot be written.
void check_film(const FilmFlags& flags, const TickRange& frames) {
    std::filesystem::path file = flags.film;
    if (film_kind(flags.film) == FilmKind::png)
        file = numbered_file_there(flags.film, frames.first, frames.last).value_or(numbered_file(flags.film, frames.first));
    refuse_existing("--film", file, flags.force);
    refuse_unwritable("--film", file, {}, flags.force);
}

int film(const FilmFlags& flags) {
    FilmRequest request = request_of(flags);
    check_film(flags, request.frames);
    for (const std::filesystem::path& file : flags.drives)
        request.drives.push_back(read_drive(file, film_edits(flags)));
    std::optional<FilmFile> file;
    request.begin = [&] { file.emplace(flags.film, request.width_px, request.height_px, request.rate); };
    request.take = [&](Image<plots::Colour> pixels, const plots::Drawing& marks, int number) {
        plots::draw_over(pixels, plots::svg_of(marks));
        file->add(mapped(pixels, [](const plots::Colour& c) { return Rgb8{c.r, c.g, c.b}; }), number);
    };
    const FilmFound found = run_film(request);
    file->finish();
    for (const std::string& note : found.notes)
        fmt::print("note: {}\n", note);
    if (!found.interrupted.empty())
        fmt::print("incomplete: {}: {} of {} frames\n", found.interrupted, found.filmed, found.planned);
    fmt::print("{}: {} frames, {:.3f} s\n", flags.film.string(), found.filmed, request.rate.time_s(found.filmed));
    return found.interrupted.empty() ? 0 : 1;
}

} // namespace

void add_film_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<FilmFlags>();
    CLI::App* sub = app.add_subcommand("film", "drives as a film: lamp sets beside one another, with lux and isolux lines");
    sub->add_option("DRIVE", flags->drives, "drive files (YAML), or storyboards (OpenSCENARIO, .xosc): a panel for each lamp set of each")
        ->required();
    sub->add_option("--film", flags->film, "FILE.webm, FILE.mp4 (both by ffmpeg), or NAME-%06d.png: a picture for each frame")->required();
    sub->add_flag("--force", flags->force, "replace a film that is there");
    CLI::Option* const beside = sub->add_flag("--side-by-side", flags->side_by_side, "two panels (default for two)");
    CLI::Option* const wipe =
        sub->add_flag("--wipe", flags->wipe, "one picture, its left half by the first lamp set, its right by the second");
    CLI::Option* const grid = sub->add_flag("--grid", flags->grid, "up to nine panels (default for more than two)");
    beside->excludes(wipe)->excludes(grid);
    wipe->excludes(grid);
    sub->add_option(
           "--overlay", flags->overlays,
           "what is told beside titles and time, separated by commas: lux (the road from above, with a scale), isolux (lines in the "
           "driver's view), readings (reach and width of the moment), speed")
        ->option_text("lux,isolux,readings,speed")
        ->allow_extra_args(false);
    sub->add_option("--lamp-set", flags->lamp_sets, "NAMES of lamp sets, separated by commas (default: all)")->allow_extra_args(false);
    flags->rate = "25";
    sub->add_option("--rate", flags->rate, "frames a second; a fraction, too: 30000/1001")->capture_default_str();
    sub->add_option("--frames", flags->frames, "FIRST:LAST: film these frames only, counted from 0");
    flags->resolution = "1280x720";
    sub->add_option("--resolution", flags->resolution, "WIDTHxHEIGHT of the film")->capture_default_str();
    sub->add_option("--vertical-fov", flags->vertical_fov_deg,
                    "vertical field of view in degrees, in place of the drive's: a smaller one shows more of what is far");
    sub->add_option("--aim", flags->aim, "in place of the drive's aim of low and high beams: as-is or auto")->option_text("as-is|auto");
    sub->add_option("--technique", flags->technique, "technique to light the scene with; `fernlicht techniques` lists them");
    sub->add_option("--shadows", flags->shadows, "shadow method; `fernlicht techniques` lists them");
    sub->add_option("--backend", flags->request.backend, backend_names);
    add_light_pass_flag(*sub, flags->request.light_pass);
    sub->add_flag("--quiet", flags->request.quiet, "show no progress");
    sub->footer("docs/film.md tells more.");
    sub->callback([flags, &chosen] { chosen = [flags] { return film(*flags); }; });
}

} // namespace fernlicht
