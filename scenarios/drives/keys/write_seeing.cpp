#include "scenarios/drives/keys/seeing_keys.h"

#include "scenarios/drives/keys/flow_list.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>

namespace fernlicht {
namespace {

std::string_view word(Across across) {
    return across == Across::own_centre        ? "own-centre"
           : across == Across::oncoming_centre ? "oncoming-centre"
           : across == Across::right_edge      ? "right-edge"
                                               : "left-edge";
}

std::string_view word(VeilingEquation equation) {
    return equation == VeilingEquation::stiles_holladay ? "stiles-holladay"
           : equation == VeilingEquation::age_adjusted  ? "age-adjusted"
                                                        : "cie-general";
}

/// Names are made of letters, digits and "-_.": quotes are for those that look like numbers.
std::string sensors(const SensorParameters& sensors) {
    std::string text = fmt::format("  sensors:\n    limits_lx: {}\n    distances_m: {}\n    points:\n", flow_list(sensors.limits_lx),
                                   flow_list(sensors.distances_m));
    for (const Sensor& sensor : sensors.points)
        text += fmt::format("      \"{}\": {{at_m: {}, across: {}, above_m: {}}}\n", sensor.name, sensor.at_m, word(sensor.across),
                            sensor.above_m);
    return text;
}

std::string glare(const GlareParameters& glare) {
    std::string text = "  glare:\n";
    if (!glare.oncoming.empty())
        text += "    oncoming:\n";
    for (const GlareObserver& observer : glare.oncoming)
        text += fmt::format("      \"{}\": {{at_m: {}, eye_height_m: {}, look_ahead_m: {}}}\n", observer.name, observer.at_m,
                            observer.eye_height_m, observer.look_ahead_m);
    if (const auto& mirrors = glare.mirrors) {
        text += fmt::format("    mirrors:\n      gaps_m: {}\n      eye_m: {}\n      reflectance: {}\n      places:\n",
                            flow_list(mirrors->gaps_m), flow_list(mirrors->eye_m), mirrors->reflectance);
        for (const Mirror& mirror : mirrors->mirrors)
            text += fmt::format("        \"{}\": {}\n", mirror.name, flow_list(mirror.position_m));
    }
    text += fmt::format("    equation: {}\n    age_years: {}\n    pigmentation: {}\n    adaptation_cdm2: {}\n", word(glare.equation),
                        glare.age_years, glare.pigmentation, glare.adaptation_cdm2);
    text += fmt::format("    distances_m: {}\n    limits_lx: {}\n    limits_percent: {}\n    limits_de_boer: {}\n",
                        flow_list(glare.distances_m), flow_list(glare.limits_lx), flow_list(glare.limits_percent),
                        flow_list(glare.limits_de_boer));
    return text;
}

std::string visibility(const VisibilityParameters& v) {
    std::string text = "  visibility:\n    targets:\n";
    for (const VisibilityTarget& target : v.targets) {
        if (std::ranges::find(usual_targets(), target) != usual_targets().end()) {
            text += fmt::format("      \"{}\": true\n", target.name);
            continue;
        }
        std::vector<std::string> places;
        for (const Across across : target.places)
            places.emplace_back(word(across));
        text += fmt::format("      \"{}\": {{size_m: {}, squares: {}, reflectance: {}, level: {}, across: [{}]}}\n", target.name,
                            target.size_m, target.squares, target.reflectance, target.level, fmt::join(places, ", "));
    }
    return text +
           fmt::format(
               "    dark_cdm2: {}\n    age_years: {}\n    time_s: {}\n    k: {}\n    ahead_m: {}\n    step_m: {}\n    distances_m: {}\n",
               v.dark_cdm2, v.age_years, v.time_s, v.k, v.ahead_m, v.step_m, flow_list(v.distances_m));
}

std::string homogeneity(const HomogeneityParameters& h) {
    return fmt::format("  homogeneity: {{least_lx: {}, ahead_m: {}, patch_factor: {}}}\n", h.least_lx, h.ahead_m, h.patch_factor);
}

std::string places(const PlaceParameters& p) {
    std::vector<std::string> what;
    for (const auto& [asked, name] : {std::pair(p.kerb, "kerb"), std::pair(p.boards, "boards"), std::pair(p.markings, "markings")})
        if (asked)
            what.emplace_back(name);
    return fmt::format("  places: {{what: [{}], distances_m: {}}}\n", fmt::join(what, ", "), flow_list(p.distances_m));
}

} // namespace

std::string write_seeing(const SeeingParameters& seeing) {
    return (seeing.sensors ? sensors(*seeing.sensors) : "") + (seeing.glare ? glare(*seeing.glare) : "") +
           (seeing.visibility ? visibility(*seeing.visibility) : "") + (seeing.homogeneity ? homogeneity(*seeing.homogeneity) : "") +
           (seeing.places ? places(*seeing.places) : "");
}

} // namespace fernlicht
