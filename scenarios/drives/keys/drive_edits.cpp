#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <system_error>
#include <tuple>

namespace fernlicht {
namespace {

bool is_meant(const std::string& lamp, const std::string& side) {
    return lamp.find(side) != std::string::npos && (!is_high_beam(lamp) || is_high_beam(side));
}

std::filesystem::path made_absolute(const std::filesystem::path& path) { return std::filesystem::absolute(path).lexically_normal(); }

/// Takes a later switch to another file out of a change, with the source and colour that came with it; true when nothing is left.
bool becomes_empty(LampChange& change) {
    if (!change.file)
        return false;
    change.file.reset();
    change.source.reset();
    change.colour.reset();
    return !change.level && !change.pitch_rad && !change.yaw_rad && !change.roll_rad;
}

/// Replaces the file of the lamps meant, for the whole drive.
void replace_lamps(Drive& drive, const std::string& side, const std::shared_ptr<const LampFile>& file, std::set<std::string>& replaced) {
    std::set<std::string> known;
    bool found = false;
    for (LampSet& lamp_set : drive.lamp_sets) {
        for (MountedLamp& lamp : lamp_set.lamps) {
            known.insert(lamp.name);
            if (!is_meant(lamp.name, side))
                continue;
            if (lamp.levels)
                throw InputError({drive.file, 0, 0, "lamp " + side},
                                 fmt::format("another file for '{}', whose pixels have levels from a file", lamp.name),
                                 "a lamp without them");
            lamp.file = file;
            replaced.insert(lamp_set.name + '/' + lamp.name);
            found = true;
        }
        if (lamp_set.control && lamp_set.control->glare_free)
            for (const SegmentedLamp& segmented : lamp_set.control->glare_free->lamps)
                if (is_meant(segmented.name, side) && segmented.pixels != (file->pixels != nullptr))
                    throw InputError({drive.file, 0, 0, "lamp " + side},
                                     fmt::format("{} pixel lamp for '{}', whose glare_free has {}", file->pixels ? "a" : "no",
                                                 segmented.name, segmented.pixels ? "pixels" : "windows"),
                                     segmented.pixels ? "a pixel lamp" : "a lamp of one table");
        std::erase_if(lamp_set.changes, [&](LampChange& change) { return is_meant(change.lamp, side) && becomes_empty(change); });
    }
    if (!found)
        throw InputError({drive.file, 0, 0, "lamp " + side}, "no lamp of this name", fmt::format("one of {}", fmt::join(known, ", ")));
}

/// When each lamp set had its low beams replaced by the same files, playing more than one says nothing new.
void keep_one_lamp_set(Drive& drive, const DriveEdits& edits, const std::set<std::string>& replaced) {
    for (const LampSet& lamp_set : drive.lamp_sets)
        for (const MountedLamp& lamp : lamp_set.lamps)
            if (!is_high_beam(lamp.name) && !replaced.contains(lamp_set.name + '/' + lamp.name))
                return;
    LampSet& kept = drive.lamp_sets.front();
    if (drive.lamp_sets.size() > 1)
        drive.notes.push_back(fmt::format("every lamp set would have the same low beams, so only the first ('{}') is played", kept.name));
    drive.lamp_sets.resize(1);
    drive.lamp_sets.front().name = name_from(edits.lamps.back().second);
}

/// Fog, cornering and signal lamps have no cut-off to be aimed by, and stay as the drive has them.
void replace_aim(Drive& drive, BeamAim aim) {
    for (LampSet& lamp_set : drive.lamp_sets)
        for (MountedLamp& lamp : lamp_set.lamps) {
            const auto has = [&](const char* word) { return lamp.name.find(word) != std::string::npos; };
            if (lamp.name != "left" && lamp.name != "right" && !has("low") && !has("high"))
                continue;
            lamp.aim_rule = aim;
            lamp.yaw_rad = lamp.pitch_rad = lamp.roll_rad = 0.0;
        }
}

void replace_road(Drive& drive, const std::filesystem::path& road) {
    drive.road_file = made_absolute(road);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(drive.road_file, ignored))
        throw InputError({drive.road_file, 0, 0, {}}, "there is no such road file", "an OpenDRIVE file");
    if (!drive.via.empty() || !drive.start.road.empty() || drive.start.lane != 0)
        drive.notes.push_back("another road was given: the drive's own route does not hold there, it starts at the road's default start");
    drive.start = {};
    drive.via.clear();
}

void replace_resolution(Drive& drive, const std::pair<int, int>& resolution) {
    const auto [width, height] = resolution;
    if (std::min(width, height) < 1 || std::max(width, height) > largest_view_px)
        throw InputError({drive.file, 0, 0, "resolution"}, fmt::format("{}x{}", width, height),
                         fmt::format("sides from 1 to {} pixels", largest_view_px));
    for (View& view : drive.views)
        if (view.projection == Projection::perspective)
            std::tie(view.width_px, view.height_px) = resolution;
}

} // namespace

void apply_edits(Drive& drive, const DriveEdits& edits, LampCache& cache) {
    std::set<std::string> replaced;
    for (const auto& [side, path] : edits.lamps)
        replace_lamps(drive, side, cache.lamp(made_absolute(path), {.recipe = edits.lamp_recipe}), replaced);
    if (!replaced.empty())
        keep_one_lamp_set(drive, edits, replaced);
    if (edits.aim)
        replace_aim(drive, *edits.aim);
    if (edits.road)
        replace_road(drive, *edits.road);
    if (edits.technique)
        drive.technique = *edits.technique;
    if (edits.shadows)
        set_shadow_method(drive.shadows, shadow_method_named(*edits.shadows, drive.file));
    if (edits.resolution)
        replace_resolution(drive, *edits.resolution);
    if (edits.capture_all)
        drive.capture.all = *edits.capture_all;
}

} // namespace fernlicht
