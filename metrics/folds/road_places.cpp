#include "metrics/folds/road_places.h"

#include <cmath>

namespace fernlicht {

std::optional<double> offset_across_m(const CrossSection& section, Across across) {
    if (across == Across::own_centre)
        return 0.0;
    std::optional<double> offset_m;
    for (const RouteLane& lane : section.lanes) {
        if (lane.type != "driving")
            continue;
        const double centre_m = 0.5 * (lane.left_m + lane.right_m);
        if (across == Across::right_edge && (!offset_m || lane.right_m < *offset_m))
            offset_m = lane.right_m;
        if (across == Across::left_edge && (!offset_m || lane.left_m > *offset_m))
            offset_m = lane.left_m;
        if (across == Across::oncoming_centre && !lane.same_direction && (!offset_m || std::abs(centre_m) < std::abs(*offset_m)))
            offset_m = centre_m;
    }
    return offset_m;
}

std::string place_name(Across across) {
    switch (across) {
    case Across::own_centre:
        return "centre of the own lane";
    case Across::oncoming_centre:
        return "centre of the nearest oncoming lane";
    case Across::right_edge:
        return "right edge of the lanes";
    case Across::left_edge:
        break;
    }
    return "left edge of the lanes";
}

} // namespace fernlicht
