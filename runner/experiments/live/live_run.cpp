#include "runner/experiments/live/live_run.h"

#include "renderer/renderer.h"
#include "runner/files/durable_files.h"
#include "runner/files/json_text.h"
#include "runner/files/output_folder.h"
#include "runner/findings/lamp_checks.h"
#include "runner/findings/run_context.h"
#include "runner/judge/input_hashes.h"
#include "runner/play/aim_lamps.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/live/live_drawing.h"
#include "runner/play/live/live_loop.h"
#include "runner/play/progress.h"
#include "runner/play/shadows/choose_shadows.h"
#include "scenarios/can/bus_mapping.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/bus_report.h"
#include "scenarios/drives/play/drive_log.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <thread>
#include <unistd.h>

namespace fernlicht {
namespace {

constexpr std::int64_t ahead_ns = 50'000'000; ///< for threads to come up

std::size_t live_lamp_set(const Drive& drive, const std::string& name) {
    std::string names;
    for (const LampSet& lamp_set : drive.lamp_sets)
        names += (names.empty() ? "" : ", ") + lamp_set.name;
    if (name.empty() && drive.lamp_sets.size() > 1)
        throw InputError({drive.file, 0, 0, "--lamp-set"}, fmt::format("found {} lamp sets", drive.lamp_sets.size()),
                         "the name of one: " + names);
    const auto found = name.empty() ? drive.lamp_sets.begin() : std::ranges::find(drive.lamp_sets, name, &LampSet::name);
    if (found == drive.lamp_sets.end())
        throw InputError({drive.file, 0, 0, "--lamp-set"}, fmt::format("found '{}'", printable(name)), "a lamp set of the drive: " + names);
    return static_cast<std::size_t>(found - drive.lamp_sets.begin());
}

/// The mapping with another channel or recording.
template <class Change> void change_mapping(Drive& drive, const Change& change) {
    BusMapping mapping = *drive.can;
    change(mapping);
    drive.can = std::make_shared<const BusMapping>(std::move(mapping));
}

/// A live drive's parts, from reading to report.
class LiveSession {
  public:
    LiveSession(Drive drive, const LiveOptions& options) : options_(options), stage_(staged(std::move(drive), options)) {
        lamp_set_ = live_lamp_set(stage_.drive, options.lamp_set);
        if (!options.log.empty())
            recorded_ = read_bus_recording(stage_.drive, options.log, start_ns_);
        play_.emplace(stage_.drive, stage_.route, lamp_set_);
        if (options.log.empty())
            socket_ = {options.interface, play_->identifiers(), options.receive_buffer_bytes};
    }

    Report play();

  private:
    static Drive staged(Drive drive, const LiveOptions& options) {
        if (!drive.can)
            throw InputError({drive.file, 0, 0, "can"}, "found none", "the key `can`, which ties signals of a bus to lamps (docs/can.md)");
        refuse_auto_shadows(drive);
        drive.live = true;
        change_mapping(drive, [&](BusMapping& mapping) {
            mapping.scripted = false;
            mapping.log.reset();
            if (options.log.empty())
                mapping.channel = options.interface;
        });
        return drive;
    }

    const LampSet& lamp_set() const { return stage_.drive.lamp_sets[lamp_set_]; }
    std::string file(const char* what, const char* extension) const {
        return fmt::format("{}-{}{}", what, file_name_of(stage_.drive.name + "-" + lamp_set().name), extension);
    }
    LiveFigures new_figures() const;
    void drive_on(LiveFigures& figures);
    PlayedCell result(const LiveFigures& figures);
    void write_replay(LiveFigures& figures);

