#include "runner/experiments/run/run_drives.h"
#include "runner/experiments/run/run_report.h"

#include "renderer/renderer.h"
#include "runner/experiments/accuracy/drive_error.h"
#include "runner/experiments/bench/contact_sheet.h"
#include "runner/experiments/run/display_sheet.h"
#include "runner/experiments/run/run_judging.h"
#include "runner/experiments/run/run_notes.h"
#include "runner/experiments/run/run_plots.h"
#include "runner/experiments/run/savings.h"
#include "runner/experiments/shadows/moment_sheet.h"
#include "runner/files/log.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/findings/summary.h"
#include "runner/judge/input_hashes.h"
#include "runner/judge/repeats.h"
#include "runner/play/aim_lamps.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/preparation.h"
#include "runner/play/progress.h"
#include "runner/play/series_play.h"
#include "runner/play/shadows/choose_shadows.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/bus_recording.h"
#include "scenarios/drives/play/bus_report.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <cerrno>
#include <deque>
#include <fmt/format.h>
#include <fstream>
#include <malloc.h>
#include <optional>
#include <span>
#include <utility>

namespace fernlicht {
namespace {

/// Of what is done to one drive, and to one of its lamp sets ("" for all).
void tell_which(TraceSpan& span, const Stage& stage, const std::string& lamp_set = {}) {
    if (!span)
        return;
    span.tell("drive", stage.drive.name);
    if (!lamp_set.empty())
        span.tell("lamp set", lamp_set);
}

/// Plays one lamp set and completes it with readings and verdicts.
PlayedCell play_lamp_set(const Stage& stage, const LampSet& lamp_set, Renderer& renderer, const RunOptions& options, Writers& writers,
                         std::ostream* log = nullptr) {
    TraceSpan span("lamp set", "run");
    tell_which(span, stage, lamp_set.name);
    prepare(renderer, stage.drive, stage.route, lamp_set, options.ticks,
            options.no_times.empty() ? Foreseen::timed_pictures : Foreseen::stored_pictures);
    const int compiled = renderer.compiled_programs();
    const Renderer::ShadowMapsUsed maps_before = renderer.shadow_maps_used();
    const Renderer::LightPassesUsed lit_before = renderer.light_passes_used();
    const std::string label = stage.drive.name + ", " + lamp_set.name;
    Progress progress(label, ticks_to_play(stage.drive, options.ticks), options.quiet);
    PlayOptions play_options;
    play_options.log = log;
    play_options.ticks = options.ticks;
    play_options.folder = options.folder;
    play_options.profile = options.profile;
    play_options.no_times = options.no_times;
    play_options.go_on = [&](int done) {
        progress.done(done);
        return !Interruption::requested();
    };
    Renderer::ShadowMapsUsed first; // of the moments' first pictures: what stands then is an earlier moment's
    int last_seen_tick = -1;
    const Draw draw = [&](const Moment& moment, const View& view, const FrameOutputs& outputs) {
        const Renderer::ShadowMapsUsed before = renderer.shadow_maps_used();
        Pending frame = renderer.submit(moment, view, outputs);
        if (const Renderer::ShadowMapsUsed after = renderer.shadow_maps_used(); std::exchange(last_seen_tick, moment.tick) != moment.tick) {
            first.used += after.used - before.used;
            first.drawn += after.drawn - before.drawn;
        }
        return frame;
    };
    PlayedCell played = play(stage.drive, stage.route, lamp_set, play_options, draw, writers);
    played.aims = lamp_aims(lamp_set);
    const int last_tick = std::min(options.ticks.last, tick_count(stage.drive) - 1);
    played.bus = bus_report(stage.drive, lamp_set, std::max(0, options.ticks.first), last_tick);
    played.input_hashes = input_hashes(stage.drive, lamp_set, stage.network.opened, std::max(0, options.ticks.first), last_tick);
    if (const int late = renderer.compiled_programs() - compiled; late > 0)
        played.notes.push_back(
            fmt::format("{} shader variants were compiled during the drive: times of their first frames include that", late));
    for (const PrunedFeature& left : renderer.pruned())
        played.left_out.push_back(left.what + ": " + left.why);
    const Renderer::LightPassesUsed lit = renderer.light_passes_used();
    if (lit.cpu > lit_before.cpu) // what it read is compared with what was lit so
        played.input_hashes.emplace_back("light pass", light_pass_name(LightPass::cpu));
    if (const long long by_cpu = lit.cpu - lit_before.cpu, by_shader = lit.shader - lit_before.shader; by_shader == 0 && by_cpu > 0)
        played.left_out.emplace_back("light by the fragment shader: the CPU lights each visible pixel once");
    else if (by_shader > 0 && !lit.why_shader.empty())
        played.left_out.push_back(fmt::format("light on the CPU, in {} of {} pictures: {}", by_shader, by_cpu + by_shader, lit.why_shader));
    const Renderer::ShadowMapsUsed maps = renderer.shadow_maps_used();
    if (const long long kept = (maps.used - maps_before.used) - (maps.drawn - maps_before.drawn); kept > 0)
        played.left_out.push_back(
            fmt::format("rendering {} of the {} shadow maps that pictures looked up: they stood from a picture before, "
                        "as pictures of one moment share theirs; of the {} that the first pictures of moments looked "
                        "up, {} stood from an earlier moment",
                        kept, maps.used - maps_before.used, first.used, first.used - first.drawn));
    if (const double bound = stage.drive.shadows.redraw_texels; bound > 0.0 && first.used > 0 && first.used == first.drawn)
        played.notes.push_back(
            fmt::format("shadows: redraw_texels {:g}: none of the {} shadow maps that the first pictures of moments looked up stood, as "
                        "edges moved by more from each moment to the next",
                        bound, first.used));
    std::ranges::copy(notes_for(stage, lamp_set, renderer), std::back_inserter(played.notes));
    if (stage.drive.extent)
        played.extent_summaries = summarise_extents(played, *stage.drive.extent);
    std::ranges::copy(extent_readings(played), std::back_inserter(played.readings));
    if (stage.drive.seeing.tolerances && !Interruption::requested()) {
        const TraceSpan series("cars of a series", "measure");
        std::optional<Progress> cars;
        played.series = std::make_shared<const SeriesFindings>(
            play_series(stage.drive, stage.route, lamp_set, options.ticks, played.readings, draw, [&](std::size_t done, std::size_t all) {
                if (!cars)
                    cars.emplace(label, static_cast<int>(all), options.quiet, "cars");
                cars->done(static_cast<int>(done));
                return !Interruption::requested();
            }));
        if (!played.series->parts.empty())
            std::ranges::move(readings_of(*played.series), std::back_inserter(played.readings));
        if (played.series->parts.empty())
            played.notes.emplace_back("tolerances: nothing varies from car to car: all are 0");
        if (played.series->parts.empty() || played.series->readings.empty()) // or interrupted
            played.series = nullptr;
    }
    if (options.judged)
        played.verdicts = limit_verdicts(stage.drive, played);
    if (const Technique& technique = renderer.technique(); technique.kind != TechniqueKind::ours) {
        played.title = lit_title(played.title, stage.drive.technique);
        played.notes.push_back(
            fmt::format("lit by technique {}, which ignores: {}. Rendered figures are that technique's; those of the twin, their "
                        "sensitivity to aim and flux, and the grid's error are computed from the candela tables",
                        technique.name, technique.ignores));
    }
    return played;
}

/// After all is played: the renderer that leaves nothing out takes memory of its own.
void add_savings(const Stage& stage, Device& device, const RendererSettings& settings, const RunOptions& options, Renderer& renderer,
                 std::span<PlayedCell> played) {
    TraceSpan span("savings by pruning", "run");
    tell_which(span, stage);
    std::optional<Renderer> unpruned;
    for (std::size_t i = 0; i < played.size() && !Interruption::requested(); ++i) {
        PruningSavings& savings = played[i].savings;
        savings.not_measured = options.profile ? "the run timed each pass" : no_savings(stage.drive, played[i]);
        if (!savings.not_measured.empty())
            continue;
        if (!unpruned) {
            RendererSettings all_in = settings_for(stage.drive, settings);
            all_in.technique = unpruned_technique;
            unpruned.emplace(device, stage.scene, all_in);
        }
        try {
            savings = measure_savings(stage, stage.drive.lamp_sets[i], played[i], std::max(0, options.ticks.first), renderer, *unpruned);
        } catch (const InputError& error) { // more than the unpruned technique can draw
            savings = {};
            savings.not_measured = error.what();
        }
    }
}

/// By the renderer that played: what it drew is what is measured.
void add_errors(const Stage& stage, const RunOptions& options, Renderer& renderer, std::span<PlayedCell> played) {
    TraceSpan span("accuracy", "run");
    tell_which(span, stage);
    for (std::size_t i = 0; i < played.size() && !Interruption::requested(); ++i) {
        DriveError& error = played[i].error;
        error.not_measured = no_drive_error(stage.drive, played[i]);
        if (error.not_measured.empty())
            error = measure_drive_error(stage, stage.drive.lamp_sets[i], played[i], std::max(0, options.ticks.first), renderer);
    }
}

/// The middle one of the captured moments, else of those played.
int middle_tick(const PlayedCell& played, int first_tick) {
    std::vector<int> captured;
    for (const StoredFrame& frame : played.frames)
        if (captured.empty() || captured.back() != frame.tick)
            captured.push_back(frame.tick);
    return captured.empty() ? first_tick + played.ticks_done / 2 : captured[captured.size() / 2];
}

void add_contact_sheets(const Stage& stage, Device& device, const RendererSettings& settings, const RunOptions& options,
                        std::span<PlayedCell> played) {
    TraceSpan span("contact sheets", "run");
    tell_which(span, stage);
    std::vector<ContactSheet> sheets;
    for (std::size_t i = 0; i < played.size(); ++i) {
        const LampSet& lamp_set = stage.drive.lamp_sets[i];
        const int tick = middle_tick(played[i], std::max(0, options.ticks.first));
        sheets.push_back(new_sheet(stage, lamp_set, moments_at({tick}, stage, lamp_set).front()));
    }
    RendererSettings plain = settings_for(stage.drive, settings);
    plain.profile = false;
    add_all_techniques(sheets, stage, device, plain);
    for (std::size_t i = 0; i < played.size(); ++i) {
        const ContactSheet& sheet = sheets[i];
        const LampSet& lamp_set = stage.drive.lamp_sets[i];
        const auto stored = [&](const char* kind, decltype(Plot::figure) drawn) {
            const std::string name = kind + ("-" + file_name_of(sheet.drive + "-" + sheet.lamp_set));
            options.write_plot({.name = name, .figure = std::move(drawn), .png_alone = true});
            return StoredFrame{sheet.moment.tick, sheet.moment.time_s, "driver", name + ".png", ""};
        };
        const auto left_out = [&](const std::string& what, const std::string& why) {
            played[i].notes.push_back(fmt::format("the moment {} is left out: {}", what, why));
        };
        const auto add_sheet = [&](const std::string& what, const char* kind, const auto& drawn) {
            try {
                if (std::optional<TileSheet> tiles = drawn())
                    played[i].more_sheets.push_back({what, stored(kind, std::move(*tiles))});
            } catch (const InputError& error) { // more than a method can draw
                left_out(what, error.what());
            }
        };
        for (const SheetTile& tile : sheet.tiles)
            if (!tile.not_drawn.empty())
                left_out(fmt::format("in technique {}", tile.row.name), tile.not_drawn);
        played[i].contact_sheet = stored("contact-sheet", contact_sheet(sheet).figure);
        add_sheet("by every tone mapper and eye", "display-sheet", [&] {
            const DisplaySheet shown = display_sheet(stage, lamp_set, sheet.moment, device, plain);
            return shown.mappers.empty() ? std::nullopt : std::optional(tiles_of(shown));
        });
        if (plain.technique == "photometric")
            add_sheet("in every shadow method", "shadow-sheet",
                      [&] { return std::optional(shadow_sheet(shadow_moment(stage, lamp_set, sheet.moment, device, plain))); });
    }
}

/// Which pixels of its lamps were dark when, for spreadsheets and as pictures.
void write_levels(const PlayedCell& played, const RunOptions& options) {
    if (played.pixel_levels.empty())
        return;
    write_file(options.folder / (levels_name(played) + ".csv"), levels_csv(played.pixel_levels));
    for (const Plot& plot : options.write_plot ? level_plots(played) : std::vector<Plot>{})
        options.write_plot(plot);
}

void run_drive(Stage& stage, Device& device, const RendererSettings& settings, const RunOptions& options, Report& report) {
    TraceSpan span("drive", "run");
    tell_which(span, stage);
    std::shared_ptr<const ShadowChoice> shadows;
    {
        const TraceSpan choosing("choose shadows and exposure", "run");
        if (const auto chosen = choose_shadows(stage, device, settings_for(stage.drive, settings)))
            shadows = std::make_shared<const ShadowChoice>(*chosen);
        fit_tone_mapper(stage, device, settings_for(stage.drive, settings));
    }
    write_file(options.folder / (file_name_of(stage.drive.name) + ".yaml"), write_drive(stage.drive));
    add_inputs(report.context.inputs, stage.drive.opened);
    add_inputs(report.context.inputs, stage.network.opened);
    Renderer renderer(device, stage.scene, settings_for(stage.drive, settings));
    Writers writers;
    const std::size_t before = report.played.size();
    const std::filesystem::path log_file = options.folder / ("drive-log-" + file_name_of(stage.drive.name) + ".csv");
    std::ofstream log(log_file, std::ios::binary);
    log << drive_log_header << '\n';
    for (const LampSet& lamp_set : stage.drive.lamp_sets) {
        report.played.push_back(play_lamp_set(stage, lamp_set, renderer, options, writers, &log));
        report.played.back().shadows = shadows;
        if (lamp_set.motion && lamp_set.motion->control)
            write_file(options.folder / ("signals-" + file_name_of(stage.drive.name + "-" + lamp_set.name) + ".csv"),
                       signals_csv(stage.drive, *lamp_set.motion->control, options.ticks.first, options.ticks.last));
        write_levels(report.played.back(), options);
        if (const std::string sent = output_log(stage.drive, lamp_set); !sent.empty())
            write_file(options.folder / ("can-" + file_name_of(stage.drive.name + "-" + lamp_set.name) + ".log"), sent);
        if (!log.flush())
            throw DeviceError(log_file.string() + ": cannot be written: " + std::generic_category().message(errno));
        if (Interruption::requested()) {
            report.complete = false;
            report.interrupted = Interruption::words();
            return;
        }
    }
    const auto played = std::span(report.played).subspan(before);
    ::malloc_trim(0); // what compiling shaders and playing left behind would stand beside what measuring errors takes
    add_savings(stage, device, settings, options, renderer, played);
    ::malloc_trim(0);
    if (options.accuracy)
        add_errors(stage, options, renderer, played);
    if (options.contact_sheet && !Interruption::requested())
        add_contact_sheets(stage, device, settings, options, played);
}

/// What the frames of a further play take: gone where they are those of the first play, kept to be looked at where they are not.
void remove_frames(const PlayedCell& again, const std::filesystem::path& folder) {
    std::error_code ignored;
    for (const StoredFrame& frame : again.frames)
        for (const std::string* const path : {&frame.exr, &frame.png})
            if (!path->empty())
                std::filesystem::remove(folder / *path, ignored);
    for (const StoredFrame& frame : again.frames) // folders go when they are empty
        for (std::filesystem::path path = frame.exr.empty() ? frame.png : frame.exr; path.has_parent_path(); path = path.parent_path())
            std::filesystem::remove(folder / path.parent_path(), ignored);
    std::filesystem::remove(folder, ignored);
    std::filesystem::remove(folder.parent_path(), ignored);
}

/// A drive's lamp sets once more, by a renderer of its own. Backwards: what one lamp set or drive may leave behind in the driver meets
/// another.
void repeat_drive(const Stage& stage, Device& device, const RendererSettings& settings, const RunOptions& options,
                  std::span<RepeatFold> folds, bool backwards) {
    Renderer renderer(device, stage.scene, settings_for(stage.drive, settings));
    Writers writers;
    for (std::size_t i = 0; i < folds.size() && !Interruption::requested(); ++i) {
        const std::size_t at = backwards ? folds.size() - 1 - i : i;
        const PlayedCell again = play_lamp_set(stage, stage.drive.lamp_sets[at], renderer, options, writers);
        if (!Interruption::requested() && folds[at].add(again, options.folder))
            remove_frames(again, options.folder);
    }
}

/// Plays everything again, by turns backwards and forwards, and says what differs.
void repeat(const std::deque<Stage>& stages, Device& device, const RendererSettings& settings, const RunOptions& options, Report& report) {
    std::vector<RepeatFold> folds;
    for (const PlayedCell& played : report.played)
        folds.emplace_back(played, options.folder, played_json);
    std::vector<std::span<RepeatFold>> by_drive;
    std::size_t first = 0;
    for (const Stage& stage : stages) {
        by_drive.push_back(std::span(folds).subspan(first, stage.drive.lamp_sets.size()));
        first += stage.drive.lamp_sets.size();
    }
    for (int play = 2; play <= options.repeats && !Interruption::requested(); ++play) {
        RunOptions again = options;
        again.folder = options.folder / "repeats" / fmt::format("{}", play);
        const bool backwards = play % 2 == 0;
        for (std::size_t i = 0; i < stages.size() && !Interruption::requested(); ++i) {
            const std::size_t at = backwards ? stages.size() - 1 - i : i;
            repeat_drive(stages[at], device, settings, again, by_drive[at], backwards);
        }
    }
    for (std::size_t i = 0; i < folds.size(); ++i)
        folds[i].finish(report.played[i], options.repeats);
    if (Interruption::requested()) {
        report.complete = false;
        report.interrupted = Interruption::words();
    }
}

} // namespace

Report run_drives(const std::vector<Drive>& drives, const RunOptions& options) {
    std::deque<Stage> stages; // everything is read and checked before the first frame; a route points into its own network
    for (const Drive& drive : drives) {
        const TraceSpan span("read road, make scene", "run");
        stages.emplace_back(drive);
    }
    for (const Stage& stage : stages)
        if (ticks_to_play(stage.drive, options.ticks) == 0)
            throw InputError({stage.drive.file, 0, 0, "--frames"}, fmt::format("found a range from {} on", options.ticks.first),
                             fmt::format("moments of the drive, which has 0 to {}", tick_count(stage.drive) - 1));
    for (const Stage& stage : stages)
        if (options.contact_sheet && !driver_view(stage.drive))
            throw InputError({stage.drive.file, 0, 0, "views"}, "found only maps", "a perspective view for --contact-sheet");
    LampFileChecks lamps;
    for (const Stage& stage : stages)
        lamps.add(stage.drive, left_hand_traffic(stage));
    if (options.strict)
        lamps.refuse_meaningless();
    std::optional<TraceSpan> opening(std::in_place, "open device", "run");
    Device device = open_device(options.backend);
    check_sanity(device);
    RendererSettings settings = settings_for(device, options.profile);
    settings.light_pass = options.light_pass;
    opening.reset();
    tell(LogLevel::debug, fmt::format("rendering by {}, {}", device.info().backend, device.info().gl_renderer),
         {{"backend", device.info().backend}, {"renderer", device.info().gl_renderer}});
    for (const Stage& stage : stages)
        check_planar_shadows(stage, device, options.ticks);
    OutputFolder folder(options.folder); // only now: bad input or a machine that cannot draw leaves no folder behind
    Report report;
    report.context = make_context(device.info(), options.command, drives.front().seed);
    report.lamp_files = lamps.files();
    report.warnings = lamp_warnings(report.lamp_files);
    const Interruption listening;
    std::exception_ptr failure;
    try {
        for (Stage& stage : stages)
            if (report.complete)
                run_drive(stage, device, settings, options, report);
        if (options.repeats > 1 && report.complete)
            repeat(stages, device, settings, options, report);
        if (options.judged)
            judge_whole(report, options);
    } catch (const std::exception& error) {
        report.complete = false;
        report.interrupted = error.what();
        failure = std::current_exception();
    }
    add_warnings(stages, drives, options.ticks, report);
    add_reruns(drives, options, report);
    {
        const TraceSpan span("write report", "write");
        options.write(report, options.folder);
    }
    if (failure)
        std::rethrow_exception(failure);
    if (report.complete)
        folder.finish();
    return report;
}

void refuse_equal_names(const std::vector<Drive>& drives) {
    for (std::size_t i = 0; i < drives.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (drives[i].name == drives[k].name)
                throw InputError({drives[i].file, 0, 0, "name"},
                                 "found '" + printable(drives[i].name) + "', as in " + drives[k].file.string(),
                                 "a name of its own for each drive of a run");
}

} // namespace fernlicht
