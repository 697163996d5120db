#include "scenarios/drives/story/story_environment.h"

#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/openscenario/osc_judge.h"
#include "scenarios/sky/sky_light.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/xml_file.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr SkySite our_site{48.14, 11.58, {}}; ///< where a road says nothing: Munich
constexpr double mean_sun_km = 149.598e6, brightest_sun_lx = 150'000.0;
constexpr double clear_air_m = 20'000.0;           ///< a visual range from here on is no fog
constexpr int first_year = 1800, last_year = 2199; ///< of the ephemeris (docs/daylight.md)

class EnvironmentTeller {
  public:
    EnvironmentTeller(Drive& drive, const osc::PlayedStory& story, const RoadNetwork& network)
        : drive_(drive), story_(story), network_(network), beginning_{0.0, 0.0, drive.daylight, drive.weather} {}

    void tell() {
        const osc::EnvironmentChange* first = nullptr;
        for (const osc::EnvironmentChange& change : story_.environment)
            if (change.time_s <= 0.0)
                first = &change;
        if (first) {
            const SkyChange sky = sky_of(*first);
            drive_.daylight = daylight_at(sky.daylight, 0.0);
            drive_.weather = sky.weather;
        }
        std::vector<SkyChange> later;
        for (const osc::EnvironmentChange& change : story_.environment)
            if (change.time_s > 0.0)
                later.push_back(sky_of(change));
        if (later.empty() || (drive_.storyboard->own_daylight && drive_.storyboard->own_weather))
            return;
        drive_.notes.push_back(fmt::format("the storyboard changes the environment {} time{} during the drive, first at {:.6g} s",
                                           later.size(), later.size() == 1 ? "" : "s", later.front().from_s));
        StoryboardTimeline timeline = drive_.timeline ? *drive_.timeline : StoryboardTimeline{};
        timeline.skies = std::move(later);
        drive_.timeline = std::make_shared<const StoryboardTimeline>(std::move(timeline));
    }

  private:
    SkyChange sky_of(const osc::EnvironmentChange& change) {
        SkyChange sky{change.time_s, change.clock_from_s, beginning_.daylight, beginning_.weather};
        if (drive_.storyboard->own_daylight)
            sky.clock_from_s = 0.0;
        else
            tell_sky(change.environment, sky.daylight);
        if (!drive_.storyboard->own_weather)
            sky.weather = air_of(change.environment);
        return sky;
    }

    void tell_sky(const osc::Environment& from, Daylight& daylight) {
        SkyCover cover = SkyCover::clear;
        if (from.cloud_state) {
            if (const auto known = sky_cover_of(*from.cloud_state))
                cover = *known;
            else
                note(fmt::format("clouds '{}' are not known: the sky is clear", printable(*from.cloud_state)));
        }
        const bool sun = from.sun_elevation_rad && from.sun_illuminance_lx;
        if (from.date_time && (from.time_runs || !sun)) {
            if (auto clock = clock_of(from, cover)) {
                daylight = Daylight{.name = "storyboard", .clock = *clock};
                if (sun)
                    note("the time of day runs: the sky follows it, not the storyboard's Sun");
                return;
            }
        }
        if (sun)
            daylight = sun_in_figures(from, cover);
    }

