#include "metrics/folds/reading_names.h"

#include "scenarios/values/errors.h"
#include "scenarios/values/refusals.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <utility>
#include <vector>

namespace fernlicht {
namespace {

void check_subjects(const Drive& drive) {
    const auto check = [&](SubjectKind kind, const std::string& key, const auto& named) {
        for (const auto& each : named)
            if (!is_clear_subject(kind, each.name))
                refuse_and_go_on(
                    InputError({drive.file, 0, 0, "measure." + key}, "found the name '" + printable(each.name) + "'",
                               "one that no reading's name would take for a part of its own, such as _min, _max, _twin or own"));
    };
    const SeeingParameters& asked = drive.seeing;
    check(SubjectKind::probe, "probes", drive.probes);
    if (asked.sensors)
        check(SubjectKind::sensor, "sensors.points", asked.sensors->points);
    if (asked.glare)
        check(SubjectKind::eye, "glare.oncoming", asked.glare->oncoming);
    if (asked.glare && asked.glare->mirrors)
        check(SubjectKind::mirror, "glare.mirrors.places", asked.glare->mirrors->mirrors);
    if (asked.visibility)
        check(SubjectKind::target, "visibility.targets", asked.visibility->targets);
}

/// "own", "left 1" ... "all": what extents along the route are of.
std::vector<std::string> lanes_of(const Route& route) {
    constexpr double every_m = 1.0; // shorter lanes are no lanes to set a limit on
    std::set<std::string> beside;
    for (double at_m = 0.0; at_m < route.length_m(); at_m += every_m)
        for (const RouteLane& lane : route.cross_section(at_m).lanes)
            beside.insert(lane.name);
    beside.erase("own");
    std::vector<std::string> lanes{"own"};
    lanes.insert(lanes.end(), beside.begin(), beside.end());
    lanes.emplace_back("all");
    return lanes;
}

/// What extents lack for the reading: a key of `measure: extent`, where that is there, or the lane. "" for nothing.
std::string lacks_of_extent(const Drive& drive, const Route* route, const ReadingKey& key) {
    if (!is_extent(key))
        return "";
    if (route && key.lane != "own" && key.lane != "all")
        if (const std::vector<std::string> lanes = lanes_of(*route); std::ranges::find(lanes, key.lane) == lanes.end())
            return fmt::format("a lane of this route: {}", fmt::join(lanes, ", "));
    if (!drive.extent)
        return "";
    const auto has = [](const std::vector<double>& values, double value) { return std::ranges::find(values, value) != values.end(); };
    if (key.threshold.unit == ThresholdUnit::lx && !has(drive.extent->thresholds_lx, key.threshold.value))
        return fmt::format("{:g} in `thresholds_lx` of `measure: extent`, which asks for it", key.threshold.value);
    if (key.quantity == Quantity::width && key.distance_m && !has(drive.extent->width_at_m, *key.distance_m))
        return fmt::format("{:g} in `width_at_m` of `measure: extent`, which asks for it", *key.distance_m);
    return "";
}

bool can_be_read(const Drive& drive, const Readings& others, const Route* route, ReadingKey key) {
    if (is_of_cars(key)) {
        if (!drive.seeing.tolerances)
            return false;
        const std::vector<Limit>& limits = drive.seeing.tolerances->limits;
        if (key.quantity == Quantity::cars_within)
            return key.subject == "all" ? limits.size() > 1 : std::ranges::find(limits, key.subject, &Limit::reading) != limits.end();
        key.aspect = Aspect::value;
    }
    return (is_extent(key) && lacks_of_extent(drive, route, key).empty()) || is_time(key) ||
           (key.quantity == Quantity::probe_illuminance &&
            std::ranges::find(drive.probes, key.subject, &Probe::name) != drive.probes.end()) ||
           std::ranges::find(others, key, &Reading::key) != others.end();
}

} // namespace

std::string asked_for_by(std::string_view name) {
    static constexpr std::pair<std::string_view, const char*> rows[]{
        {"glare_", "glare"},           {"mirror_", "glare"},          {"sensor_", "sensors"},
        {"detection_", "visibility"},  {"undetected_", "visibility"}, {"visibility_", "visibility"},
        {"background_", "visibility"}, {"mesopic_", "visibility"},    {"uniformity_", "homogeneity"},
        {"gradient_", "homogeneity"},  {"patch_", "homogeneity"},     {"foreground_", "homogeneity"},
        {"kerb_", "places"},           {"board_", "places"},          {"marking_", "places"},
        {"reach_", "extent"},          {"unlit_", "extent"},          {"width_", "extent"},
        {"area_", "extent"},
    };
    const auto found = std::ranges::find_if(rows, [&](const auto& row) { return name.starts_with(row.first); });
    return found == std::end(rows) ? "" : found->second;
}

void check_names(const Drive& drive, const Readings& others, const Route* route) {
    check_subjects(drive);
    if (drive.seeing.tolerances)
        for (const Limit& limit : drive.seeing.tolerances->limits)
            if (const auto key = key_of(limit.reading); !key || key->aspect != Aspect::value || !can_be_read(drive, others, route, *key))
                refuse_and_go_on(InputError({drive.file, 0, 0, "measure.tolerances.limits"},
                                            "found reading '" + printable(limit.reading) + "'",
                                            "a reading of this drive, as reach_5lx_target_own_right_edge_m"));
    const ExtentParameters extent = drive.extent.value_or(ExtentParameters{});
    std::vector<std::string> known; // of extents the usual ones
    for (const double lx : extent.thresholds_lx)
        for (const char* const surface : {"road", "target"}) {
            for (const char* const lane : {"own", "all", "own_right_edge"})
                known.push_back(fmt::format("reach_{:g}lx_{}_{}_m", lx, surface, lane));
            known.push_back(fmt::format("area_{:g}lx_{}_own_m2", lx, surface));
            for (const double at_m : extent.width_at_m)
                known.push_back(fmt::format("width_{:g}lx_{}_all_at_{:g}m_m", lx, surface, at_m));
        }
    for (const Reading& other : others)
        known.push_back(name_of(other.key));
    for (const Limit& limit : drive.limits)
        if (const auto key = key_of(limit.reading); !key || !can_be_read(drive, others, route, *key)) {
            const std::string measure = key ? asked_for_by(limit.reading) : "";
            const bool is_measured =
                std::ranges::any_of(others, [&](const auto& other) { return asked_for_by(name_of(other.key)) == measure; });
            const std::string nearest = nearest_name(limit.reading, known);
            const std::string lacks = key ? lacks_of_extent(drive, route, *key) : "";
            refuse_and_go_on(InputError({drive.file, limit.line, 0, "limits"}, "found reading '" + printable(limit.reading) + "'",
                                        !lacks.empty()                     ? lacks
                                        : !measure.empty() && !is_measured ? fmt::format("`{}` in `measure:`, which asks for it", measure)
                                        : nearest.empty() ? "a name as reach_5lx_road_own_m, width_3lx_target_all_at_50m_m, "
                                                            "probe_NAME_lx of a probe of this drive or frame_time_median_ms"
                                                          : "a reading of this drive (the nearest is '" + nearest + "')"));
        }
}

} // namespace fernlicht
