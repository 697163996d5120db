#include "runner/experiments/importance/importance_result.h"
#include "runner/files/clean_text.h"
#include "runner/findings/context_json.h"
#include "scenarios/values/exr_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>

namespace fernlicht {
namespace {

JsonMembers decider_members(ImportanceMoment& moment) {
    return {{"tick", moment.tick},
            {"time_s", moment.time_s},
            {"distance_m", moment.distance_m},
            {"share", moment.share},
            {"figure", moment.figure}};
}

JsonMembers lamp_members(ImportanceLamp& lamp) {
    return {{"lamp", lamp.lamp},   {"file", lamp.file},   {"per_percent", lamp.per_percent}, {"per_cd", lamp.per_cd},
            {"h_deg", lamp.h_deg}, {"v_deg", lamp.v_deg}, {"samples", lamp.samples}};
}

JsonMembers spot_members(ImportanceSpot& spot) {
    return {{"lamps", spot.lamps},       {"file", spot.file},         {"h_deg", spot.h_deg}, {"v_deg", spot.v_deg},
            {"cd_there", spot.cd_there}, {"foretold", spot.foretold}, {"found", spot.found}};
}

JsonMembers check_members(ImportanceCheck& check) {
    return {{"size", check.size},           {"count", check.count},         {"bounds", check.bounds},
            {"found_rms", check.found_rms}, {"error_rms", check.error_rms}, {"worst_error", check.worst_error}};
}

/// For programs that read a lamp's table beside it.
std::string unit_per_cd(const ImportanceResult& result) { return fmt::format("{}/cd", result.unit); }

} // namespace

JsonMembers importance_members(ImportanceResult& result) {
    return {{"schema", json_constant("fernlicht importance")},
            {"schema_version", json_constant(1)},
            {"context", context_members(result.context)},
            {"drive", result.drive},
            {"title", result.title},
            {"lamp_set", result.lamp_set},
            {"reading", result.reading},
            {"unit", result.unit},
            {"value", result.value},
            {"why_not_measured", or_null(result.why_not)},
            {"first_tick", result.first_tick},
            {"moments", result.moments},
            {"deciders", result.deciders, decider_members},
            {"lamps", result.lamps, lamp_members},
            {"spot_deg", result.spot_deg},
            {"spot_cd", result.spot_cd},
            {"spots", result.spots, spot_members},
            {"checks", result.checks, check_members},
            {"agrees", agrees(result)},
            {"linear_to", linear_to(result)}};
}

std::string importance_csv(const ImportanceResult& result) {
    const std::string unit = unit_per_cd(result);
    std::string out = csv_line(std::string("lamp"), std::string("file"), std::string("h_deg"), std::string("v_deg"), std::string("value"),
                               std::string("mean_of_moments"), std::string("unit"));
    const auto of_lamp = [](const BeamGradient& gradient, const LampGradient& lamp) -> const LampGradient* {
        for (const LampGradient& one : gradient)
            if (one.lamp == lamp.lamp && one.file == lamp.file)
                return &one;
        return nullptr;
    };
    const auto add = [&](const LampGradient& lamp, const LampGradient* value, const LampGradient* mean) {
        const CandelaTable& table = lamp.file->table;
        for (std::size_t i = 0; i < lamp.per_cd.size(); ++i) {
            const double by_value = value ? value->per_cd[i] : 0.0, by_mean = mean ? mean->per_cd[i] : 0.0;
            if (by_value != 0.0 || by_mean != 0.0)
                out += csv_line(csv_text(lamp.lamp), csv_text(lamp.file->name), csv_number(table.h_deg[i % table.h_deg.size()]),
                                csv_number(table.v_deg[i / table.h_deg.size()]), csv_number(by_value),
                                result.mean_gradient.empty() ? std::string() : csv_number(by_mean), csv_text(unit));
        }
    };
    for (const LampGradient& lamp : result.gradient)
        add(lamp, &lamp, of_lamp(result.mean_gradient, lamp));
    for (const LampGradient& lamp : result.mean_gradient)
        if (!of_lamp(result.gradient, lamp))
            add(lamp, nullptr, &lamp);
    return out;
}

std::string importance_exr(const ImportanceResult& result) {
    if (result.maps.empty())
        return "";
    std::vector<std::pair<std::string, Image<float>>> channels;
    for (const ImportanceMap& map : result.maps) {
        channels.emplace_back(fmt::format("{}.value", fmt::join(map.lamps, "+")), image_of_map(map.of_reading));
        if (!result.mean_gradient.empty())
            channels.emplace_back(fmt::format("{}.mean", fmt::join(map.lamps, "+")), image_of_map(map.of_mean));
    }
    std::vector<std::pair<std::string, const Image<float>*>> images;
    for (const auto& [name, image] : channels)
        images.emplace_back(name, &image);
    const SpotMap& map = result.maps.front().of_reading;
    const std::map<std::string, ExrAttribute> attributes{
        {"fernlicht:reading", result.reading},
        {"fernlicht:unit",
         fmt::format("{} for 1000 cd more in a round spot, {:g} degrees wide at half its height", result.unit, result.spot_deg)},
        {"fernlicht:h_deg", fmt::format("{} {}", map.h_deg.front(), map.h_deg.back())}, // of the middles of the first and the last column
        {"fernlicht:v_deg", fmt::format("{} {}", map.v_deg.back(), map.v_deg.front())}};
    return encode_exr(images, attributes, 1);
}

} // namespace fernlicht
