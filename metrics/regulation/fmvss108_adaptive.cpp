#include "metrics/regulation/fmvss108_adaptive.h"

#include "metrics/regulation/rows.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

bool holds(const AngleBox& box, Direction d) {
    return d.h_deg >= box.left_deg && d.h_deg <= box.right_deg && d.v_deg >= box.bottom_deg && d.v_deg <= box.top_deg;
}

std::string edges_of(const AngleBox& box) {
    return fmt::format("H {:.2f} to {:.2f}, V {:.2f} to {:.2f}", box.left_deg, box.right_deg, box.bottom_deg, box.top_deg);
}

/// The part of a level segment or an upright rectangle in the box; a point as it is. nullopt: none of it.
std::optional<RegulationRow> cut_to(const AngleBox& box, RegulationRow row) {
    AngleBox all{180, -180, 90, -90};
    for (const Direction place : row.places)
        all = {std::min(all.left_deg, place.h_deg), std::max(all.right_deg, place.h_deg), std::min(all.bottom_deg, place.v_deg),
               std::max(all.top_deg, place.v_deg)};
    const AngleBox cut{std::max(all.left_deg, box.left_deg), std::min(all.right_deg, box.right_deg),
                       std::max(all.bottom_deg, box.bottom_deg), std::min(all.top_deg, box.top_deg)};
    if (cut.left_deg > cut.right_deg || cut.bottom_deg > cut.top_deg)
        return std::nullopt;
    if (cut != all) {
        row.places = row.kind == RowKind::segment ? std::vector<Direction>{{cut.left_deg, cut.bottom_deg}, {cut.right_deg, cut.top_deg}}
                                                  : rectangle(cut.left_deg, cut.right_deg, cut.bottom_deg, cut.top_deg);
        row.note = "the part of it that is dimmed";
    }
    return row;
}

/// What lies between two areas, as one polygon: round the outer one, by a slit of no width to the inner one, round it the other way, back.
std::vector<Direction> frame_between(const AngleBox& outer, const AngleBox& inner) {
    std::vector<Direction> corners = rectangle(outer.left_deg, outer.right_deg, outer.bottom_deg, outer.top_deg);
    std::vector<Direction> hole = rectangle(inner.left_deg, inner.right_deg, inner.bottom_deg, inner.top_deg);
    corners.push_back(corners.front());
    hole.push_back(hole.front());
    corners.insert(corners.end(), hole.rbegin(), hole.rend());
    return corners;
}

const Regulation& of_family(const std::string& id, const char* beam, const char* expected) {
    const Regulation& r = regulation(id);
    if (!r.id.starts_with(beam))
        throw InputError({{}, 0, 0, "--adb-tables"}, "found '" + printable(id) + "'", expected);
    return r;
}

} // namespace

Regulation fmvss108_adaptive(const AngleBox& dimmed, const std::string& lower, const std::string& upper) {
    if (!(dimmed.left_deg < dimmed.right_deg && dimmed.bottom_deg < dimmed.top_deg))
        throw std::logic_error("fmvss108_adaptive: no area");
    const Regulation& low = of_family(lower, "fmvss108-lb", "a lower beam's table first, as fmvss108-lb2v-vol");
    const Regulation& high = of_family(upper, "fmvss108-ub", "an upper beam's table second, as fmvss108-ub2");
    const AngleBox with_transition{dimmed.left_deg - transition_zone_deg, dimmed.right_deg + transition_zone_deg,
                                   dimmed.bottom_deg - transition_zone_deg, dimmed.top_deg + transition_zone_deg};
    Regulation r = low;
    r.id = "fmvss108-adb";
    r.title = "Adaptive driving beam in the laboratory, modelled on FMVSS 108 S9.4.1.6.4.3 to 5";
    r.source = "how areas meet tables: one published transcription; the tables: " + low.source;
    r.aim = AimRule::as_is;
    r.aim_note = "not aimed by itself: it keeps the aim of its lower beam; `--aim-by LOWER --aim vol` takes that over";
    r.notes = {
        fmt::format("dimmed: {}, by {}; undimmed: beyond a transition zone of 1 degree round it, by {}", edges_of(dimmed), low.id, high.id),
        high.notes.front(), "below 32 km/h, and where nothing is to be spared, other rules hold: a lower beam alone, an upper beam"};
    r.rows.clear();
    for (const RegulationRow& row : low.rows)
        if (std::optional<RegulationRow> inside = cut_to(dimmed, row)) {
            inside->id = "dimmed " + inside->id;
            r.rows.push_back(std::move(*inside));
        }
    if (r.rows.empty())
        r.notes.push_back("no place of " + low.id + " lies in the dimmed area");
    for (const RegulationRow& row : high.rows) {
        if (row.id == "H-V")
            r.rows.push_back(zone("transition zone", frame_between(with_transition, dimmed), at_most(row.limits.max_cd)));
        if (holds(with_transition, row.places.front()))
            continue;
        r.rows.push_back(row);
        r.rows.back().id = "undimmed " + row.id;
    }
    return r;
}

Regulation fmvss108_adaptive_without_rows() {
    Regulation r = fmvss108_adaptive({-1.0, 1.0, -1.0, 1.0}, "fmvss108-lb2v-vol", "fmvss108-ub2");
    r.rows.clear();
    r.notes.clear();
    return r;
}

std::optional<SparingState> sparing_state(const PixelLamp& lamp, const OtherUser& other, const LampPlace& from, double margin_deg) {
    const std::optional<AngleBox> spared = seen_box(other, from);
    if (!spared)
        return std::nullopt;
    std::vector<AngleBox> windows;
    for (std::size_t pixel = 0; pixel < lamp.count(); ++pixel)
        windows.push_back(lamp.lights(pixel));
    GlareFreeParameters how;
    how.margin_rad = radians(margin_deg);
    HighBeamParameters reach;
    reach.oncoming_m = reach.preceding_m = 1.0e6; // how far a camera sees is not the lamp's
    const std::vector<double> levels = LampWindows(windows, how).step({other}, reach, from, {}, 0.0);
    if (std::ranges::find(levels, 0.0) == levels.end())
        return std::nullopt;
    return SparingState{{levels.begin(), levels.end()}, *spared};
}

} // namespace fernlicht
