#include "scenarios/drives/story/sky_site.h"

#include "scenarios/values/xml_file.h"

#include <cmath>

namespace fernlicht {
namespace {

constexpr double metres_a_degree = 111'132.954,
                 bulge_m = 16'038.509; ///< meridian arc on WGS 84: 111 132.954 B - 16 038.509 sin 2 B + ..., B in degrees
constexpr double metres_a_degree_on_the_equator = 111'319.491, utm_scale = 0.9996, utm_false_easting_m = 500'000.0;

struct MapProjection {
    double latitude_deg = 0.0, longitude_deg = 0.0, easting_m = 0.0, northing_m = 0.0, scale = 1.0;
};

/// The value of "+key=" in PROJ's text.
std::optional<std::string> proj_value(std::string_view text, std::string_view key) {
    const std::string sought = "+" + std::string(key) + "=";
    const std::size_t at = text.find(sought);
    if (at == std::string_view::npos)
        return {};
    const std::string_view rest = text.substr(at + sought.size());
    return std::string(rest.substr(0, rest.find_first_of(" \t\r\n]<")));
}

std::optional<double> proj_number(std::string_view text, std::string_view key) {
    const auto value = proj_value(text, key);
    return value ? to_number(*value) : std::nullopt;
}

std::optional<MapProjection> utm(int zone, bool south) {
    if (zone < 1 || zone > 60)
        return {};
    return MapProjection{0.0, 6.0 * zone - 183.0, utm_false_easting_m, south ? 1.0e7 : 0.0, utm_scale};
}

std::optional<MapProjection> projection_of(std::string_view text) {
    const auto latitude = proj_number(text, "lat_0"), longitude = proj_number(text, "lon_0");
    if (latitude && longitude)
        return MapProjection{*latitude, *longitude, proj_number(text, "x_0").value_or(0.0), proj_number(text, "y_0").value_or(0.0), 1.0};
    if (const auto zone = proj_number(text, "zone"); zone && std::abs(*zone) < 100.0)
        return utm(static_cast<int>(*zone), text.find("+south") != std::string_view::npos);
    const std::size_t at = text.find("EPSG:");
    if (at == std::string_view::npos)
        return {};
    const auto code = to_number(std::string(text.substr(at + 5, 5)));
    if (!code || !(*code >= 0.0 && *code < 1.0e5))
        return {};
    const int series = static_cast<int>(*code) / 100, zone = static_cast<int>(*code) % 100;
    if (series != 326 && series != 327 && series != 258)
        return {};
    return utm(zone, series == 327);
}

double meridian_m(double latitude_deg) { return metres_a_degree * latitude_deg - bulge_m * std::sin(2.0 * radians(latitude_deg)); }

} // namespace

std::optional<SkySite> sky_site_of(std::string_view geo_reference, const glm::dvec3& position_m) {
    const auto by = projection_of(geo_reference);
    if (!by)
        return {};
    const double arc_m = meridian_m(by->latitude_deg) + (position_m.y - by->northing_m) / by->scale;
    double latitude = arc_m / metres_a_degree;
    for (int i = 0; i < 8; ++i) // a contraction by bulge over degree, 0.005
        latitude = (arc_m + bulge_m * std::sin(2.0 * radians(latitude))) / metres_a_degree;
    if (!(std::abs(latitude) < 90.0))
        return {};
    const double parallel_m = metres_a_degree_on_the_equator * std::cos(radians(latitude)) * by->scale;
    const double longitude = by->longitude_deg + (position_m.x - by->easting_m) / parallel_m;
    if (!(std::abs(longitude) <= 180.0))
        return {};
    return SkySite{latitude, longitude, {}};
}

} // namespace fernlicht