    const LiveOptions& options_;
    Stage stage_;
    std::size_t lamp_set_ = 0;
    std::vector<CanFrame> recorded_;
    std::int64_t start_ns_ = 0;
    std::optional<BusDrive> play_;
    CanSocketOptions socket_;
    std::optional<Device> device_;
    std::optional<LiveDrawing> drawing_;
    bool interrupted_ = false;
    std::exception_ptr failure_;
};

LiveFigures LiveSession::new_figures() const {
    LiveFigures figures;
    figures.interface = options_.interface;
    figures.log = options_.log;
    figures.waited = options_.wait;
    figures.period_s = play_->period_s();
    figures.ticks_planned = static_cast<std::uint64_t>(std::ceil(stage_.drive.duration_s / figures.period_s - 1e-9));
    figures.listened_s = options_.log.empty() ? options_.listen_s : 0.0;
    figures.recording =
        options_.record.empty() ? std::filesystem::path(file("can-in", ".log")) : std::filesystem::absolute(options_.record);
    figures.drawing = options_.draw;
    return figures;
}

/// The control thread drives, this one draws.
void LiveSession::drive_on(LiveFigures& figures) {
    LiveBus bus = options_.log.empty() ? live_bus_of(socket_) : live_bus_of(std::move(recorded_));
    const auto listen_ns = std::llround(1e9 * figures.listened_s);
    TickClock clock(ahead_ns + listen_ns);
    figures.start_ns = options_.log.empty() ? clock.start_realtime_ns() : start_ns_;
    LogWriter recording(options_.folder / figures.recording, figures.start_ns);
    LogWriter sent(options_.folder / file("can", ".log"), figures.start_ns);
    LivePictures pictures;
    LiveLoop loop({stage_.drive, *play_, bus, clock, recording, sent, drawing_ ? &pictures : nullptr,
                   [] { return Interruption::requested(); }, options_.wait, listen_ns});
    std::exception_ptr undrawn;
    std::thread control([&] {
        if (options_.wait)
            figures.punctuality = be_punctual();
        try {
            loop.run(figures);
        } catch (...) {
            failure_ = std::current_exception();
        }
    });
    try {
        if (drawing_)
            drawing_->draw_all(pictures);
    } catch (...) {
        undrawn = std::current_exception();
    }
    control.join();
    if (!failure_)
        failure_ = undrawn;
    recording.finish();
    sent.finish();
    figures.recorded = recording.written();
    figures.not_recorded = recording.left_out();
    interrupted_ = loop.was_interrupted();
    if (drawing_) {
        figures.drawn = drawing_->drawn();
        figures.captured = drawing_->captured();
    }
}

/// The drive as it was, with its recording for a bus: what `fernlicht run` plays again.
void LiveSession::write_replay(LiveFigures& figures) {
    Drive replayed = stage_.drive;
    replayed.lamp_sets = {lamp_set()}; // the others were not driven
    change_mapping(replayed, [&](BusMapping& mapping) {
        mapping.log = figures.recording; // beside the drive's file, wherever the folder goes
        mapping.start_ns = figures.start_ns;
    });
    const std::filesystem::path drive_file = options_.folder / (file_name_of(replayed.name) + ".yaml");
    write_file(drive_file, write_drive(replayed));
    figures.replay = shell_quoted({"fernlicht", "run", drive_file.string(), "--can-log", (options_.folder / figures.recording).string(),
                                   "--can-start", candump_stamp(figures.start_ns)});
}

PlayedCell LiveSession::result(const LiveFigures& figures) {
    const Drive& drive = stage_.drive;
    PlayedCell played;
    played.drive = drive.name;
    played.title = drive.title;
    played.lamp_set = lamp_set().name;
    played.technique = drive.technique;
    for (const MountedLamp& lamp : lamp_set().lamps)
        played.lamps.emplace_back(lamp.name, lamp.file->name);
    played.aims = lamp_aims(lamp_set());
    played.ticks_planned = tick_count(drive);
    played.ticks_done = figures.moments;
    played.notes = drive.notes;
    if (!figures.late_s.empty()) {
        for (int tick = 0; tick < tick_count(drive); ++tick) {
            const State state = state_at(tick, drive);
            played.speed_mps.emplace_back(state.time_s, state.speed_mps);
        }
        played.bus = bus_report(drive, lamp_set(), 0, tick_count(drive) - 1);
        const std::vector<std::string>& notes = lamp_set().motion->notes;
        played.notes.insert(played.notes.end(), notes.begin(), notes.end());
    }
    played.notes.emplace_back(
        "a live drive measures punctuality and loss; reach, glare and costs are measured when its recording is played");
    if (drawing_) {
        played.rendering_settings = std::make_shared<const RenderingSettings>(rendering_settings(drive));
        drawing_->finish(played);
    }
    return played;
}

Report LiveSession::play() {
    if (!options_.record.empty())
        refuse_unwritable("--record", options_.record, options_.folder);
    if (options_.log.empty())
        CanSocket probe(socket_); // refused before anything is drawn or written
    if (options_.draw) {
        device_.emplace(open_device(options_.backend));
        check_sanity(*device_);
    }
    OutputFolder folder(options_.folder);
    if (options_.draw)
        drawing_.emplace(stage_, lamp_set(), *device_, options_.folder);
    Report report;
    report.context = make_context(device_ ? device_->info() : DeviceInfo{}, options_.command, stage_.drive.seed);
    add_inputs(report.context.inputs, stage_.drive.opened);
    add_inputs(report.context.inputs, stage_.network.opened);
    const auto figures = std::make_shared<LiveFigures>(new_figures());
    const Interruption listening;
    drive_on(*figures);
    if (!figures->late_s.empty()) {
        play_->finish();
        if (const auto& control = lamp_set().motion->control; control && control->unusable && !failure_)
            failure_ = std::make_exception_ptr(*control->unusable);
        write_replay(*figures);
        if (lamp_set().motion->control)
            write_file(options_.folder / file("signals", ".csv"),
                       signals_csv(stage_.drive, *lamp_set().motion->control, 0, tick_count(stage_.drive) - 1));
    }
    report.live = figures;
    LampFileChecks lamps;
    lamps.add(stage_.drive, left_hand_traffic(stage_));
    report.lamp_files = lamps.files();
    report.warnings = lamp_warnings(report.lamp_files);
    if (stage_.drive.bus)
        std::ranges::copy(bus_warnings(stage_.drive), std::back_inserter(report.warnings));
    report.played.push_back(result(*figures));
    for (const std::string& warning : aim_warnings(report.played.back().lamp_set, report.played.back().aims))
        report.warnings.push_back(fmt::format("{}: {}", stage_.drive.name, warning));
    write_file(options_.folder / "live.json", json_text(live_json(*figures)));
    if (interrupted_) {
        report.complete = false;
        report.interrupted = Interruption::words();
    }
    try {
        if (failure_)
            std::rethrow_exception(failure_);
    } catch (const std::exception& error) {
        report.complete = false;
        report.interrupted = error.what();
    }
    options_.write(report);
    if (failure_)
        std::rethrow_exception(failure_);
    if (report.complete)
        folder.finish();
    return report;
}

} // namespace

Report run_live(Drive drive, const LiveOptions& options) { return LiveSession(std::move(drive), options).play(); }

} // namespace fernlicht
