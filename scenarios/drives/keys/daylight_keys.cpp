#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/lamp_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/sky/ephemeris.h"
#include "scenarios/yaml/yaml_tree.h"

#include <array>
#include <charconv>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr std::size_t max_object_words = 32;
constexpr double brightest_lx = 150'000.0, fastest_rate = 86'400.0;
constexpr std::string_view intensities[] = {"light", "moderate", "heavy"};
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

std::string date_text(const SkyClock& clock) { return fmt::format("\"{:04}-{:02}-{:02}\"", clock.year, clock.month, clock.day); }

std::string time_text(const SkyClock& clock) {
    const int s = clock.seconds_of_day;
    return fmt::format("\"{:02}:{:02}:{:02}\"", s / 3600, s / 60 % 60, s % 60);
}

const Fields<SkyClock>& clock_fields() {
    using Clock = SkyClock;
    static const Fields<Clock> fields =
        Fields<Clock>{
            own("date", 1, read_date, date_text, R"({"type": "string", "pattern": "^(1[89]|2[01])[0-9]{2}-[0-9]{2}-[0-9]{2}$"})",
                "as 2026-06-21, 1800 to 2199")
                .required(),
            own("time", 2, read_time_of_day, time_text, R"({"type": "string", "pattern": "^([01][0-9]|2[0-3]):[0-5][0-9](:[0-5][0-9])?$"})",
                "local, as 21:30 or 21:30:15")
                .required(),
            field("utc_offset_h", 3, &Clock::utc_offset_h, range(-14.0, 14.0), "of that time").required(),
            field("latitude_deg", 4, &Clock::latitude_deg, range(-90.0, 90.0), "north positive").required(),
            field("longitude_deg", 5, &Clock::longitude_deg, range(-180.0, 180.0), "east positive").required(),
            field("sky", 6, &Clock::cover, words({"clear", "partly-cloudy", "overcast"}), "its clouds"),
            form<Clock>("runs", FieldKind::flag, any(), "instead of a rate of 1: the time of day goes on during the drive",
                        [](const YamlEntry& entry, Clock& clock) { clock.rate = entry.flag() ? 1.0 : 0.0; }),
            field("rate", 7, &Clock::rate, range(0.0, fastest_rate), "seconds of the sky for a second of the drive"),
        }
            .in_schema(R"({"not": {"required": ["runs", "rate"]}})");
    return fields;
}

SkyClock read_clock(const YamlMap& keys) {
    for (const std::string_view key : {"horizontal_illuminance_lx", "sun", "moon"})
        if (const auto given = keys.find(key))
            given->refuse(fmt::format("{} beside a date", key), "one of them: with a date the light is computed");
    SkyClock clock;
    read_group(clock_fields(), keys, &clock);
    keys.one_of({"runs", "rate"});
    return clock;
}

void check_direct(const YamlMap& keys, const DirectLight& light) {
    if (!keys.find("azimuth_deg") && !keys.find("azimuth_rad"))
        keys.refuse_missing("azimuth_deg", "azimuth_deg, from north over east");
    if (!keys.find("elevation_deg") && !keys.find("elevation_rad"))
        keys.refuse_missing("elevation_deg", "elevation_deg above the horizon");
    keys.require("illuminance_lx");
    if (light.illuminance_lx > 0.0 && light.elevation_rad < lowest_shining_rad)
        keys.entry().refuse(
            fmt::format("light of {:g} lx from {:g} degrees of elevation", light.illuminance_lx, degrees(light.elevation_rad)),
            "-1 degree or higher, or an illuminance of 0");
}

const Fields<DirectLight>& direct_fields() {
    using Light = DirectLight;
    static const Fields<Light> fields =
        Fields<Light>{
            field("azimuth", 1, &Light::azimuth_rad, degrees_within("azimuth", 360.0), "from north over east"),
            field("elevation", 2, &Light::elevation_rad, degrees_within("elevation", 90.0), "above the horizon, as it is seen"),
            field("illuminance_lx", 3, &Light::illuminance_lx, range(0.0, brightest_lx), "on a plane perpendicular to it"),
        }
            .checked(check_direct)
            .in_schema(R"({"required": ["illuminance_lx"], "allOf": [
                {"oneOf": [{"required": ["azimuth_deg"]}, {"required": ["azimuth_rad"]}]},
                {"oneOf": [{"required": ["elevation_deg"]}, {"required": ["elevation_rad"]}]}]})");
    return fields;
}

bool has_clock(const void* daylight) { return static_cast<const Daylight*>(daylight)->clock.has_value(); }
bool has_no_clock(const void* daylight) { return !has_clock(daylight); }

