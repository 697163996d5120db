#include "scenarios/drives/edits/adapting_white.h"

#include "scenarios/display/white_adaptation.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace fernlicht {
namespace {

// Low beams give a driver's own lane 0.45 to 0.7 cd/m2 (docs/seeing.md); between 0 and 1 the degree changes by 0.0015.
constexpr double lamplit_cdm2 = 1.0, asphalt_reflectance = 0.08;
constexpr double luminance_of[3] = {0.2126, 0.7152, 0.0722};

std::optional<glm::dvec3> of_unit_luminance(const glm::dvec3& rgb) {
    const double y = luminance_of[0] * rgb.x + luminance_of[1] * rgb.y + luminance_of[2] * rgb.z;
    return y > 0.0 ? std::optional(rgb / y) : std::nullopt;
}

std::optional<glm::dvec3> white_of_set(const LampSet& lamp_set) {
    glm::dvec3 low(0.0), all(0.0);
    for (const MountedLamp& lamp : lamp_set.lamps) {
        const glm::dvec3 light = lamp.colour.linear_srgb * (lamp.intensity_factor() * (lamp.file ? flux_lm(lamp.file->table) : 1.0));
        all += light;
        if (lamp.name.find("high") == std::string::npos)
            low += light;
    }
    const std::optional<glm::dvec3> white = of_unit_luminance(low);
    return white ? white : of_unit_luminance(all);
}

} // namespace

std::optional<glm::dvec3> white_of_lamps(const Drive& drive) {
    glm::dvec3 sum(0.0);
    for (const LampSet& lamp_set : drive.lamp_sets)
        sum += white_of_set(lamp_set).value_or(glm::dvec3(0.0));
    return of_unit_luminance(sum);
}

glm::dvec3 white_of_studies() { return colour_of_temperature(4000.0).linear_srgb; }

void close_white(Drive& drive, const std::optional<glm::dvec3>& lamps) {
    WhiteAdaptation& white = drive.display.white;
    if (!white.is_open())
        return;
    const Daylight sky = daylight_at(drive.daylight, 0.0);
    double sky_lx = sky.horizontal_illuminance_lx;
    if (const DirectLight* direct = sky.direct())
        sky_lx += direct->illuminance_lx * std::max(direct->towards().z, 0.0);
    const double sky_cdm2 = asphalt_reflectance * sky_lx / pi;
    const double lamps_cdm2 = lamps ? lamplit_cdm2 : 0.0;
    if (!white.degree)
        white.degree = std::round(1.0e2 * adaptation_degree(lamps_cdm2 + sky_cdm2)) / 1.0e2;
    if (white.chromaticity)
        return;
    const glm::dvec3 light = lamps_cdm2 * lamps.value_or(glm::dvec3(0.0)) + glm::dvec3(sky_cdm2);
    const glm::dvec2 xy = chromaticity_of(xyz_from_light() * (lamps_cdm2 + sky_cdm2 > 0.0 ? light : glm::dvec3(1.0)));
    white.chromaticity = glm::round(1.0e4 * xy) / 1.0e4;
}

} // namespace fernlicht