    std::optional<SkyClock> clock_of(const osc::Environment& from, SkyCover cover) {
        const auto given_s = osc::seconds_of(*from.date_time);
        if (!given_s) {
            note(fmt::format("the time of day '{}' is none: expected 2026-10-18T18:30:00", printable(*from.date_time)));
            return {};
        }
        const SkySite site = site_of_story();
        const bool has_zone = from.date_time->find_first_of("Zz+-", std::string_view("2026-10-18T").size()) != std::string::npos;
        const double offset_h = has_zone ? 0.0 : site.utc_offset_h.value_or(std::round(site.longitude_deg / 15.0));
        if (!has_zone && !site.utc_offset_h)
            note(fmt::format("the time of day has no offset from UTC: {:+} h were taken, by the longitude", offset_h));
        const auto utc_s = static_cast<long long>(std::llround(*given_s - 3600.0 * offset_h));
        const long long seconds_of_day = ((utc_s % 86'400) + 86'400) % 86'400;
        const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days((utc_s - seconds_of_day) / 86'400))};
        const int year = static_cast<int>(date.year());
        if (year < first_year || year > last_year) {
            note(fmt::format("the time of day '{}' lies outside {} to {}", printable(*from.date_time), first_year, last_year));
            return {};
        }
        return SkyClock{.year = year,
                        .month = static_cast<int>(static_cast<unsigned>(date.month())),
                        .day = static_cast<int>(static_cast<unsigned>(date.day())),
                        .seconds_of_day = static_cast<int>(seconds_of_day),
                        .utc_offset_h = 0.0,
                        .latitude_deg = site.latitude_deg,
                        .longitude_deg = site.longitude_deg,
                        .cover = cover,
                        .rate = from.time_runs ? drive_.storyboard->day_rate : 0.0};
    }

    SkySite site_of_story() {
        if (drive_.storyboard->site)
            return *drive_.storyboard->site;
        const glm::dvec3 at_m = drive_.ego_track ? drive_.ego_track->points().front().pose.position_m : glm::dvec3(0.0);
        if (const auto site = sky_site_of(network_.geo_reference, at_m))
            return *site;
        note(fmt::format("the time of day has no place, and the road's header names none: {:.2f} N, {:.2f} E was taken (storyboard: "
                         "{{place: {{latitude_deg, longitude_deg}}}} says another)",
                         our_site.latitude_deg, our_site.longitude_deg));
        return our_site;
    }

    /// From north over east, as OpenSCENARIO 1.x has it. The sky is that of such a sun (docs/daylight.md), as much fainter as the sun is.
    static Daylight sun_in_figures(const osc::Environment& from, SkyCover cover) {
        Daylight daylight;
        daylight.name = "storyboard";
        const double elevation = std::clamp(*from.sun_elevation_rad, -0.5 * pi, 0.5 * pi);
        const double direct_lx = std::clamp(*from.sun_illuminance_lx, 0.0, brightest_sun_lx);
        if (!(direct_lx > 0.0))
            return daylight;
        const double sky_lx = sun_light(elevation, elevation, mean_sun_km, cover).diffuse_lx;
        const double clear_lx = sun_light(elevation, elevation, mean_sun_km, SkyCover::clear).direct_lx;
        daylight.horizontal_illuminance_lx = clear_lx > 0.0 ? sky_lx * std::min(1.0, direct_lx / clear_lx) : sky_lx;
        if (elevation > 0.0)
            daylight.sun = {std::fmod(std::fmod(from.sun_azimuth_rad.value_or(0.0), 2.0 * pi) + 2.0 * pi, 2.0 * pi), elevation, direct_lx};
        return daylight;
    }

    static Weather air_of(const osc::Environment& from) {
        Weather weather;
        if (from.fog_visual_range_m && *from.fog_visual_range_m < clear_air_m) {
            weather.extinction_per_m = extinction_of_range_per_m(*from.fog_visual_range_m);
            weather.asymmetry = fog_asymmetry;
        }
        if (from.precipitation && *from.precipitation != "dry" && from.precipitation_mm_per_h && *from.precipitation_mm_per_h > 0.0) {
            const double rate = *from.precipitation_mm_per_h;
            const Intensity intensity = rate <= 2.5 ? Intensity::light : rate <= 7.6 ? Intensity::moderate : Intensity::heavy;
            weather = together(weather, *from.precipitation == "snow" ? snow(intensity) : rain(intensity));
        }
        if (from.wetness) // shares of a full film of water by the standard's words [estimate]
            weather.wetness = std::max(weather.wetness, *from.wetness == "dry" ? 0.0 : *from.wetness == "moist" ? 0.4 : 1.0);
        return weather;
    }

    void note(std::string text) {
        text.insert(0, "storyboard: ");
        if (std::ranges::find(drive_.notes, text) == drive_.notes.end())
            drive_.notes.push_back(std::move(text));
    }

    Drive& drive_;
    const osc::PlayedStory& story_;
    const RoadNetwork& network_;
    SkyChange beginning_; ///< what the drive says, or its defaults
};

} // namespace

std::optional<SkyCover> sky_cover_of(std::string_view clouds) {
    static constexpr std::string_view oktas[] = {"zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"};
    constexpr std::size_t clear_to = 2, partly_to = 6; // IES: clear to 0.3 of the sky, overcast from 0.8
    for (std::size_t n = 0; n < std::size(oktas); ++n)
        if (clouds.starts_with(oktas[n]) || clouds == std::to_string(n))
            return n <= clear_to ? SkyCover::clear : n <= partly_to ? SkyCover::partly_cloudy : SkyCover::overcast;
    if (clouds == "free" || clouds == "skyOff")
        return SkyCover::clear;
    if (clouds == "cloudy")
        return SkyCover::partly_cloudy;
    return clouds == "overcast" || clouds == "rainy" ? std::optional(SkyCover::overcast) : std::nullopt;
}

void apply_environment(Drive& drive, const osc::PlayedStory& story, const RoadNetwork& network) {
    if (!story.environment.empty())
        EnvironmentTeller(drive, story, network).tell();
}

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