// Night: no moon, no sky; the full moon would be 0.2 lx. Twilight: clear sky at the end of civil twilight, sun 6 degrees down, 2 to 3.5 lx
// (AMS Glossary of Meteorology). Day: overcast to bright daylight without direct sun, 27 000 lx.
const Daylight known_daylights[] = {{"night", 0.0}, {"twilight", 3.4}, {"day", 27000.0}};

/// Sky, sun and moon in figures.
void read_figures(const YamlMap& keys, Daylight& daylight) {
    for (const std::string_view key : {"time", "utc_offset_h", "latitude_deg", "longitude_deg", "sky", "runs", "rate"})
        if (const auto given = keys.find(key))
            given->refuse(fmt::format("{} without a date", key), "date beside it");
    for (const char* const key : {"horizontal_illuminance_lx", "sun", "moon"})
        read_field(daylight_fields(), key, keys, &daylight);
    if (daylight.sun.illuminance_lx > 0.0 && daylight.moon.illuminance_lx > 0.0)
        keys.require("moon").refuse("a shining moon beside a shining sun",
                                    "one of them; the other's light belongs to horizontal_illuminance_lx");
}

Intensity intensity(const YamlEntry& entry) { return static_cast<Intensity>(entry.choice(intensities)); }

void read_fog(const YamlEntry& entry, Weather& weather) {
    const YamlMap range = entry.map({"visibility_m", "contrast"});
    weather.extinction_per_m =
        extinction_of_range_per_m(range.require("visibility_m").number(1.0, 1.0e6), range.number_or("contrast", 0.05, 0.001, 0.5));
    weather.asymmetry = fog_asymmetry;
}

bool hangs_on_objects(const void* row) { return !static_cast<const StreetLampRow*>(row)->on_objects.empty(); }
bool is_row(const void* row) { return !hangs_on_objects(row); }
bool has_height(const void* row) { return is_row(row) || static_cast<const StreetLampRow*>(row)->height_m > 0.0; }

std::string objects_text(const StreetLampRow& row) {
    std::string text;
    for (const std::string& word : row.on_objects)
        text += fmt::format("\n      - {}", quoted(word));
    return text;
}

} // namespace

const Fields<Daylight>& daylight_fields() {
    static const Fields<Daylight> fields{
        field("name", 1, &Daylight::name, a_name(), "of this light, in reports"),
        field("horizontal_illuminance_lx", 2, &Daylight::horizontal_illuminance_lx, range(0.0, brightest_lx), "diffuse, of a uniform sky")
            .required()
            .heard_if(has_no_clock),
        field("sun", 3, &Daylight::sun, direct_fields(), "its light").written_off_default().heard_if(has_no_clock),
        field("moon", 4, &Daylight::moon, direct_fields(), "its light").written_off_default().heard_if(has_no_clock),
        inlined(5, &Daylight::clock, clock_fields()).heard_if(has_clock),
    };
    return fields;
}

std::string daylight_schema() {
    Daylight dated;
    dated.clock.emplace();
    return fmt::format(R"({{"anyOf": [{{"enum": ["night", "twilight", "day"]}}, {}, {}]}})", schema_as_heard(daylight_fields(), nullptr),
                       schema_as_heard(daylight_fields(), &dated));
}

Daylight known_daylight(const YamlEntry& word) { return known_daylights[word.choice({"night", "twilight", "day"})]; }

void read_daylight(const YamlEntry& given, Drive& drive) {
    Daylight& daylight = drive.daylight;
    if (given.is_scalar()) {
        daylight = known_daylight(given);
        return;
    }
    const YamlMap keys = given.map(keys_of(daylight_fields()));
    daylight.name = "custom";
    read_field(daylight_fields(), "name", keys, &daylight);
    if (!keys.find("date"))
        return read_figures(keys, daylight);
    daylight.clock = read_clock(keys);
    daylight = daylight_at(daylight, 0.0);
}

