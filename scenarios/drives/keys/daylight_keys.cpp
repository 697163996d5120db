#include "scenarios/drives/keys/daylight_keys.h"

#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/sky/ephemeris.h"
#include "scenarios/yaml/yaml_tree.h"

#include <array>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t most_lamp_rows = 32, most_object_words = 32;
constexpr double brightest_lx = 150'000.0, fastest_rate = 86'400.0;
constexpr double lowest_shining_rad = radians(-1.0); ///< of a disc whose upper edge refraction still lifts over the horizon

/// Whole numbers with a sign between them and as many digits as `digits` says, such as 2026-06-21.
template <std::size_t n> std::array<int, n> digits_between(const YamlEntry& entry, const std::string& text, char sign,
                                                           const std::array<std::size_t, n>& digits, const std::string& expected) {
    std::array<int, n> numbers{};
    std::size_t at = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const char *from = text.data() + at, *to = from + digits[i];
        const bool fits = at + digits[i] <= text.size();
        if (!fits || std::from_chars(from, to, numbers[i]).ptr != to || *from == '-' || *from == '+')
            entry.refuse(expected);
        at += digits[i];
        if (i + 1 < n && (at >= text.size() || text[at++] != sign))
            entry.refuse(expected);
    }
    if (at != text.size())
        entry.refuse(expected);
    return numbers;
}

void read_date(const YamlEntry& entry, SkyClock& clock) {
    const std::string expected = "a date as 2026-06-21, 1800 to 2199";
    const auto [year, month, day] = digits_between<3>(entry, entry.text(), '-', {4, 2, 2}, expected);
    if (year < 1800 || year > 2199 || month < 1 || month > 12 || day < 1 || day > days_in_month(year, month))
        entry.refuse(expected);
    clock.year = year, clock.month = month, clock.day = day;
}

void read_time_of_day(const YamlEntry& entry, SkyClock& clock) {
    const std::string expected = "a time as 21:30 or 21:30:15, local", text = entry.text();
    const std::string whole = text.size() == 5 ? text + ":00" : text;
    const auto [hours, minutes, seconds] = digits_between<3>(entry, whole, ':', {2, 2, 2}, expected);
    if (hours > 23 || minutes > 59 || seconds > 59)
        entry.refuse(expected);
    clock.seconds_of_day = 3600 * hours + 60 * minutes + seconds;
}

SkyClock read_clock(const YamlMap& keys) {
    static constexpr SkyCover covers[] = {SkyCover::clear, SkyCover::partly_cloudy, SkyCover::overcast};
    for (const std::string_view key : {"horizontal_illuminance_lx", "sun", "moon"})
        if (const auto given = keys.find(key))
            given->refuse(fmt::format("{} beside a date", key), "one of them: with a date the light is computed");
    SkyClock clock;
    read_date(keys.require("date"), clock);
    read_time_of_day(keys.require("time"), clock);
    clock.utc_offset_h = keys.require("utc_offset_h").number(-14.0, 14.0);
    clock.latitude_deg = keys.require("latitude_deg").number(-90.0, 90.0);
    clock.longitude_deg = keys.require("longitude_deg").number(-180.0, 180.0);
    if (const auto sky = keys.find("sky"))
        clock.cover = covers[sky->choice({"clear", "partly-cloudy", "overcast"})];
    if (const auto pace = keys.one_of({"runs", "rate"}))
        clock.rate = pace->first == "rate" ? pace->second.number(0.0, fastest_rate) : pace->second.flag() ? 1.0 : 0.0;
    return clock;
}

DirectLight read_direct(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"azimuth_deg", "azimuth_rad", "elevation_deg", "elevation_rad", "illuminance_lx"});
    DirectLight light;
    const auto azimuth = keys.angle_rad("azimuth", 360.0), elevation = keys.angle_rad("elevation", 90.0);
    if (!azimuth)
        keys.refuse_missing("azimuth_deg", "azimuth_deg, from north over east");
    if (!elevation)
        keys.refuse_missing("elevation_deg", "elevation_deg above the horizon");
    light.azimuth_rad = *azimuth;
    light.elevation_rad = *elevation;
    light.illuminance_lx = keys.require("illuminance_lx").number(0.0, brightest_lx);
    if (light.illuminance_lx > 0.0 && light.elevation_rad < lowest_shining_rad)
        entry.refuse(fmt::format("light of {:g} lx from {:g} degrees of elevation", light.illuminance_lx, degrees(light.elevation_rad)),
                     "-1 degree or higher, or an illuminance of 0");
    return light;
}

