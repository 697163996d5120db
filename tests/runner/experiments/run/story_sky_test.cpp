// What a storyboard's environments do to the sky and the air of a drive: from the beginning, from each change on, by date, time and place.
#include "runner/play/stage.h"
#include "scenarios/drives/play/storyboard_timeline.h"
#include "scenarios/drives/story/story_environment.h"
#include "tests/runner/program.h"
#include "tests/scenarios/openscenario/story_text.h"

#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace fernlicht::osc {
namespace {

using testing::Contains;
using testing::HasSubstr;

const std::string two_cars = of("Ego", teleport(on_lane(-1, 50.0)) + speed("20")) + of("Other", teleport(on_lane(-1, 90.0)) + speed("20"));

std::string environment(const std::string& inside) {
    return "<GlobalAction><EnvironmentAction><Environment name=\"e\">" + inside + "</Environment></EnvironmentAction></GlobalAction>";
}
std::string clock_at(const std::string& time, bool runs) { return fmt::format(R"(<TimeOfDay animation="{}" dateTime="{}"/>)", runs, time); }

class StorySky : public testing::Test {
  protected:
    /// A drive of two seconds at 10 Hz with this scenario; `storyboard` beside its file, `more` keys of the drive.
    std::string write_told(const std::string& init, const std::string& events, const std::string& storyboard = "",
                           const std::string& more = "") {
        std::ofstream(folder_ / "told.xosc") << scenario_text(two_cars + init, (events.empty() ? "" : story(events)) + stop_at(2.0));
        std::ofstream(folder_ / "told.yaml") << "fernlicht: 1\nstoryboard: {file: told.xosc" << storyboard
                                             << "}\nrate_hz: 10\nduration_s: 3\nlamp_sets:\n  one: {source: filament, file: \""
                                             << library_file("lamps/halogen-low.ies") << "\"}\nmeasure: {extent: false}\n"
                                             << more;
        return folder_ / "told.yaml";
    }
    static Moment at(const Stage& stage, int tick) { return moments_at({tick}, stage, stage.drive.lamp_sets.front()).front(); }