const Fields<Weather>& weather_fields() {
    static const Fields<Weather> fields =
        Fields<Weather>{
            form<Weather>("fog", FieldKind::own, {}, "by the range that one sees in it", read_fog)
                .schema_by(R"({"type": "object", "additionalProperties": false, "required": ["visibility_m"], "properties": {
                    "visibility_m": {"type": "number", "minimum": 1, "maximum": 1000000, "description": "meteorological range"},
                    "contrast": {"type": "number", "minimum": 0.001, "maximum": 0.5, "description": "at that range; 0.05 by default"}}})"),
            field("extinction_per_m", 1, &Weather::extinction_per_m, range(0.0, 10.0), "share of light lost per metre, in place of fog"),
            field("scattering_albedo", 2, &Weather::scattering_albedo, range(0.0, 1.0), "share of that which is scattered"),
            field("asymmetry", 3, &Weather::asymmetry, range(0.0, 0.9), "g of Henyey-Greenstein"),
            form<Weather>("rain", FieldKind::choice, words(intensities), "that falls",
                          [](const YamlEntry& entry, Weather& weather) { weather = together(weather, rain(intensity(entry))); }),
            form<Weather>("snow", FieldKind::choice, words(intensities), "that falls",
                          [](const YamlEntry& entry, Weather& weather) { weather = together(weather, snow(intensity(entry))); }),
            field("wetness", 4, &Weather::wetness, range(0.0, 1.0), "of the road; as given, whatever falls"),
        }
            .checked([](const YamlMap& keys, const Weather&) {
                if (const auto fog = keys.find("fog"); fog && keys.find("extinction_per_m"))
                    fog->refuse("fog beside extinction_per_m", "one of them");
            })
            .in_schema(R"({"not": {"required": ["fog", "extinction_per_m"]}})");
    return fields;
}

const Fields<StreetLampRow>& street_lamp_fields() {
    using Row = StreetLampRow;
    static const Fields<Row> fields =
        Fields<Row>{
            inlined(1, &Row::file, lamp_file_fields()),
            field("first_m", 2, &Row::first_m, range(-1.0e6, 1.0e6), "of the poles, along the route").heard_if(is_row),
            field("last_m", 3, &Row::last_m, range(-1.0e6, 1.0e6), "from first_m on")
                .read_by([](const YamlEntry& entry, Row& row) { row.last_m = entry.number(row.first_m, 1.0e6); })
                .heard_if(is_row),
            field("every_m", 4, &Row::every_m, range(1.0, 1.0e6), "from one to the next").heard_if(is_row),
            field("beside_m", 5, &Row::beside_m, range(-200.0, 200.0), "of the pole from the lane's centre, left positive")
                .heard_if(is_row),
            field("on_objects", 6, &Row::on_objects, texts(1, max_object_words),
                  "instead: on each object of the road's file of such a type or with this in its name")
                .text_by(objects_text)
                .heard_if(hangs_on_objects),
            field("height_m", 7, &Row::height_m, range(0.5, 100.0), "of the lamp above the road; objects have their own")
                .heard_if(has_height),
            field("arm_m", 8, &Row::arm_m, range(0.0, 20.0), "from the pole towards the lane"),
            field("tilt", 9, &Row::tilt_rad, degrees_within("tilt", 90.0), "lifts the side away from the pole"),
            field("level", 10, &Row::level, range(0.0, 1.0), "dimming, 1 = full"),
            form<Row>("source", FieldKind::choice, words({"filament", "arc", "led"}), "decides the default colour"),
            temperature_form<Row>(),
            spectrum_form<Row>(),
            field("colour", 11, &Row::colour, colour_fields(), "what a spectrum comes to; 3000 K by default"),
        }
            .block()
            .in_schema(R"({"required": ["file"]})");
    return fields;
}

std::vector<StreetLampRow> read_street_lamps(const YamlMap& drive, LampCache& cache) {
    std::vector<StreetLampRow> rows;
    const auto given = drive.find("street_lamps");
    if (!given)
        return rows;
    for (const auto& [name, entry] : given->named(max_street_lamp_rows)) {
        const YamlMap keys = entry.map(keys_of(street_lamp_fields()));
        StreetLampRow row;
        row.name = name;
        row.file = read_lamp_keys(keys, cache, TypeCAxis::nadir);
        if (!row.file)
            entry.refuse("street lamps without a file", "file");
        if (keys.find("on_objects")) {
            for (const char* key : {"first_m", "last_m", "every_m", "beside_m"})
                if (const auto of_rows = keys.find(key))
                    of_rows->refuse(fmt::format("{} beside on_objects", key), "one of them: the road's objects have their places");
            row.height_m = 0.0;
        }
        for (const char* key : {"on_objects", "first_m", "last_m", "every_m", "beside_m", "height_m", "arm_m", "tilt", "level"})
            read_field(street_lamp_fields(), key, keys, &row);
        const auto source = read_source(keys);
        row.colour = source || gives_colour(keys) ? read_colour(keys, source.value_or(SourceKind::led), cache, entry)
                                                  : colour_of_temperature(3000.0);
        rows.push_back(row);
    }
    return rows;
}

} // namespace fernlicht