/// Sky, sun and moon in figures.
void read_figures(const YamlMap& keys, Daylight& daylight) {
    for (const std::string_view key : {"time", "utc_offset_h", "latitude_deg", "longitude_deg", "sky", "runs", "rate"})
        if (const auto given = keys.find(key))
            given->refuse(fmt::format("{} without a date", key), "date beside it");
    daylight.horizontal_illuminance_lx = keys.require("horizontal_illuminance_lx").number(0.0, brightest_lx);
    if (const auto sun = keys.find("sun"))
        daylight.sun = read_direct(*sun);
    if (const auto moon = keys.find("moon"))
        daylight.moon = read_direct(*moon);
    if (daylight.sun.illuminance_lx > 0.0 && daylight.moon.illuminance_lx > 0.0)
        keys.require("moon").refuse("a shining moon beside a shining sun",
                                    "one of them; the other's light belongs to horizontal_illuminance_lx");
}

/// Degrees where they give exactly these radians, as everywhere in a written drive.
std::string written(std::string_view key, const DirectLight& light) {
    if (light == DirectLight{})
        return "";
    return fmt::format(", {}: {{{}, {}, illuminance_lx: {}}}", key, angle_entry("azimuth", light.azimuth_rad),
                       angle_entry("elevation", light.elevation_rad), light.illuminance_lx);
}

} // namespace

Daylight read_daylight(const YamlMap& drive) {
    const auto given = drive.find("daylight");
    if (!given)
        return {};
    if (given->is_scalar()) {
        // Night: no moon, no sky; the full moon would be 0.2 lx. Twilight: clear sky at the end of civil twilight, sun 6 degrees down,
        // 2 to 3.5 lx (AMS Glossary of Meteorology). Day: overcast to bright daylight without direct sun, 27 000 lx.
        static const Daylight known[] = {{"night", 0.0}, {"twilight", 3.4}, {"day", 27000.0}};
        return known[given->choice({"night", "twilight", "day"})];
    }
    const YamlMap keys = given->map({"name", "horizontal_illuminance_lx", "sun", "moon", "date", "time", "utc_offset_h", "latitude_deg",
                                     "longitude_deg", "sky", "runs", "rate"});
    Daylight daylight;
    const auto name = keys.find("name");
    daylight.name = name ? name->name() : "custom";
    if (keys.find("date")) {
        daylight.clock = read_clock(keys);
        return daylight_at(daylight, 0.0);
    }
    read_figures(keys, daylight);
    return daylight;
}

Weather read_weather(const YamlMap& drive) {
    static constexpr Intensity classes[] = {Intensity::light, Intensity::moderate, Intensity::heavy};
    Weather weather;
    const auto given = drive.find("weather");
    if (!given)
        return weather;
    const YamlMap keys = given->map({"fog", "rain", "snow", "extinction_per_m", "scattering_albedo", "asymmetry", "wetness"});
    weather.extinction_per_m = keys.number_or("extinction_per_m", 0.0, 0.0, 10.0);
    if (const auto fog = keys.find("fog")) {
        if (keys.find("extinction_per_m"))
            fog->refuse("fog beside extinction_per_m", "one of them");
        const YamlMap range = fog->map({"visibility_m", "contrast"});
        weather.extinction_per_m =
            extinction_of_range_per_m(range.require("visibility_m").number(1.0, 1.0e6), range.number_or("contrast", 0.05, 0.001, 0.5));
        weather.asymmetry = fog_asymmetry;
    }
    weather.scattering_albedo = keys.number_or("scattering_albedo", weather.scattering_albedo, 0.0, 1.0);
    weather.asymmetry = keys.number_or("asymmetry", weather.asymmetry, 0.0, 0.9);
    if (const auto falls = keys.find("rain"))
        weather = together(weather, rain(classes[falls->choice({"light", "moderate", "heavy"})]));
    if (const auto falls = keys.find("snow"))
        weather = together(weather, snow(classes[falls->choice({"light", "moderate", "heavy"})]));
    weather.wetness = keys.number_or("wetness", weather.wetness, 0.0, 1.0);
    return weather;
}