    TemporaryFolder folder_;
};

TEST_F(StorySky, ChangesHoldFromTheirMomentOn) {
    const std::string fog =
        environment(R"(<Weather><Fog visualRange="100"/></Weather><RoadCondition frictionScaleFactor="1" wetness="moist"/>)");
    const std::string sun =
        environment(R"(<Weather><Sun azimuth="1" elevation="0.5" illuminance="50000"/><Fog visualRange="100000"/></Weather>)");
    const Stage stage(read_drive(write_told("", event("fog", fog, at_time(0.45)) + event("sun", sun, at_time(1.25)))));
    const Moment before = at(stage, 4), foggy = at(stage, 5), sunny = at(stage, 13);
    EXPECT_EQ(before.weather, Weather{});
    EXPECT_EQ(before.daylight.horizontal_illuminance_lx, 0.0);
    EXPECT_NEAR(foggy.weather.extinction_per_m, -std::log(0.05) / 100.0, 1e-9); // WMO: 5 % of contrast at 100 m
    EXPECT_EQ(foggy.weather.wetness, 0.4);
    EXPECT_EQ(foggy.daylight.direct(), nullptr);
    EXPECT_EQ(sunny.weather.extinction_per_m, 0.0);
    EXPECT_EQ(sunny.weather.wetness, 0.4) << "what the later environment does not say stays";
    ASSERT_NE(sunny.daylight.direct(), nullptr);
    EXPECT_EQ(sunny.daylight.sun.illuminance_lx, 50000.0);
    EXPECT_EQ(sunny.daylight.sun.elevation_rad, 0.5);
    // A clear sky with the sun 0.5 rad high gives 0.8 + 15.5 sqrt(sin 0.5) klx (IES) beside a direct sun of 127.5 exp(-0.21 / sin 0.5) klx.
    const double direct = 127'500.0 * std::exp(-0.21 / std::sin(0.5)), sky = 800.0 + 15'500.0 * std::sqrt(std::sin(0.5));
    EXPECT_NEAR(sunny.daylight.horizontal_illuminance_lx, sky * 50'000.0 / direct, 0.01 * sky);
}

TEST_F(StorySky, WhatTheDriveSaysStays) {
    const std::string fog = environment(clock_at("2026-06-21T12:00:00Z", true) + R"(<Weather><Fog visualRange="100"/></Weather>)");
    const Stage stage(read_drive(write_told(fog, event("fog", fog, at_time(0.5)), "", "daylight: twilight\nweather: {wetness: 0.2}\n")));
    for (const int tick : {0, 10}) {
        EXPECT_EQ(at(stage, tick).daylight.name, "twilight");
        EXPECT_EQ(at(stage, tick).weather, (Weather{.wetness = 0.2}));
    }
    EXPECT_EQ(stage.drive.timeline->skies.size(), 0U) << "nothing is asked for at each moment";
}

/// The same sky by a drive's own daylight keys.
TEST_F(StorySky, TheTimeOfDayRunsAsADrivesDaylightDoes) {
    const std::string noon = environment(clock_at("2026-10-18T18:37:00", true));
    const std::string later = environment(clock_at("2026-10-18T19:00:00+02:00", true));
    const Stage told(read_drive(write_told(noon, event("later", later, at_time(0.995)),
                                           ", place: {latitude_deg: 48.14, longitude_deg: 11.58, utc_offset_h: 2}, day_rate: 300")));
    const auto own = [&](const std::string& time) {
        std::ofstream(folder_ / "own.yaml") << fmt::format(
            "fernlicht: 1\nroad: \"{}\"\nspeed_kmh: 72\nrate_hz: 10\nduration_s: 2\nlamp_sets:\n  one: {{source: filament, file: \"{}\"}}\n"
            "daylight: {{date: 2026-10-18, time: \"{}\", utc_offset_h: 2, latitude_deg: 48.14, longitude_deg: 11.58, rate: 300}}\n",
            straight_road, library_file("lamps/halogen-low.ies"), time);
        return read_drive(folder_ / "own.yaml");
    };
    const Stage first(own("18:37")), second(own("19:00"));
    for (int tick = 0; tick < 10; ++tick) {
        EXPECT_NEAR(at(told, tick).daylight.horizontal_illuminance_lx / at(first, tick).daylight.horizontal_illuminance_lx, 1.0, 1e-6);
        EXPECT_EQ(at(told, tick).daylight.sun, at(first, tick).daylight.sun);
        EXPECT_NEAR(at(told, tick + 10).daylight.horizontal_illuminance_lx / at(second, tick).daylight.horizontal_illuminance_lx, 1.0, 1e-3)
            << tick; // the event comes at 0.99 s
    }
    EXPECT_LT(at(told, 9).daylight.horizontal_illuminance_lx, 0.5 * at(told, 0).daylight.horizontal_illuminance_lx);
    EXPECT_THAT(told.drive.notes, Contains(HasSubstr("changes the environment 1 time during the drive")));
}

TEST_F(StorySky, ConditionsOfTheTimeOfDayGoByTheSameClock) {
    const std::string dusk = environment(clock_at("2026-10-18T18:37:00+02:00", true));
    const std::string off =
        R"(<PrivateAction><AppearanceAction><LightStateAction transitionTime="0"><LightType><VehicleLight vehicleLightType="lowBeam"/></LightType><LightState mode="off"/></LightStateAction></AppearanceAction></PrivateAction>)";
    const std::string at_18_40 = by_value(R"(<TimeOfDayCondition dateTime="2026-10-18T18:40:00+02:00" rule="greaterOrEqual"/>)");
    const Stage stage(read_drive(write_told(dusk, event("off", off, at_18_40), ", day_rate: 180"))); // three minutes in one second
    EXPECT_GT(at(stage, 9).lamps[0].intensity_factor, 0.0);
    EXPECT_EQ(at(stage, 11).lamps[0].intensity_factor, 0.0);
    EXPECT_THAT(stage.drive.notes, Contains(HasSubstr("48.14 N, 11.58 E was taken"))) << "the road names no place";
}

TEST_F(StorySky, ResolvedDrivesPlayTheSameSkies) {
    const std::string fog = environment(R"(<Weather><Fog visualRange="60"/></Weather>)");
    const std::string drive = write_told(environment(clock_at("2026-10-18T18:45:00+02:00", true)), event("fog", fog, at_time(0.15)),
                                         ", day_rate: 600", "views: {driver: {resolution_px: [64, 48]}}\ncapture: {all: true}\n");
    const std::string flags = " --quiet --no-accuracy --frames 0:3 --out ";
    const Outcome first = run_program("run " + drive + flags + (folder_ / "a"));
    ASSERT_EQ(first.exit_code, 0) << first.output;
    const Outcome again = run_program("run " + (folder_ / "a/told.yaml") + flags + (folder_ / "b"));
    ASSERT_EQ(again.exit_code, 0) << again.output;
    for (const int tick : {0, 1, 2, 3}) {
        const std::string frame = fmt::format("frames/told-one/driver-{:06}.exr", tick);
        EXPECT_FALSE(content_of(folder_ / ("a/" + frame)).empty());
        EXPECT_TRUE(content_of(folder_ / ("a/" + frame)) == content_of(folder_ / ("b/" + frame))) << tick;
    }
}

TEST(SkySite, IsWhereTheProjectionHasIt) {
    const auto near = [](const std::optional<SkySite>& site, double latitude, double longitude, double within) {
        ASSERT_TRUE(site);
        EXPECT_NEAR(site->latitude_deg, latitude, within);
        EXPECT_NEAR(site->longitude_deg, longitude, within);
    };
    near(sky_site_of("+proj=tmerc +lat_0=37.3766 +lon_0=-122.2003 +k=1 +x_0=0 +y_0=0 +units=m", {0, 0, 0}), 37.3766, -122.2003, 1e-9);
    // A degree of latitude at 48 degrees is 111.2 km, of longitude 74.6 km.
    near(sky_site_of("+lat_0=47.5 +lon_0=8", {74'600.0, 111'200.0, 0.0}), 48.5, 9.0, 0.02);
    // Munich's Frauenkirche in zone 32: 691 600 m, 5 334 760 m is 48.139 N, 11.574 E.
    for (const char* utm : {"+proj=utm +zone=32 +datum=WGS84", "EPSG:25832", "EPSG:32632"})
        near(sky_site_of(utm, {691'600.0, 5'334'760.0, 0.0}), 48.139, 11.574, 0.1);
    near(sky_site_of("+proj=utm +zone=56 +south", {334'900.0, 6'252'300.0, 0.0}), -33.857, 151.215, 0.1); // Sydney's opera
    for (const char* none : {"", "+proj=longlat", "EPSG:3857", "+proj=utm +zone=nan", "+proj=utm +zone=61", "+lat_0=x +lon_0=3"})
        EXPECT_FALSE(sky_site_of(none, {0, 0, 0})) << none;
    EXPECT_FALSE(sky_site_of("+lat_0=80 +lon_0=0", {0.0, 2.0e6, 0.0})) << "beyond the pole";
}

TEST(SkyCoverOf, IsByOktasOrWords) {
    EXPECT_EQ(sky_cover_of("zeroOktas"), SkyCover::clear);
    EXPECT_EQ(sky_cover_of("twoOktas"), SkyCover::clear);
    EXPECT_EQ(sky_cover_of("fourOktas"), SkyCover::partly_cloudy);
    EXPECT_EQ(sky_cover_of("eightOktas"), SkyCover::overcast);
    EXPECT_EQ(sky_cover_of("free"), SkyCover::clear);
    EXPECT_EQ(sky_cover_of("rainy"), SkyCover::overcast);
    EXPECT_EQ(sky_cover_of("purple"), std::nullopt);
}

} // namespace
} // namespace fernlicht::osc
