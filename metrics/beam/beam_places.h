// Places of a beam that have a name in the trade: test points and regions. What two lamps give there, and which of them a zone holds.
// The side of the road that a lamp is for.
#pragma once

#include "metrics/beam/beam_field.h"
#include "metrics/beam/beam_zones.h"
#include "metrics/beam/received_beam.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

struct BeamPlace {
    std::string name;               ///< "75R", "kerb shoulder"
    std::string what;               ///< what its light is for
    std::vector<Direction> corners; ///< one: a point; else a polygon's, in order, not crossing itself
    std::string source;             ///< the table that has it, or why we put it there

    bool is_point() const { return corners.size() == 1; }
};

/// Even-odd rule.
bool is_within(const std::vector<Direction>& polygon, Direction d);
/// The point; of a region the middles of cells of equal size, 32 over its width and 32 over its height, that lie in it.
std::vector<Direction> directions_of(const BeamPlace& place);

/// At a place two lamps as their tables have them, no shift undone: at a point the intensity, over a region its mean.
struct PlaceChange {
    BeamPlace place;
    std::optional<double> old_cd, new_cd; ///< nullopt: outside a table
    std::optional<double> uncertainty;    ///< of `change`: standard error of both tables' noise, and what interpolation leaves open
    bool is_beyond_noise = false;         ///< by the limit of the zones
    std::string not_measured;             ///< why there is no change; "" where there is one

    /// 0.05: 5 % brighter.
    std::optional<double> change() const {
        return not_measured.empty() && old_cd && new_cd ? std::optional(*new_cd / *old_cd - 1.0) : std::nullopt;
    }
};

/// One of the two lamps. `source`: which stored sample each one of the table is, as ResidualGrid has it.
struct PlaceSide {
    const BeamField& field;
    const std::vector<std::size_t>& source;
};

struct PlaceLimits {
    double floor_cd = 0.0, darkest_cd = 0.0; ///< fainter light is not compared; below this there is none to divide by
    double z_limit = 0.0;
    bool is_same_grid = false;                ///< both have the same angles: interpolation errs alike
    std::function<double(double)> noise_of{}; ///< standard deviation of one sample's log, by its intensity in cd
};

/// By each table's own rule between its samples. A sample's noise counts as much as the place takes of it, so a region's mean is known
/// better than a point. Interpolation leaves open how far cubic in log cd lies from that; where both tables have the same angles, how far
/// the ratio does. Of a region at least half must lie in both tables; the rest is left out.
PlaceChange change_at(const BeamPlace& place, const PlaceSide& before, const PlaceSide& now, const PlaceLimits& limits);

/// Says of each zone of `grid`, whose axes `tested` has, what it holds: all light, all on one side of the cut-off (four fifths of that area
/// and less than a fifth of the other's), else the places of which it holds at least half (of wide ones points alone), or, where it holds
/// none, the smallest region that holds at least half of it.
void name_zones(std::vector<BeamZone>& zones, const ResidualGrid& grid, const BeamField& tested, const CutOffLine& line,
                const std::vector<BeamPlace>& places);

enum class TrafficSide { unknown, right, left };
const char* traffic_side_name(TrafficSide side); ///< "unknown", "right", "left"

/// Left-hand traffic's cut-off rises to the left: by the elbow of the beam and of its mirror image. Unknown where neither or both have one.
TrafficSide traffic_side_of(const CandelaTable& table);

} // namespace fernlicht
