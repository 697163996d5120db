#include "metrics/regulation/named_places.h"

#include "metrics/regulation/regulation_check.h"
#include "metrics/regulation/rows.h"

#include <algorithm>

namespace fernlicht {
namespace {

const RegulationRow& table_row(const Regulation& table, const std::string& id) {
    return *std::ranges::find(table.rows, id, &RegulationRow::id);
}

BeamPlace of_table(const char* id, const char* row, const char* what) {
    const Regulation& table = regulation(id);
    return {row, what, table_row(table, row).places, table.title};
}

/// The trapezium between the outer ones of the six directions at which light for signs is measured.
BeamPlace signs() {
    const Regulation& table = regulation("r112-b");
    const std::vector<Direction>&upper = table_row(table, "B1 + B2 + B3").places, &lower = table_row(table, "B4 + B5 + B6").places;
    return {"signs", "signs overhead", {upper.front(), upper.back(), lower.back(), lower.front()}, table.title + ": between B1 to B6"};
}

/// Heights on the road are those of a lamp 0.65 m high.
void add_sides_and_foreground(std::vector<BeamPlace>& places) {
    const char* const width = "ours: beyond the test points on the road, which end near 15 degrees, 7 to 37 m ahead; no text has a region";
    places.push_back({"width left", "the side of the road: bends, crossings", rectangle(-35.0, -15.0, -5.0, -1.0), width});
    places.push_back({"width right", "the side of the road: bends, crossings", rectangle(15.0, 35.0, -5.0, -1.0), width});
    places.push_back({"foreground", "the road nearer than 9 m", rectangle(-15.0, 15.0, -10.0, -4.0),
                      "ours: below 4 D, where R149 has its segment 10; that is narrower"});
}

bool has_high_beams_peak(const CandelaTable& table) { return intensity_cd(table, 0.0, 0.0) >= 0.5 * peak_of(table).cd; }

} // namespace

std::vector<BeamPlace> low_beam_places(TrafficSide side) {
    std::vector<BeamPlace> places{
        {"kerb shoulder", "kerb, verge and who walks there", rectangle(2.0, 9.0, -1.72, 0.0),
         "ours: right of 75R and 50R, under the rise of the cut-off, out to 25R; no text has a region"},
        of_table("r149-c", "75R", "the kerb side, 75 m ahead"),
        of_table("r149-c", "50R", "the kerb side, 50 m ahead"),
        of_table("r149-c", "50V", "the own lane, 50 m ahead"),
        of_table("r149-c", "50L", "the oncoming lane, 50 m ahead"),
        of_table("r149-c", "25V", "the own lane, 25 m ahead"),
        of_table("r112-b", "25L", "left of the road, 25 m ahead"),
        of_table("r112-b", "25R", "right of the road, 25 m ahead"),
        {"HV", "straight ahead", {{0.0, 0.0}}, "the goniometer's origin"},
        of_table("r149-c", "B50L", "glare: an oncoming driver, 50 m ahead"),
        of_table("r149-c", "BR", "glare: the kerb side"),
        of_table("r149-c", "zone III", "glare above the cut-off"),
        signs(),
        of_table("r112-b", "zone IV", "the road 20 to 45 m ahead"),
        of_table("r112-b", "zone I", "the road 10 to 20 m ahead"),
    };
    add_sides_and_foreground(places);
    if (side == TrafficSide::left)
        for (BeamPlace& place : places) {
            place.name = mirrored_name(place.name);
            place.what = mirrored_name(place.what);
            for (Direction& d : place.corners)
                d.h_deg = 0.0 - d.h_deg;
        }
    return places;
}

std::vector<BeamPlace> high_beam_places() {
    const char* const table = "r149-driving-b";
    std::vector<BeamPlace> places{of_table(table, "HV", "straight ahead"), of_table(table, "2U-V", "above the road")};
    for (const char* row : {"H-3L", "H-3R", "H-6L", "H-6R", "H-9L", "H-9R", "H-12L", "H-12R"})
        places.push_back(of_table(table, row, "far ahead, to the side"));
    places.push_back(signs());
    add_sides_and_foreground(places);
    return places;
}

LampDifference compare_by_name(const SampledBeam& tested, const SampledBeam& against, LampDifferenceOptions options) {
    const TrafficSide side = traffic_side_of(*tested.table), side_against = traffic_side_of(*against.table);
    const bool has_elbow = side != TrafficSide::unknown || side_against != TrafficSide::unknown;
    const bool is_high = !has_elbow && has_high_beams_peak(*tested.table) && has_high_beams_peak(*against.table);
    options.places = is_high ? high_beam_places() : low_beam_places(side_against != TrafficSide::unknown ? side_against : side);
    LampDifference difference = compare_lamps(tested, against, options);
    difference.side = side;
    difference.side_against = side_against;
    return difference;
}

} // namespace fernlicht
