#include "metrics/folds/target_squares.h"

#include "metrics/folds/place_fold.h"
#include "metrics/glare/wet_road.h"
#include "scenarios/light/light.h"
#include "scenarios/roads/mesh/mesh_materials.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>

namespace fernlicht {
namespace {

/// The road behind a target is known so much farther than targets stand: from an eye of 1.2 m, a target's middle of 0.1 m hides what lies
/// an eleventh farther.
constexpr double known_behind_m = 100.0;
constexpr double far_m = 1000.0; ///< where the line of sight ends that meets no road: in fog all light of the lamps comes from nearer

/// What is not road behind a target shines as the sky does: diffusely, where there is daylight. In fog it is the same: what the air takes
/// of the sky's light it gives back.
double dark_behind_cdm2(const Moment& moment, const VisibilityParameters& asked) {
    return std::max(asked.dark_cdm2, moment.daylight.horizontal_illuminance_lx / pi);
}

} // namespace

SeenLane::SeenLane(const Drive& drive, const Route& route, const VisibilityParameters& asked, const Moment& moment)
    : lane(route, moment.distance_m + drive.bumper_m, asked.ahead_m + known_behind_m, asked.step_m),
      eye(lane.origin(to_parent(moment.ego, driver_eye_m(drive)))) {
    for (const LitLamp& lamp : moment.lamps)
        lamps.push_back(lane.origin(lamp.pose.position_m));
}

double TargetSquare::target_cdm2(double reflectance) const { return left * reflectance * illuminance_lx / pi + veil_cdm2; }

std::vector<TargetSquare> target_squares(const Moment& moment, const SeenLane& seen, const Route& route, double along_m, Across across,
                                         double size_m, int squares) {
    const glm::dvec3& eye_m = seen.eye.at_m;
    std::vector<TargetSquare> all;
    const std::optional<Pose> foot = place_on_road(route, across, along_m);
    if (!foot)
        return all;
    const std::string no_mirror = why_no_mirror(moment.weather, road_plane(moment.ego, *foot));
    for (int i = 0; i < squares; ++i) {
        const glm::dvec3 middle = foot->position_m + (i + 0.5) * size_m * foot->up();
        TargetSquare& square = all.emplace_back();
        square.middle_m = middle;
        square.face = -foot->forward();
        square.size_arcmin = arc_minutes_of(size_m, glm::distance(eye_m, middle));
        square.hidden = seen.lane.hides(seen.eye, middle);
        square.no_mirror = no_mirror;
        if (const std::optional<Pose> road = seen.lane.behind(seen.eye, middle)) {
            square.on_road = true;
            square.behind_m = road->position_m;
            square.road_up = road->up();
        } else if (i > 0)
            square.behind_m = eye_m + far_m * glm::normalize(middle - eye_m);
        else
            square.unknown = "the line of sight does not meet the road behind the target";
        if (square.unknown.empty())
            square.unknown = square.no_mirror;
        const auto hides = [&](const LaneAhead::Origin& lamp) { return seen.lane.hides(lamp, middle); };
        if (!square.hidden && std::ranges::any_of(seen.lamps, hides))
            std::ranges::transform(seen.lamps, std::back_inserter(square.unlit), hides);
        if (!all.front().unknown.empty())
            return all; // without a road behind its foot nothing tells what the eye is adapted to
    }
    return all;
}

void light_squares(const Moment& moment, const glm::dvec3& eye_m, const VisibilityParameters& asked, Pavement behind,
                   std::vector<TargetSquare>& squares) {
    double adaptation_cdm2 = 0.0; // of the road behind the lowest square
    for (TargetSquare& square : squares) {
        if (square.on_road) {
            square.background_cdm2 =
                surface_luminance(moment, square.behind_m, square.road_up, pavement_material(behind), eye_m).photopic_cdm2;
            if (adaptation_cdm2 == 0.0)
                adaptation_cdm2 = square.background_cdm2;
            square.adaptation_cdm2 = square.background_cdm2;
        } else if (&square != &squares.front()) {
            square.background_cdm2 = dark_behind_cdm2(moment, asked);
            square.adaptation_cdm2 = std::max(adaptation_cdm2, square.background_cdm2);
        }
        if (!square.hidden && square.unknown.empty())
            square.illuminance_lx = surface_illuminance_lx(square.unlit.empty() ? moment : lamps_reaching(moment, square), square.middle_m,
                                                           square.face); // nearly everywhere without a copy
    }
}

Moment lamps_reaching(const Moment& moment, const TargetSquare& square) {
    Moment lit = moment;
    lit.lamps.clear();
    for (std::size_t i = 0; i < moment.lamps.size(); ++i)
        if (square.unlit.empty() || !square.unlit[i])
            lit.lamps.push_back(moment.lamps[i]);
    return lit;
}

Value square_level(const TargetSquare& square, double reflectance, const VisibilityParameters& asked) {
    if (square.hidden)
        return 0.0;
    if (!square.unknown.empty())
        return Value::not_measured(square.unknown);
    return visibility_level(square.target_cdm2(reflectance), square.background_cdm2, square.adaptation_cdm2, square.size_arcmin,
                            {asked.age_years, asked.time_s, asked.k});
}

Value target_level(const std::vector<TargetSquare>& squares, double reflectance, const VisibilityParameters& asked) {
    std::optional<double> clearest;
    std::string reason;
    for (const TargetSquare& square : squares) {
        const Value value = square_level(square, reflectance, asked);
        if (const auto number = value.number())
            clearest = std::max(clearest.value_or(0.0), *number);
        else if (reason.empty())
            reason = value.reason();
    }
    return clearest ? Value(*clearest) : Value::not_measured(reason);
}

Value known_detection(double metres, const std::vector<LineSample>& levels, double wanted, bool to_routes_end) {
    const auto known = std::find_if(levels.rbegin(), levels.rend(), [](const LineSample& sample) { return sample.lx.has_value(); });
    return known == levels.rend() || *known->lx < wanted ? Value(metres)
           : to_routes_end                               ? Value::not_measured("cut off by the end of the road or lane")
                                                         : Value::at_least(metres);
}

ReadingKey detection_key(const VisibilityTarget& target, Across across) {
    return {.quantity = Quantity::detection,
            .subject = target.name,
            .lane = across == Across::own_centre        ? "own"
                    : across == Across::oncoming_centre ? "oncoming"
                                                        : "",
            .place = across == Across::right_edge  ? ReadingPlace::right
                     : across == Across::left_edge ? ReadingPlace::left
                                                   : ReadingPlace::none};
}

} // namespace fernlicht
