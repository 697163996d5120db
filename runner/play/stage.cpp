#include "runner/play/stage.h"

#include "metrics/folds/reading_names.h"
#include "metrics/folds/seeing_fold.h"
#include "renderer/technique.h"
#include "runner/play/aim_lamps.h"
#include "scenarios/drives/edits/adapting_white.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/staged_scene.h"
#include "scenarios/drives/story/apply_storyboard.h"
#include "scenarios/roads/road_network.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/library_folders.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace fernlicht {

namespace {

/// Before the storyboard copies lamps to its entities.
Drive with_aimed_lamps(Drive drive) {
    aim_lamps(drive);
    return drive;
}

/// The road, and what the drive's storyboard makes of drive and route on it.
RoadNetwork network_of(Drive& drive) {
    RoadNetwork network = read_opendrive(drive.road_file);
    if (drive.mirrored_road)
        network = mirrored(std::move(network));
    apply_storyboard(drive, network);
    return network;
}

/// Lanes are named as the road's file has them.
Route::Start start_of(const Drive& drive) {
    Route::Start start = drive.start;
    start.asked_in = drive.file;
    if (drive.mirrored_road)
        start.lane = -start.lane;
    return start;
}

} // namespace

Stage::Stage(Drive d)
    : drive(with_aimed_lamps(std::move(d))), network(network_of(drive)), route(network, start_of(drive), drive.via),
      scene(staged_scene(drive, network, route)) {
    check_names(drive, SeeingFold(drive, route).readings(), &route);
    if (technique_named(drive.technique, drive.file).kind != TechniqueKind::ours)
        drive.display.white.degree = 0.0; // what was published knows no colours of lamps
    close_white(drive, white_of_lamps(drive));
    if (drive.extent && !drive.traffic.empty())
        drive.notes.emplace_back(
            "other road users: pictures and lux maps show the light of all lamps; reach, width and area are of the own lamps "
            "alone. Rendered, they end where a body hides road or target; the twin, and what aim and flux change, know "
            "no bodies");
}

void refuse_each(Drive drive) {
    EachRead each;
    std::optional<RoadNetwork> network;
    std::optional<Route> route;
    each([&] { aim_lamps(drive); });
    const bool has_network = each([&] { network = network_of(drive); });
    const bool has_route = has_network && each([&] { route.emplace(*network, start_of(drive), drive.via); });
    if (has_network && !has_route) {
        Drive in_lanes = drive; // whose places need no route
        std::erase_if(in_lanes.traffic_rows, [](const TrafficRow& row) { return row.place != TrafficPlace::lane; });
        each([&] { place_traffic(in_lanes, *network, Route(*network, {})); });
    }
    if (!has_route)
        route.emplace(network.emplace(read_opendrive(shipped_path("roads/straight.xodr"))), Route::Start{});
    Readings readings;
    const auto finds_readings = [&] { readings = SeeingFold(drive, *route).readings(); };
    if (has_route ? each(finds_readings) : all_refusals(finds_readings).empty()) // whose places may lie beyond a road that is not its own
        each([&] { check_names(drive, readings, has_route ? &*route : nullptr); });
    each.end();
}

bool left_hand_traffic(const Stage& stage) {
    const std::vector<Route::Leg>& legs = stage.route.legs();
    return !legs.empty() && stage.network.roads[legs.front().road].left_hand_traffic;
}

std::vector<Moment> moments_at(const std::vector<int>& ticks, const Stage& stage, const LampSet& lamp_set) {
    std::vector<Moment> moments;
    State state = start(stage.drive);
    for (const int tick : ticks) {
        while (state.tick < tick)
            state = advance(state, stage.drive);
        moments.push_back(moment_at(state, stage.drive, stage.route, lamp_set));
    }
    return moments;
}

const LampSet& lamp_set_of(const Drive& drive, const std::string& name) {
    if (name.empty())
        return drive.lamp_sets.front();
    std::vector<std::string> names;
    for (const LampSet& lamp_set : drive.lamp_sets) {
        if (lamp_set.name == name)
            return lamp_set;
        names.push_back(lamp_set.name);
    }
    throw InputError({drive.file, 0, 0, "--lamp-set"}, "found '" + printable(name) + "'", fmt::format("one of {}", fmt::join(names, ", ")));
}

View at_size(View view, int width_px, int height_px) {
    view.width_px = width_px;
    view.height_px = height_px;
    return view;
}

void add_inputs(FilesRead& all, const FilesRead& more) {
    for (const FileRead& file : more)
        if (std::none_of(all.begin(), all.end(), [&](const FileRead& known) { return known.path == file.path; }))
            all.push_back(file);
}

} // namespace fernlicht
