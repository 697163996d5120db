#include "runner/experiments/masks/masks_run.h"

#include "runner/files/output_folder.h"
#include "runner/findings/lamp_checks.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>
#include <map>

namespace fernlicht {
namespace {

constexpr double told_apart_m = 0.05; ///< between the lamps of two lamp sets; nearer, hardly anything else is hidden

bool masks_others(const LampSet& lamp_set) { return lamp_set.control && lamp_set.control->glare_free; }

/// Margins come from radians: 0.7 degrees are these again.
double own_margin_deg(const LampSet& lamp_set) { return std::round(degrees(lamp_set.control->glare_free->margin_rad) * 1e6) / 1e6; }

LampSet with_margin(LampSet lamp_set, double margin_deg) {
    ControlParameters control = *lamp_set.control;
    control.glare_free->margin_rad = radians(margin_deg);
    lamp_set.control = std::make_shared<const ControlParameters>(std::move(control));
    lamp_set.name = fmt::format("{}, margin {:g} degrees", lamp_set.name, margin_deg);
    return lamp_set;
}

/// Each lamp set as it is, and those that mask others with each margin instead.
std::vector<MaskedDrive> set_out(Drive& drive, const std::vector<double>& margins_deg) {
    std::vector<MaskedDrive> drives;
    std::vector<LampSet> lamp_sets;
    for (const LampSet& lamp_set : drive.lamp_sets) {
        if (!masks_others(lamp_set)) {
            lamp_sets.push_back(lamp_set);
            drives.push_back({.lamp_set = lamp_set.name});
            continue;
        }
        std::vector<double> all = margins_deg;
        const double own_deg = own_margin_deg(lamp_set);
        all.push_back(own_deg);
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end(), [](double a, double b) { return std::abs(a - b) < 1e-6; }), all.end());
        for (const double margin_deg : all) {
            const bool own = std::abs(margin_deg - own_deg) < 1e-6;
            lamp_sets.push_back(own ? lamp_set : with_margin(lamp_set, margin_deg));
            drives.push_back({.lamp_set = lamp_set.name, .margin_deg = margin_deg, .as_it_is = own});
        }
    }
    drive.lamp_sets = std::move(lamp_sets);
    return drives;
}

VisibilityTarget walker_of(const Drive& drive) {
    const char* const usual = "pedestrian-dark";
    const std::vector<VisibilityTarget>& asked = drive.seeing.visibility ? drive.seeing.visibility->targets : default_targets();
    const auto found = std::ranges::find(asked, usual, &VisibilityTarget::name);
    return found != asked.end() ? *found : *std::ranges::find(default_targets(), usual, &VisibilityTarget::name);
}

/// An eye, or what is behind a mirror, of whoever meets the light.
bool is_carried_eye(const Photometer& photometer) { return !photometer.on.empty() && photometer.faces != PhotometerFacing::lamps; }

/// Nothing is measured but what masks change.
void strip(Drive& drive) {
    drive.extent.reset();
    drive.probes.clear();
    drive.limits.clear();
    VisibilityParameters visibility = drive.seeing.visibility.value_or(VisibilityParameters{});
    drive.seeing = {};
    drive.seeing.visibility = std::move(visibility);
}

/// Walkers beside each other road user, from far to near.
using WalkerApproaches = std::map<std::size_t, std::pair<Approach, Approach>>;

void add_light(MaskedDrive& of, WalkerApproaches& walkers, const MaskLight& light, const Stage& stage, double time_s) {
    MaskedDrive::Moment& moment = of.moments.emplace_back(MaskedDrive::Moment{time_s, light.lane_lx, light.verge_lx, light.both_lx});
    std::map<std::size_t, std::pair<double, double>> brightest; // by road user: light, and what is above a limit
    for (const MaskLight::Eye& eye : light.eyes) {
        auto& [lx, above_lx] = brightest[eye.user];
        lx = std::max(lx, eye.lx);
        above_lx = std::max(above_lx, eye.limit_lx ? eye.lx - *eye.limit_lx : 0.0);
        const double share = eye.limit_lx ? eye.lx / *eye.limit_lx : 0.0;
        if (eye.limit_lx ? share > of.most_of_limit.value_or(-1.0) : !of.most_of_limit && eye.lx > of.most_lx) {
            of.worst_user = stage.drive.traffic[eye.user].name;
            of.worst_s = time_s;
            of.worst_m = eye.distance_m;
        }
        if (eye.limit_lx)
            of.most_of_limit = std::max(of.most_of_limit.value_or(0.0), share);
        of.most_lx = std::max(of.most_lx, eye.lx);
    }
    for (const auto& [user, lx] : brightest) {
        moment.others_lx += lx.first;
        moment.above_lx += lx.second;
    }
    for (const MaskLight::Walker& walker : light.walkers) {
        walkers[walker.user].first.push_back({time_s, walker.ahead_m, walker.left.number()});
        walkers[walker.user].second.push_back({time_s, walker.ahead_m, walker.right.number()});
    }
}

