#include "runner/findings/series.h"

namespace fernlicht {
namespace {

JsonPart count_part(std::size_t& count) {
    return through([&count] { return std::uint64_t{count}; }, [&count](std::uint64_t given) { count = given; });
}

JsonMembers tolerance_members(Tolerance& tolerance) {
    return {{"sigma", tolerance.sigma},
            {"mean", tolerance.mean},
            {"from", tolerance.from},
            {"to", tolerance.to},
            {"source", or_null(tolerance.source)}};
}

JsonMembers car_part_members(CarPart& part) {
    return {{"kind", one_of(part.kind, names_of<ToleranceKind>([](ToleranceKind kind) { return name_of(kind); }, tolerance_kinds))},
            {"unit", std::string(unit_of(part.kind))},
            {"lamp", or_null(part.lamp)},
            {"tolerance", tolerance_members(part.tolerance)}};
}

JsonMembers reading_of_cars_members(ReadingOfCars& of) {
    return {{"reading", of.key},
            {"as_designed", of.as_designed},
            {"p05", of.p05},
            {"median", of.median},
            {"p95", of.p95},
            {"by_slopes", of.by_slopes},
            {"slope_error", of.slope_error},
            {"spread", of.spread},
            {"variance_shares", of.variance_shares}};
}

JsonMembers within_members(CarsWithin& within) {
    return {{"reading", within.limit.reading},       {"at_least", within.limit.at_least},        {"at_most", within.limit.at_most},
            {"share_percent", within.share_percent}, {"low_percent", within.low_percent},        {"high_percent", within.high_percent},
            {"of", std::uint64_t{within.of}},        {"in_full_percent", within.in_full_percent}};
}

} // namespace

JsonMembers series_members(SeriesFindings& series) {
    return {{"drawn", count_part(series.draws)},
            {"in_full", count_part(series.cars)},
            {"rendered", series.rendered},
            {"parts", series.parts, car_part_members},
            {"readings", series.readings, reading_of_cars_members},
            {"within", series.within, within_members}};
}

} // namespace fernlicht