std::vector<StreetLampRow> read_street_lamps(const YamlMap& drive, LampShelf& shelf) {
    std::vector<StreetLampRow> rows;
    const auto given = drive.find("street_lamps");
    if (!given)
        return rows;
    for (const auto& [name, entry] : given->named(most_lamp_rows)) {
        const YamlMap keys =
            entry.map({"file", "on_objects", "first_m", "last_m", "every_m", "beside_m", "height_m", "arm_m", "tilt_deg", "tilt_rad",
                       "level", "source", "temperature_k", "spectrum", "colour", "between_samples", "type_c_axis", "texture", "mirrored"});
        StreetLampRow row;
        row.name = name;
        row.file = read_lamp_keys({keys}, shelf, TypeCAxis::nadir);
        if (!row.file)
            entry.refuse("street lamps without a file", "file");
        if (const auto objects = keys.find("on_objects")) {
            for (const char* key : {"first_m", "last_m", "every_m", "beside_m"})
                if (const auto of_rows = keys.find(key))
                    of_rows->refuse(fmt::format("{} beside on_objects", key), "one of them: the road's objects have their places");
            for (const YamlEntry& word : objects->list(1, most_object_words))
                row.on_objects.push_back(word.text());
            row.height_m = 0.0;
        }
        row.first_m = keys.number_or("first_m", row.first_m, -1.0e6, 1.0e6);
        row.last_m = keys.number_or("last_m", row.last_m, row.first_m, 1.0e6);
        row.every_m = keys.number_or("every_m", row.every_m, 1.0, 1.0e6);
        row.beside_m = keys.number_or("beside_m", row.beside_m, -200.0, 200.0);
        row.height_m = keys.number_or("height_m", row.height_m, 0.5, 100.0);
        row.arm_m = keys.number_or("arm_m", row.arm_m, 0.0, 20.0);
        row.tilt_rad = keys.angle_rad("tilt", 90.0).value_or(row.tilt_rad);
        row.level = keys.number_or("level", row.level, 0.0, 1.0);
        const auto source = read_source({keys});
        row.colour = source || gives_colour({keys}) ? read_colour({keys}, source.value_or(SourceKind::led), shelf, entry)
                                                    : colour_of_temperature(3000.0);
        rows.push_back(row);
    }
    return rows;
}

std::string write_daylight(const Daylight& daylight) {
    if (!daylight.clock)
        return fmt::format("daylight: {{name: \"{}\", horizontal_illuminance_lx: {}{}{}}}\n", daylight.name,
                           daylight.horizontal_illuminance_lx, written("sun", daylight.sun), written("moon", daylight.moon));
    const SkyClock& c = *daylight.clock;
    static constexpr std::string_view covers[] = {"clear", "partly-cloudy", "overcast"};
    return fmt::format(
        "daylight: {{name: \"{}\", date: \"{:04}-{:02}-{:02}\", time: \"{:02}:{:02}:{:02}\", utc_offset_h: {}, latitude_deg: {}, "
        "longitude_deg: {}, sky: {}, rate: {}}}\n",
        daylight.name, c.year, c.month, c.day, c.seconds_of_day / 3600, c.seconds_of_day / 60 % 60, c.seconds_of_day % 60, c.utc_offset_h,
        c.latitude_deg, c.longitude_deg, covers[static_cast<std::size_t>(c.cover)], c.rate);
}

std::string write_weather(const Weather& weather) {
    if (weather == Weather{})
        return "";
    return fmt::format("weather: {{extinction_per_m: {}, scattering_albedo: {}, asymmetry: {}, wetness: {}}}\n", weather.extinction_per_m,
                       weather.scattering_albedo, weather.asymmetry, weather.wetness);
}

} // namespace fernlicht