void sum_up(MaskedDrive& of, const WalkerApproaches& walkers, double step_s, double level) {
    for (const MaskedDrive::Moment& moment : of.moments) {
        of.lane_lxs += step_s * moment.lane_lx;
        of.verge_lxs += step_s * moment.verge_lx;
        of.both_lxs += step_s * moment.both_lx;
        of.others_lxs += step_s * moment.others_lx;
        of.above_lxs += step_s * moment.above_lx;
    }
    CensoredSamples left("there is no oncoming road user"), right = left;
    for (const auto& [user, sides] : walkers) {
        left.add(reached_from_m(sides.first, level, false));
        right.add(reached_from_m(sides.second, level, false));
    }
    of.left_m = left.quantile(0.5);
    of.right_m = right.quantile(0.5);
}

std::size_t place_of_full(const std::vector<MaskedDrive>& drives, const std::string& name, const Drive& drive) {
    const auto found = std::ranges::find_if(drives, [&](const MaskedDrive& one) { return one.lamp_set == name && one.as_it_is; });
    if (found != drives.end())
        return static_cast<std::size_t>(found - drives.begin());
    std::vector<std::string> names;
    for (const MaskedDrive& one : drives)
        if (one.as_it_is)
            names.push_back(one.lamp_set);
    throw InputError({drive.file, 0, 0, "--full-light"}, "found '" + printable(name) + "'",
                     fmt::format("one of {}", fmt::join(names, ", ")));
}

} // namespace

MasksFound run_masks(const MasksRequest& request) {
    MasksFound found;
    Drive drive = request.drive;
    if (std::ranges::none_of(drive.lamp_sets, masks_others))
        throw InputError({drive.file, 0, 0, "lamp_sets"}, "found none that masks others", "one with control: {glare_free: ...}");
    found.drives = set_out(drive, request.margins_deg);
    if (std::ranges::none_of(request.limits.photometers, is_carried_eye))
        throw InputError({request.limits.file, 0, 0, "--rating"},
                         fmt::format("rating '{}' has no photometer on road users that faces forward or backward", request.limits.name),
                         "one that has eyes and mirrors, as adb-track");
    const std::size_t full = place_of_full(found.drives, request.against, drive);
    const VisibilityTarget walker = walker_of(drive);
    strip(drive);
    const Stage stage(std::move(drive));
    found.context = make_context({}, request.command, stage.drive.seed);
    for (const FilesRead* files : {&stage.drive.opened, &stage.network.opened, &request.limits.opened})
        add_inputs(found.context.inputs, *files);
    found.drive = stage.drive.name;
    found.title = stage.drive.title;
    found.against = request.against;
    found.limits = request.limits.name;
    found.walker = walker.name;
    found.walker_level = walker.level;
    found.places = request.places;
    found.places.left_hand = left_hand_traffic(stage);
    found.moments = tick_count(stage.drive);
    found.step_s = stage.drive.step_s;
    LampFileChecks lamps;
    lamps.add(request.drive, found.places.left_hand); // without the margins tried
    for (const std::string& warning : lamp_warnings(lamps.files()))
        found.notes.push_back("warning: " + warning);
    found.notes.insert(found.notes.end(), stage.drive.notes.begin(), stage.drive.notes.end());
    const VisibilityFold visibility(stage.drive, stage.route);
    std::vector<WalkerApproaches> walkers(found.drives.size());
    std::vector<double> apart_m(found.drives.size());
    State state = start(stage.drive);
    for (int k = 0; k < found.moments; ++k, state = advance(state, stage.drive)) {
        if (weather_of(stage.drive, state.time_s).wetness > 0.0)
            throw InputError({stage.drive.file, 0, 0, "weather"}, "a wet road, whose mirrored light is not computed here", "a dry one");
        std::optional<MaskScene> scene; // by the first lamp set's car
        glm::dvec3 lamps_m(0.0);
        for (std::size_t i = 0; i < found.drives.size(); ++i) {
            const Moment moment = moment_at(state, stage.drive, stage.route, stage.drive.lamp_sets[i]);
            if (!scene) {
                scene.emplace(stage.drive, stage.route, request.limits, found.places, walker, moment);
                lamps_m = middle_of_lamps_m(moment);
            }
            apart_m[i] = std::max(apart_m[i], glm::distance(lamps_m, middle_of_lamps_m(moment)));
            add_light(found.drives[i], walkers[i], scene->light(moment, visibility), stage, state.time_s);
        }
    }
    for (std::size_t i = 0; i < found.drives.size(); ++i)
        if (found.drives[i].as_it_is && apart_m[i] >= told_apart_m)
            found.notes.push_back(
                fmt::format("lamp set {}: the middle of its lamps lies up to {:.2f} m from that of {}, from which crests and "
                            "bodies are looked for that hide targets and eyes",
                            found.drives[i].lamp_set, apart_m[i], found.drives.front().lamp_set));
    for (std::size_t i = 0; i < found.drives.size(); ++i)
        sum_up(found.drives[i], walkers[i], found.step_s, walker.level);
    const double full_lxs = found.drives[full].both_lxs;
    for (MaskedDrive& one : found.drives) {
        one.lost_lxs = full_lxs - one.both_lxs;
        if (full_lxs > 0.0)
            one.lost_percent = 100.0 * one.lost_lxs / full_lxs;
    }
    OutputFolder folder(request.folder);
    request.write(found);
    folder.finish();
    return found;
}

} // namespace fernlicht
