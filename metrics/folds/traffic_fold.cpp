#include "metrics/folds/traffic_fold.h"

#include <algorithm>
#include <cmath>

namespace fernlicht {

TrafficFold::TrafficFold(const Drive& drive) : drive_(drive) {
    const auto view = std::ranges::find(drive.views, Projection::perspective, &View::projection);
    if (view != drive.views.end())
        eye_m_ = view->position_m;
    for (const RoadUser& user : drive.traffic)
        boxes_.push_back({user.size_m, user.rear_m});
}

void TrafficFold::add(const Moment& moment) {
    const std::vector<GlareSource> sources = traffic_glare(moment, to_parent(moment.ego, eye_m_), moment.ego.forward(), boxes_);
    double facing = 0.0;
    for (const GlareSource& source : sources)
        facing += source.eye_lx / std::cos(radians(source.theta_deg));
    // How many lamps are seen changes from moment to moment: their angles are not followed.
    eye_.add(moment, moment.distance_m, {}, glare_figures(sources, facing, *drive_.seeing.glare));
}

Readings TrafficFold::readings() const {
    Readings readings;
    eye_.say(readings, {.quantity = Quantity::glare_facing, .place = ReadingPlace::own_eyes}, "own driver's eye, lamps of others", "",
             *drive_.seeing.glare);
    return readings;
}

} // namespace fernlicht
