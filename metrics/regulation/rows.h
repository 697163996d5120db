// Short notation for rows of the tables.
#pragma once

#include "metrics/regulation/regulation.h"

#include <utility>

namespace fernlicht {

/// 65 mm at 25 m: atan(0.065 / 25). UN R149 01 series, annex 4; R123, annex 9.
inline constexpr Receiver un_receiver{Receiver::Shape::square, 0.148969};
/// A circle of 0.009 times the distance: 2 atan(0.0045). FMVSS 108, S14.2.5.7.2.
inline constexpr Receiver fmvss_receiver{Receiver::Shape::disc, 0.515659};

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

inline Limits at_least(double cd) { return {cd, no_limit}; }
inline Limits at_most(double cd) { return {0.0, cd}; }
inline Limits between(double min_cd, double max_cd) { return {min_cd, max_cd}; }

inline RegulationRow point(std::string id, double h_deg, double v_deg, Limits limits) {
    return {std::move(id), RowKind::point, {{h_deg, v_deg}}, limits};
}

/// Level, from H to H at one V.
inline RegulationRow segment(std::string id, double h_from_deg, double h_to_deg, double v_deg, Limits limits) {
    return {std::move(id), RowKind::segment, {{h_from_deg, v_deg}, {h_to_deg, v_deg}}, limits};
}

inline RegulationRow zone(std::string id, std::vector<Direction> corners, Limits limits) {
    return {std::move(id), RowKind::zone, std::move(corners), limits};
}

inline std::vector<Direction> rectangle(double h_from_deg, double h_to_deg, double v_from_deg, double v_to_deg) {
    return {{h_from_deg, v_from_deg}, {h_to_deg, v_from_deg}, {h_to_deg, v_to_deg}, {h_from_deg, v_to_deg}};
}

inline RegulationRow sum_of(std::string id, std::vector<Direction> places, Limits limits) {
    return {std::move(id), RowKind::sum, std::move(places), limits};
}

inline RegulationRow brightest(std::string id, std::vector<Direction> corners, Limits limits) {
    return {std::move(id), RowKind::brightest, std::move(corners), limits};
}

inline RegulationRow noted(RegulationRow row, std::string note) {
    row.note = std::move(note);
    return row;
}

inline RegulationRow sure(RegulationRow row, Sureness sureness) {
    row.sureness = sureness;
    return row;
}

inline RegulationRow scoped(RegulationRow row, Scope scope) {
    row.scope = scope;
    return row;
}

inline RegulationRow at_least_of(RegulationRow row, std::string of, double ratio) {
    row.ratio_of = std::move(of);
    row.ratio = ratio;
    return row;
}

inline RegulationRow at_most_of(RegulationRow row, std::string of, double ratio) {
    row = at_least_of(std::move(row), std::move(of), ratio);
    row.ratio_is_minimum = false;
    return row;
}

/// A table of the UN's, still without rows.
inline Regulation un_table(std::string id, std::string title, std::string edition, std::string source) {
    return {.id = std::move(id),
            .title = std::move(title),
            .edition = std::move(edition),
            .source = std::move(source),
            .receiver = un_receiver};
}

/// Zone III of UN R112, R98, R149 and (as III a) R123: the dark side above the cut-off.
inline const std::vector<Direction> zone_3{{-8, 1}, {-8, 4}, {8, 4}, {8, 2}, {6, 1.5}, {1.5, 1.5}, {0, 0}, {-4, 0}};

/// Light for signs overhead: sums over three directions at 4 U and at 2 U.
inline const std::vector<Direction> signs_4u{{-8, 4}, {0, 4}, {8, 4}}, signs_2u{{-4, 2}, {0, 2}, {4, 2}};

/// Every direction that a goniometer reaches: where a text says "maximum" without a place.
inline const std::vector<Direction> everywhere = rectangle(-180, 180, -90, 90);

/// A line that an adaptive driving beam keeps dark for one vehicle.
struct AdaptiveLine {
    std::string id, title; ///< "oncoming-50m"
    std::vector<RegulationRow> rows;
};
/// UN R123, annex 3, table 7, part A.
const std::vector<AdaptiveLine>& adaptive_lines();

/// The families, each in a file of its own.
std::vector<Regulation> r149_regulations();
std::vector<Regulation> r112_and_r98_regulations();
std::vector<Regulation> r123_regulations();
std::vector<Regulation> fmvss108_regulations();

} // namespace fernlicht
