#include "runner/play.h"

#include "runner/extent_fold.h"
#include "runner/lux_map.h"
#include "runner/probe_fold.h"
#include "scenarios/drives/advance.h"

#include <algorithm>

namespace fernlicht {
namespace {

/// What a stored frame of a view holds.
Wanted stored_results(const View& view, const Capture& capture) {
    Wanted wanted;
    wanted.colour = view.projection == Projection::perspective; // a map is shown by its lux, in false colour
    wanted.illuminance = wanted.luminance = capture.exr;
    wanted.depth = capture.exr && view.projection == Projection::perspective;
    wanted.target = capture.exr && view.projection == Projection::map;
    if (view.projection == Projection::map)
        wanted.illuminance = true; // the bird's-eye lux map of the report
    return wanted;
}

/// Draws and stores what is captured of this moment, and times the driver's view of every moment.
class Pictures {
  public:
    Pictures(const Drive& drive, const Route& route, const PlayOptions& options, PlayedVariant& played, Writers& writers)
        : drive_(drive), route_(route), options_(options), played_(played), writers_(writers) {}

    void add(const Moment& moment, const Draw& draw) {
        const bool captured = is_captured(drive_.capture, moment.tick, drive_.step_s);
        for (std::size_t i = 0; i < drive_.views.size(); ++i) {
            const View& view = drive_.views[i];
            if (captured)
                store(moment, view, draw, i == 0);
            else if (i == 0)
                time(draw(moment, view, {.colour = true})(), "frame");
        }
    }

  private:
    void store(const Moment& moment, const View& view, const Draw& draw, bool timed) {
        Frame frame = draw(moment, view, stored_results(view, drive_.capture))();
        if (timed)
            time(frame, drive_.capture.exr && !drive_.capture.all ? "frame, stored" : "frame");
        if (view.projection == Projection::map)
            played_.maps.push_back(lux_map_of(frame, moment, view, route_));
        played_.frames.push_back(
            store_frame(writers_, options_.folder, drive_.name + "-" + played_.variant, drive_.capture, std::move(frame), moment, view));
    }

    /// "frame" is what a simulator would draw each time: the driver's view in colour; where every frame is stored, with its linear results.
    void time(const Frame& frame, const std::string& name) {
        if (drawn_++ < options_.warm_up) {
            ++played_.warm_up_dropped;
            return;
        }
        add_time(name, frame.cpu_s);
        for (const auto& [pass, seconds] : frame.pass_s)
            add_time(name + ": " + pass, seconds);
    }

    void add_time(const std::string& pass, double seconds) {
        const auto known = std::find_if(played_.passes.begin(), played_.passes.end(), [&](const PassTime& p) { return p.name == pass; });
        if (known == played_.passes.end())
            played_.passes.push_back({pass, {seconds}});
        else
            known->seconds.push_back(seconds);
    }

    const Drive& drive_;
    const Route& route_;
    const PlayOptions& options_;
    PlayedVariant& played_;
    Writers& writers_;
    int drawn_ = 0;
};

} // namespace

int ticks_to_play(const Drive& drive, TickRange range) {
    return std::max(0, std::min(tick_count(drive) - 1, range.last) - std::max(0, range.first) + 1);
}

PlayedVariant play(const Drive& drive, const Route& route, const Variant& variant, const PlayOptions& options, const Draw& draw,
                   Writers& writers) {
    PlayedVariant played;
    played.drive = drive.name;
    played.title = drive.title;
    played.variant = variant.name;
    played.technique = drive.technique;
    for (const MountedLamp& lamp : variant.lamps)
        played.lamps.emplace_back(lamp.name, lamp.file->name);
    played.ticks_planned = ticks_to_play(drive, options.ticks);
    Pictures pictures(drive, route, options, played, writers);
    std::optional<ExtentFold> extent;
    if (drive.extent)
        extent.emplace(drive, route);
    ProbeFold probes(drive, route);

    State state = start(drive);
    while (state.tick < std::max(0, options.ticks.first) && state.tick + 1 < tick_count(drive))
        state = advance(state, drive);
    for (int k = 0; k < played.ticks_planned; ++k, state = advance(state, drive)) {
        const Moment moment = moment_at(state, drive, route, variant);
        pictures.add(moment, draw);
        if (extent)
            played.extents.push_back(extent->add(moment, draw));
        probes.add(moment, draw);
        played.speed_mps.emplace_back(moment.time_s, moment.speed_mps);
        ++played.ticks_done;
        if (!options.go_on(played.ticks_done))
            break;
    }
    played.readings = probes.finish();
    return played;
}

} // namespace fernlicht
