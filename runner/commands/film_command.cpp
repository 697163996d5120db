#include "runner/commands/commands.h"

#include "renderer/device.h"
#include "renderer/technique.h"
#include "runner/commands/flag_values.h"
#include "runner/commands/words/shared_flags.h"
#include "runner/experiments/film/film_run.h"
#include "runner/files/film_file.h"
#include "runner/files/log.h"
#include "runner/findings/figures.h"
#include "runner/write/plots/svg.h"
#include "scenarios/values/errors.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <limits>
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
    std::string frames, rate, resolution, technique, aim, shadows, dressing;
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
    if (text.find_first_not_of("0123456789/") != std::string::npos || text.starts_with('/'))
        refuse_flag("--rate", text, expected);
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
                                           : (refuse_flag("--aim", flags.aim, aim_expected), BeamAim::as_is);
    if (!flags.technique.empty())
        edits.technique = std::string(technique_named(flags.technique, {}, "--technique").name);
    set_dressing(edits, flags.dressing);
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
        request.lamp_sets = items_of("--lamp-sets", flags.lamp_sets);
    for (const std::string& name : request.lamp_sets)
        if (std::ranges::count(request.lamp_sets, name) > 1)
            refuse_flag("--lamp-sets", name + " twice", "each lamp set once");
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
    check_target("--film", file, flags.force);
}

int film(const FilmFlags& flags) {
    FilmRequest request = request_of(flags);
    for (const std::filesystem::path& file : flags.drives)
        request.drives.push_back(read_drive(named_file("drive", file, "DRIVE"), film_edits(flags)));
    check_film(flags, request.frames);
    std::optional<FilmFile> file;
    request.begin = [&] { file.emplace(flags.film, request.width_px, request.height_px, request.rate); };
    request.take = [&](Image<plots::Colour> pixels, const plots::Drawing& marks, int number) {
        plots::draw_over(pixels, plots::svg_of(marks));
        file->add(mapped(pixels, [](const plots::Colour& c) { return Rgb8{c.r, c.g, c.b}; }), number);
    };
    const FilmFound found = run_film(request);
    file->finish();
    if (film_kind(flags.film) == FilmKind::png)
        if (const auto rest = numbered_file_there(flags.film, request.frames.first + found.filmed, std::numeric_limits<int>::max()))
            tell(LogLevel::warning, fmt::format("{} and what follows it are pictures of an earlier film", printable(rest->string(), 400)));
    for (const std::string& note : found.notes)
        tell(LogLevel::info, note);
    if (!found.interrupted.empty())
        tell(LogLevel::warning, fmt::format("incomplete: {}: {} of {} frames", found.interrupted, found.filmed, found.planned));
    fmt::print("{}: {}, {:.3f} s\n", flags.film.string(), counted(static_cast<std::size_t>(found.filmed), "frame"),
               request.rate.time_s(found.filmed));
    return found.interrupted.empty() ? 0 : 1;
}

} // namespace

void add_film_command(CLI::App& app, const std::vector<std::string>&, std::function<int()>& chosen) {
    const auto flags = std::make_shared<FilmFlags>();
    CLI::App* sub = app.add_subcommand("film", "film drives: lamp sets beside one another, with lux and isolux lines");
    add_shared(*sub, "DRIVES", flags->drives)->required();
    sub->add_option("--film", flags->film, "new file: NAME.webm or NAME.mp4, both by ffmpeg, or NAME-%06d.png, a picture for each frame")
        ->option_text("FILE")
        ->required();
    add_shared(*sub, "--force", flags->force);
    CLI::Option* const beside = sub->add_flag("--side-by-side", flags->side_by_side, "two panels (default for two)");
    CLI::Option* const wipe =
        sub->add_flag("--wipe", flags->wipe, "one picture, its left half by the first lamp set, its right by the second");
    CLI::Option* const grid = sub->add_flag("--grid", flags->grid, "up to nine panels (default for more than two)");
    beside->excludes(wipe)->excludes(grid);
    wipe->excludes(grid);
    sub->add_option("--overlay", flags->overlays,
                    "show these, too: lux (the road from above, with a scale), isolux (lines in the driver's view), readings (reach and "
                    "width of the moment), speed")
        ->option_text("NAME,...")
        ->allow_extra_args(false);
    sub->add_option("--lamp-sets", flags->lamp_sets, "film these lamp sets alone")
        ->option_text("NAME,...")
        ->allow_extra_args(false)
        ->default_str("all");
    flags->rate = "25";
    add_shared(*sub, "--rate", flags->rate)->capture_default_str();
    add_shared(*sub, "--frames", flags->frames);
    flags->resolution = "1280x720";
    add_shared(*sub, "--resolution", flags->resolution)->capture_default_str();
    add_shared(*sub, "--vertical-fov", flags->vertical_fov_deg)->default_str("the drive's");
    add_shared(*sub, "--aim", flags->aim);
    add_shared(*sub, "--technique", flags->technique);
    add_shared(*sub, "--shadows", flags->shadows);
    add_shared(*sub, "--dressing", flags->dressing);
    add_shared(*sub, "--backend", flags->request.backend);
    add_light_pass_flag(*sub, flags->request.light_pass);
    add_shared(*sub, "--quiet", flags->request.quiet);
    sub->footer("Each lamp set of each drive has a panel; the size is the film's, and so are the pictures that --frames counts; a rate may "
                "be a fraction: 30000/1001. docs/film.md tells "
                "more.");
    sub->callback([flags, &chosen] { chosen = [flags] { return film(*flags); }; });
}

} // namespace fernlicht
