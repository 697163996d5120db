#include "metrics/folds/adaptation.h"

#include "metrics/folds/place_fold.h"
#include "metrics/seeing/visibility.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/roads/mesh/mesh_materials.h"
#include "scenarios/traffic/road_user.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>

namespace fernlicht {
namespace {

/// Fills the lane from a bumper on; `way` 1 along the route, -1 against it.
void look_ahead(const Route& route, double bumper_m, Across across, double way, Driver& driver) {
    for (int k = 0; adaptation_from_m + k * adaptation_step_m <= adaptation_to_m; ++k) {
        const double along_m = bumper_m + way * (adaptation_from_m + k * adaptation_step_m);
        const std::optional<Pose> place =
            along_m < 0.0 || along_m > route.length_m() ? std::nullopt : place_on_road(route, across, along_m);
        if (!place) {
            driver.lane.clear();
            driver.no_lane = fmt::format("the driver's own lane does not go on for {} m before him", adaptation_to_m);
            return;
        }
        driver.lane.push_back(*place);
    }
}

bool is_low_beam(const LampSet& lamp_set, const std::string& lamp) {
    const auto has = [&](const std::vector<std::string>& names) { return std::ranges::find(names, lamp) != names.end(); };
    const ControlParameters* const control = lamp_set.control.get();
    return function_of(lamp) != LampFunction::high && !(control && control->high_beam && has(control->high_beam->lamps)) &&
           !(control && control->cornering && (has(control->cornering->left) || has(control->cornering->right)));
}

} // namespace

Driver oncoming_driver(const Drive& drive, const Route& route, double at_m, double eye_height_m) {
    const Pose foot = place_on_road(route, Across::oncoming_centre, at_m).value();
    const double eye_x_m = driver_eye_m(drive).x;
    const auto axle = [&](double x_m) { // so far before the rear axle
        const double along_m = at_m + eye_x_m - x_m;
        const std::optional<Pose> place =
            along_m < 0.0 || along_m > route.length_m() ? std::nullopt : place_on_road(route, Across::oncoming_centre, along_m);
        return place ? place->position_m : foot.position_m - (x_m - eye_x_m) * foot.forward();
    };
    const glm::dvec3 rear = axle(0.0), forward = glm::normalize(axle(drive.wheelbase_m) - rear),
                     left = glm::normalize(glm::cross(foot.up(), forward));
    Driver driver{
        {rear, {forward, left, glm::cross(forward, left)}}, foot.position_m + eye_height_m * foot.up(), drive.road_surface.pavement};
    look_ahead(route, at_m + eye_x_m - drive.bumper_m, Across::oncoming_centre, -1.0, driver);
    return driver;
}

Driver driver_ahead(const Drive& drive, const Route& route, double along_m, const Pose& car, const glm::dvec3& eye_m) {
    Driver driver{car, eye_m, drive.road_surface.pavement};
    look_ahead(route, along_m + drive.bumper_m, Across::own_centre, 1.0, driver);
    return driver;
}

std::vector<LitLamp> low_beams(const Drive& drive, const LampSet& lamp_set, const Pose& car, const Nudge& nudge) {
    Moment his;
    his.ego = car;
    for (const MountedLamp& mounted : lamp_set.lamps) {
        if (!is_low_beam(lamp_set, mounted.name))
            continue;
        MountedLamp lamp = mounted;
        if (drive.adaptation_lamp) { // in its own aim: what turns the lamp set's lamps is theirs
            lamp.file = drive.adaptation_lamp;
            lamp.yaw_rad = lamp.pitch_rad = lamp.roll_rad = 0.0;
            lamp.aligned = {};
        }
        his.lamps.push_back(lit_lamp(lamp, car));
    }
    if (drive.adaptation_lamp)
        return his.lamps;
    Nudge of_all = nudge; // his own lamps differ by what differs in all of their kind, not in this car's
    of_all.lamps.clear();
    return nudged(std::move(his), of_all).lamps;
}

Value lane_luminance_cdm2(const Driver& driver, std::vector<LitLamp> lamps, const Moment& moment) {
    const Material& asphalt = pavement_material(driver.pavement);
    if (driver.lane.empty())
        return Value::not_measured(driver.no_lane);
    Moment lit;
    lit.lamps = std::move(lamps);
    lit.daylight = moment.daylight;
    lit.weather = moment.weather;
    std::ranges::copy_if(moment.other_lamps, std::back_inserter(lit.lamps),
                         [](const LitLamp& lamp) { return lamp.body == fixed_in_world; });
    double sum = 0.0;
    for (const Pose& place : driver.lane)
        sum += seen_luminance(lit, place.position_m, place.up(), asphalt, driver.eye_m).photopic_cdm2;
    return sum / static_cast<double>(driver.lane.size());
}

} // namespace fernlicht
