#include "runner/play/play.h"

#include "metrics/folds/sensitivity_fold.h"
#include "runner/findings/lux_codes.h"
#include "runner/play/display_pipeline.h"
#include "runner/play/extent_fold.h"
#include "runner/play/frame_times.h"
#include "runner/play/level_fold.h"
#include "runner/play/lux_map.h"
#include "runner/play/preparation.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/drive_log.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/values/trace.h"

#include <algorithm>
#include <fmt/format.h>
#include <future>

namespace fernlicht {
namespace {

constexpr int lux_view_px = 256; ///< across, of what the page shows under the pointer

/// Draws the views of a moment: all of them where it is captured, else the driver's; then hands to the writers what is stored.
class Pictures {
  public:
    Pictures(const Drive& drive, const Route& route, const PlayOptions& options, PlayedCell& played, Writers& writers, FrameTimes& times)
        : drive_(drive), route_(route), options_(options), played_(played), writers_(writers), times_(times),
          maps_(captured_moments(drive, options.ticks)), lux_views_(captured_moments(drive, options.ticks)), display_(drive) {}

    /// "frame" is what a simulator would draw each time: the driver's view in colour; where every frame is stored, with its linear results.
    std::string kind(const Moment& moment) const {
        return is_captured(drive_.capture, moment.tick, drive_.step_s) && drive_.capture.exr && !drive_.capture.all ? "frame, stored"
                                                                                                                    : "frame";
    }

    void draw(const Moment& moment, const Draw& draw) {
        const bool captured = is_captured(drive_.capture, moment.tick, drive_.step_s);
        for (const auto& [view, outputs] : pictures_at(drive_, display_, moment.tick, options_.no_times.empty())) {
            const bool drivers = view == &drive_.views.front();
            Frame frame = draw(moment, *view, outputs)();
            drivers ? times_.add(kind(moment), frame) : times_.add(frame);
            if (drivers)
                display_.see(frame);
            if (captured)
                drawn_.emplace_back(view, std::move(frame));
        }
    }

    void store(const Moment& moment) {
        if (drawn_.empty())
            return;
        const TraceSpan span("store", "play");
        for (auto& [view, frame] : drawn_) {
            if (view->projection == Projection::map)
                keep_map(frame, moment, *view);
            else if (view == &drive_.views.front() && !frame.illuminance_lx.empty())
                lux_views_.add(captured_, [&, &lx = frame.illuminance_lx, &name = view->name] {
                    return LuxView{lux_codes(lx, lux_view_px), name, moment.tick};
                });
            StoredFrame stored = store_frame(writers_, options_.folder, drive_.name + "-" + played_.lamp_set, drive_.capture,
                                             std::move(frame), moment, *view, display_.writer(moment));
            played_.frames.push_back(std::move(stored));
        }
        ++captured_;
        drawn_.clear();
    }

    void finish(bool all_played) {
        played_.maps = maps_.finish(all_played);
        played_.lux_views = lux_views_.finish(all_played);
        if (options_.no_times.empty())
            std::ranges::copy(display_.times(), std::back_inserter(played_.passes));
        played_.display = display_.seen();
    }

  private:
    static std::size_t captured_moments(const Drive& drive, TickRange range) {
        std::size_t captured = 0;
        for (int k = 0, tick = std::max(0, range.first); k < ticks_to_play(drive, range); ++k, ++tick)
            captured += is_captured(drive.capture, tick, drive.step_s) ? 1U : 0U;
        return captured;
    }

    void keep_map(const Frame& frame, const Moment& moment, const View& view) {
        if (!frame.illuminance_lx.empty())
            maps_.add(captured_, [&] { return lux_map_of(frame, moment, view, route_, drive_.bumper_m); });
        else if (const std::string note = "lux maps are not measured: " + no_illuminance(drive_.technique);
                 std::ranges::find(played_.notes, note) == played_.notes.end())
            played_.notes.push_back(note);
    }

    const Drive& drive_;
    const Route& route_;
    const PlayOptions& options_;
    PlayedCell& played_;
    Writers& writers_;
    FrameTimes& times_;
    LuxMaps maps_;
    ShownMoments<LuxView> lux_views_;
    DisplayStep display_;
    std::vector<std::pair<const View*, Frame>> drawn_; ///< of this moment, to be stored
    std::size_t captured_ = 0;                         ///< moments until now
};

/// Measures moments by other threads while the next ones are drawn, where there is a core for that. Rows stand in the order of the moments,
/// and an error comes out of the add() or finish() that meets it. Memory stays constant: add() waits while too many moments are waiting.
class Measuring {
  public:
    Measuring(const ExtentFold& fold, std::vector<ExtentRow>& rows)
        : fold_(fold), rows_(rows), max_waiting_(std::clamp(std::thread::hardware_concurrency(), 2U, 8U)) {}

    void add(ExtentDrawing drawing) {
        if (waiting_.size() == max_waiting_)
            join_first();
        waiting_.push_back(std::async(how_, [this, drawing = std::move(drawing)] {
            if (how_ == std::launch::async)
                name_traced_thread("measuring");
            return fold_.measure(drawing);
        }));
    }
    void finish() {
        while (!waiting_.empty())
            join_first();
    }

  private:
    void join_first() {
        const TraceSpan span("wait for extents", "play");
        std::future<ExtentRow> first = std::move(waiting_.front());
        waiting_.pop_front();
        rows_.push_back(first.get());
    }

