#include "runner/experiments/installation/installation_run.h"

#include "runner/findings/lamp_checks.h"
#include "runner/play/aim_lamps.h"
#include "runner/play/stage.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"
#include "scenarios/vehicle/car_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tuple>

namespace fernlicht {
namespace {

InstallationVerdict worse_of(InstallationVerdict a, InstallationVerdict b) {
    using enum InstallationVerdict;
    for (const InstallationVerdict verdict : {not_met, not_measured, within})
        if (a == verdict || b == verdict)
            return verdict;
    return not_applicable;
}

/// Low beams as they are aimed at the drive's beginning, each with its mark.
struct LowBeam {
    const MountedLamp* lamp;
    AimMark mark;
};

void add_inclinations(InstalledLamp& found, const LowBeam& beam, const std::vector<LoadedBody>& bodies) {
    for (const LoadedBody& body : bodies) {
        MountedLamp lamp = *beam.lamp;
        lamp.pitch_rad += body.levelling_rad;
        found.percent.push_back(mark_on_car(lamp, beam.mark.place(), body.pitch_rad).percent);
    }
}

/// One moment of a lamp: where its kink looks, from the car's middle and from its own place.
struct KinkLook {
    glm::dvec2 towards, from_middle_m, from_lamp_m;
    double right_deg; ///< of the car's axis
};

KinkLook look_of(const Moment& moment, const LitLamp& lamp, const AimMark& mark) {
    const Direction kink = mark.place();
    const double h = radians(kink.h_deg), v = radians(kink.v_deg);
    const glm::dvec3 of_lamp(std::cos(v) * std::cos(h), -std::cos(v) * std::sin(h), std::sin(v));
    const glm::dvec3 in_world = lamp.pose.axes * of_lamp, at = to_local(moment.ego, lamp.pose.position_m),
                     middle = to_parent(moment.ego, {at.x, 0.0, at.z}), ahead = glm::transpose(moment.ego.axes) * in_world;
    return {glm::dvec2(in_world), glm::dvec2(middle), glm::dvec2(lamp.pose.position_m), 0.0 - degrees(std::atan2(ahead.y, ahead.x))};
}

/// Of one lamp in bends to one side, moment by moment.
struct KinkSamples {
    std::vector<double> crossings_m;
    int moments = 0;
};

void take_crossing(KinkFound& found, KinkSamples& samples, const CarCircle& circle, const KinkLook& look, glm::dvec2 front_m,
                   double time_s) {
    ++samples.moments;
    if (const auto at = last_crossing_m(circle, look.from_middle_m, look.towards)) {
        const double distance_m = glm::length(*at - front_m);
        samples.crossings_m.push_back(distance_m);
        if (distance_m > found.distance_m.value_or(-1.0)) {
            found.distance_m = distance_m;
            found.at_s = time_s;
        }
    }
    if (const auto at = last_crossing_m(circle, look.from_lamp_m, look.towards))
        found.from_lamp_m = std::max(found.from_lamp_m.value_or(0.0), glm::length(*at - front_m));
}

void sum_up(KinkFound& found, KinkSamples& samples, double limit_m, double step_s) {
    std::vector<double>& all = samples.crossings_m;
    found.bends_s = samples.moments * step_s;
    found.beyond_s = static_cast<double>(std::ranges::count_if(all, [&](double m) { return m > limit_m; })) * step_s;
    if (!all.empty()) {
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::ranges::nth_element(all, middle);
        found.median_m = *middle;
    }
}

/// Over all moments but the first and the last, which have no circle.
void add_kinks(std::vector<InstalledLamp>& found, const std::vector<LowBeam>& beams, const Stage& stage, const LampSet& lamp_set,
               double centre_of_gravity_m) {
    std::vector<double> rest_deg;
    for (const LowBeam& beam : beams)
        rest_deg.push_back(mark_on_car(*beam.lamp, beam.mark.place()).right_deg);
    std::vector<std::array<KinkSamples, 2>> samples(beams.size()); // of left bends, of right ones
    std::vector<glm::dvec2> places;
    std::optional<Moment> before;
    for (State state = start(stage.drive); state.tick < tick_count(stage.drive); state = advance(state, stage.drive)) {
        Moment moment = moment_at(state, stage.drive, stage.route, lamp_set);
        places.push_back(glm::dvec2(to_parent(moment.ego, {centre_of_gravity_m, 0.0, 0.0})));
        for (std::size_t i = 0; before && i < beams.size(); ++i) {
            const auto lit = std::ranges::find(before->lamps, beams[i].lamp->name, &LitLamp::name);
            if (lit == before->lamps.end())
                continue;
            const KinkLook look = look_of(*before, *lit, beams[i].mark);
            const double moved_deg = std::abs(look.right_deg - rest_deg[i]);
            found[i].moved_deg = std::max(found[i].moved_deg, moved_deg);
            if (places.size() < 3)
                continue;
            const std::size_t n = places.size();
            const auto circle = circle_through(places[n - 3], places[n - 2], places[n - 1]);
            if (!circle || std::abs(circle->curvature_per_m) < straight_per_m)
                continue;
            const bool left = circle->curvature_per_m > 0.0;
            KinkFound& bends = left ? found[i].left_bends : found[i].right_bends;
            bends.moved_deg = std::max(bends.moved_deg, moved_deg);
            take_crossing(bends, samples[i][left ? 0 : 1], *circle, look,
                          glm::dvec2(to_parent(before->ego, {stage.drive.bumper_m, 0.0, 0.0})), before->time_s);
        }
        before = std::move(moment);
    }
    for (std::size_t i = 0; i < beams.size(); ++i) {
        sum_up(found[i].left_bends, samples[i][0], found[i].kink_limit_m(), stage.drive.step_s);
        sum_up(found[i].right_bends, samples[i][1], found[i].kink_limit_m(), stage.drive.step_s);
    }
}

/// Those of the request, else R48's and the drive's own. Throws InputError for one that lifts an axle off the road.
std::vector<LoadState> load_states(const InstallationRequest& request, const LampSet& lamp_set, const VehicleParameters& car,
                                   double wheelbase_m, std::optional<CarCapacity>& capacity) {
    std::vector<LoadState> loads = request.loads;
    if (loads.empty()) {
        capacity = CarCapacity::usual(car, wheelbase_m);
        loads = r48_load_states(car, wheelbase_m, *capacity);
        if (const AxleLoad own = lamp_set.control ? lamp_set.control->load : AxleLoad{}; own != AxleLoad{})
            loads.push_back({"the drive's own load", own.front_n / gravity_mps2, own.rear_n / gravity_mps2});
    }
    for (const LoadState& load : loads)
        for (const auto& [axle, added_kg, share] :
             {std::tuple("front", load.front_kg, car.front_load), {"rear", load.rear_kg, 1.0 - car.front_load}})
            if (!(added_kg + car.mass_kg * share > 0.0))
                throw InputError({{}, 0, 0, request.loads.empty() ? "control.load" : "--load"},
                                 fmt::format("found {:.0f} kg on the {} axle ('{}')", added_kg, axle, printable(load.name)),
                                 fmt::format("more than -{:.0f} kg, which the car has there", car.mass_kg * share));
    return loads;
}

} // namespace

InstallationVerdict InstallationFound::inclination(const InstalledLamp& lamp, std::size_t load) const {
    if (lamp.percent.empty() || !lamp.band)
        return InstallationVerdict::not_measured;
    return lamp.band->holds(lamp.percent[load]) ? InstallationVerdict::within : InstallationVerdict::not_met;
}

InstallationVerdict InstallationFound::inclination() const {
    InstallationVerdict all = InstallationVerdict::not_applicable;
    for (const InstalledLamp& lamp : lamps)
        for (std::size_t load = 0; load < loads.size(); ++load)
            all = worse_of(all, inclination(lamp, load));
    return all;
}

InstallationVerdict InstallationFound::kink(const InstalledLamp& lamp, const KinkFound& found) const {
    if (!lamp.moves() || found.bends_s == 0.0)
        return InstallationVerdict::not_applicable;
    if (!lamp.has_kink)
        return InstallationVerdict::not_measured;
    return found.distance_m.value_or(0.0) <= lamp.kink_limit_m() ? InstallationVerdict::within : InstallationVerdict::not_met;
}

InstallationVerdict InstallationFound::kink() const {
    InstallationVerdict all = InstallationVerdict::not_applicable;
    for (const InstalledLamp& lamp : lamps)
        all = worse_of(all, worse_of(kink(lamp, lamp.left_bends), kink(lamp, lamp.right_bends)));
    return all;
}

bool InstallationFound::good() const {
    using enum InstallationVerdict;
    return inclination() == within && (kink() == within || kink() == not_applicable);
}

InstallationFound run_installation(const InstallationRequest& request) {
    InstallationFound found;
    Drive drive = request.drive;
    drive.extent.reset(); // nothing of it is read
    const Stage stage(std::move(drive));
    const LampSet& lamp_set = lamp_set_of(stage.drive, request.lamp_set);
    found.drive = stage.drive.name;
    found.lamp_set = lamp_set.name;
    found.own_vehicle = stage.drive.vehicle.has_value();
    const VehicleParameters car = stage.drive.vehicle.value_or(VehicleParameters{});
    const double wheelbase_m = stage.drive.wheelbase_m;
    found.loads = load_states(request, lamp_set, car, wheelbase_m, found.capacity);
    found.warnings = lamp_warnings(stage.drive, lamp_set, left_hand_traffic(stage));
    const std::optional<LevellingParameters>& levelling = lamp_set.control ? lamp_set.control->levelling : lamp_set.levelling;
    found.levelled = levelling.has_value();
    for (const LoadState& load : found.loads)
        found.bodies.push_back(loaded_body(car, wheelbase_m, levelling, load));
    std::vector<LowBeam> beams;
    for (const MountedLamp& lamp : lamp_set.lamps) {
        if (!is_low_beam(lamp))
            continue;
        AimMark mark = aim_mark(lamp.file->table, false);
        InstalledLamp& one = found.lamps.emplace_back();
        one.lamp = lamp.name;
        one.file = lamp.file->name;
        one.height_m = lamp.position_m.z;
        one.band = r48_band(one.height_m);
        one.by = mark.by;
        one.why_not = mark.why_not;
        one.has_kink = mark.h_deg.has_value();
        if (!one.band)
            one.why_not = fmt::format("it is mounted {:.2f} m over the road, and R48 allows a car's low beams 0.5 to 1.2 m", one.height_m);
        if (!mark.v_deg)
            mark.v_deg = 0.0; // which way it looks is reported all the same
        else
            add_inclinations(one, {&lamp, mark}, found.bodies);
        beams.push_back({&lamp, std::move(mark)});
    }
    if (beams.empty())
        throw InputError({stage.drive.file, 0, 0, "lamp_sets." + lamp_set.name + ".lamps"}, "found no low beam", "one, as 'left'");
    add_kinks(found.lamps, beams, stage, lamp_set, wheelbase_m * car.front_load);
    return found;
}

const char* name_of(InstallationVerdict verdict) {
    static constexpr const char* names[]{"within", "not_met", "not_measured", "not_applicable"};
    return names[static_cast<int>(verdict)];
}

} // namespace fernlicht