    const ExtentFold& fold_;
    std::vector<ExtentRow>& rows_;
    std::launch how_ = has_core_beside_drawing() ? std::launch::async : std::launch::deferred;
    std::size_t max_waiting_;
    std::deque<std::future<ExtentRow>> waiting_; ///< each waits for its thread when it is destroyed
};

CarRow car_row(const Drive& drive, const LampSet& lamp_set, double time_s) {
    const Motion& motion = *lamp_set.motion;
    const CarPlace place = motion.car->at(time_s);
    CarRow row{time_s, degrees(place.pitch_rad), 1e3 * place.rear_lift_m, std::nullopt, std::nullopt};
    if (motion.levelling)
        row.levelling_deg = degrees(motion.levelling->angle_rad(time_s));
    else if (motion.control && !motion.control->lamps.empty() && lamp_set.control && lamp_set.control->levelling)
        row.levelling_deg = degrees(motion.control->pitch_rad(0, time_s));
    if (drive.vehicle && drive.vehicle->roll)
        row.roll_deg = degrees(place.roll_rad);
    if (motion.swivel)
        row.swivel_deg = degrees(motion.swivel->angle_rad(time_s));
    return row;
}

} // namespace

std::string no_illuminance(const std::string& technique) { return fmt::format("technique {} does not compute an illuminance", technique); }

FrameOutputs stored_results(const View& view, const Capture& capture) {
    FrameOutputs outputs;
    outputs.colour = view.projection == Projection::perspective; // a map is shown by its lux, in false colour
    outputs.illuminance = outputs.luminance = capture.exr;
    outputs.depth = capture.exr && view.projection == Projection::perspective;
    outputs.target = capture.exr && view.projection == Projection::map;
    if (view.projection == Projection::map)
        outputs.illuminance = true; // the bird's-eye lux map of the report
    return outputs;
}

int ticks_to_play(const Drive& drive, TickRange range) {
    return std::max(0, std::min(tick_count(drive) - 1, range.last) - std::max(0, range.first) + 1);
}

PlayedCell play(const Drive& drive, const Route& route, const LampSet& lamp_set, const PlayOptions& options, const Draw& draw,
                Writers& writers) {
    PlayedCell played;
    played.drive = drive.name;
    played.title = drive.title;
    played.lamp_set = lamp_set.name;
    played.technique = drive.technique;
    played.rendering_settings = std::make_shared<const RenderingSettings>(rendering_settings(drive));
    for (const MountedLamp& lamp : lamp_set.lamps)
        played.lamps.emplace_back(lamp.name, lamp.file->name);
    played.first_tick = std::max(0, options.ticks.first);
    played.ticks_planned = ticks_to_play(drive, options.ticks);
    FrameTimes times(options.warm_up, options.profile, options.no_times);
    Pictures pictures(drive, route, options, played, writers, times);
    const Nudges nudges = usual_nudges(drive, lamp_set);
    const ExtentFold extent(drive, route, nudges);
    Measuring measuring(extent, played.extents);
    ProbeFold probes(drive, route, nudges);
    SeeingFold seeing(drive, route);
    SensitivityFold sensitivity(drive, route, lamp_set);
    LevelFold levels(drive, lamp_set);

    State state = start(drive);
    while (state.tick < std::max(0, options.ticks.first) && state.tick + 1 < tick_count(drive))
        state = advance(state, drive);
    for (int k = 0; k < played.ticks_planned; ++k, state = advance(state, drive)) {
        TraceSpan span("moment", "play");
        if (span)
            span.tell("tick", state.tick);
        const Moment moment = moment_at(state, drive, route, lamp_set);
        if (options.log)
            *options.log << logged_moment(lamp_set.name, moment);
        if (times.begin_moment(pictures.kind(moment))) {
            measuring.finish();
            writers.finish();
        }
        // All drawing comes first, so that what it leaves to others does not slow it down where its time is taken.
        pictures.draw(moment, draw);
        std::optional<ExtentDrawing> drawn;
        if (drive.extent) {
            drawn = extent.draw(moment, draw);
            drawn->nudged = tells_sensitivity(k, played.ticks_planned);
            times.add("extent map", drawn->frame);
            if (drawn->frame.illuminance_lx.empty())
                played.no_road_lx = no_illuminance(drive.technique);
            if (drawn->frame.target_lx.empty())
                played.no_target_lx = played.no_road_lx.empty()
                                          ? fmt::format("technique {} does not compute the illuminance of targets", drive.technique)
                                          : played.no_road_lx;
        }
        probes.add(moment, draw);
        times.end_moment();
        {
            const TraceSpan seen("seeing", "measure");
            seeing.add(moment, lamp_set);
        }
        sensitivity.add(moment, tells_sensitivity(k, played.ticks_planned));
        levels.add(moment);
        pictures.store(moment);
        if (drawn)
            measuring.add(std::move(*drawn));
        played.speed_mps.emplace_back(moment.time_s, moment.speed_mps);
        if (lamp_set.motion && lamp_set.motion->car)
            played.car.push_back(car_row(drive, lamp_set, moment.time_s));
        ++played.ticks_done;
        if (!options.go_on(played.ticks_done))
            break;
    }
    measuring.finish();
    writers.finish();
    times.finish(played);
    pictures.finish(played.ticks_done == played.ticks_planned);
    played.readings = probes.finish();
    Readings seen = seeing.readings();
    sensitivity.tell(seen);
    std::ranges::move(seen, std::back_inserter(played.readings));
    played.seeing = seeing.series();
    played.pixel_levels = levels.finish();
    return played;
}

} // namespace fernlicht
