// The gradient of a drive's readings against central differences, sample by sample, and against the readings as folds and extents have
// them.
#include "metrics/folds/glare_fold.h"
#include "metrics/folds/homogeneity_fold.h"
#include "metrics/folds/place_fold.h"
#include "metrics/folds/visibility_fold.h"
#include "metrics/importance/changed_beam.h"
#include "metrics/road/extent.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"
#include "tests/lamps.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <numeric>

namespace fernlicht {
namespace {

using testing::HasSubstr;

struct PlayedDrive {
    Drive drive;
    RoadNetwork network;
    Route route;
    std::vector<Moment> moments;

    PlayedDrive(const std::string& name, const std::string& lamp_set, int every, int first = 0, int last = 100000)
        : drive(read_drive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/drives" / name)),
          network(read_opendrive(drive.road_file)), route(network, drive.start, drive.via) {
        const auto set = std::ranges::find(drive.lamp_sets, lamp_set, &LampSet::name);
        for (int tick = first; tick < std::min(last, tick_count(drive)); tick += every)
            moments.push_back(moment_at(state_at(tick, drive), drive, route, *set));
    }
};

ReadingKey named_reading(const std::string& name) { return key_of(name).value(); }

/// The samples that matter most, by central differences of the whole reading, others with them changed in nothing.
void expect_gradient(const ReadingOfLight& reading, const std::vector<Moment>& moments, const std::string& what, std::size_t most = 6) {
    const ReadingOfLight::Found found = reading.gradient(moments);
    ASSERT_TRUE(found.value.number()) << what << found.value.reason();
    ASSERT_FALSE(found.gradient.empty()) << what;
    for (std::size_t k = 0; k < found.gradient.size(); ++k) {
        const LampGradient& lamp = found.gradient[k];
        std::vector<std::size_t> order(lamp.per_cd.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return std::abs(lamp.per_cd[i]); });
        order.resize(most);
        for (const std::size_t i : order) {
            const double step = 1e-5 * lamp.file->table.cd[i];
            if (lamp.per_cd[i] == 0.0 || step == 0.0)
                continue;
            const auto changed = [&](double by) {
                ChangedTables tables;
                for (const LampGradient& one : found.gradient)
                    tables.push_back(one.file->table);
                tables[k].cd[i] += by;
                return reading.value(with_tables(moments, found.gradient, tables)).number().value();
            };
            const double by_difference = (changed(step) - changed(-step)) / (2.0 * step);
            const double rounding = 1e-13 * std::abs(*found.value.number()) / step;
            EXPECT_NEAR(lamp.per_cd[i], by_difference, 1e-6 * std::abs(by_difference) + rounding) << what << ", " << lamp.lamp << ' ' << i;
        }
    }
}

/// The twin's extent of these moments by a whole grid.
Value extent_by_grid(const PlayedDrive& played, const ReadingKey& reading, double LaneExtent::*member) {
    const Surface surface = reading.surface == ReadingSurface::road ? Surface::road : Surface::target;
    std::vector<double> at;
    if (reading.distance_m)
        at.push_back(*reading.distance_m);
    CensoredSamples samples;
    for (const Moment& moment : played.moments) {
        const ExtentGrid grid = make_extent_grid(played.route, moment, played.drive.bumper_m, *played.drive.extent);
        for (const LaneExtent& extent :
             measure_extent(grid, twin_illuminance_lx(grid, moment, surface), surface, {reading.threshold.value}, at))
            if (extent.lane == reading.lane) {
                if (!reading.distance_m)
                    samples.add(extent.*member);
                else if (!extent.widths.empty())
                    samples.add(extent.widths[0].cut_off ? Value::at_least(extent.widths[0].width_m) : Value(extent.widths[0].width_m));
            }
    }
    return samples.quantile(reading.statistic == Statistic::minimum ? 0.0 : reading.statistic == Statistic::p05 ? 0.05 : 0.5);
}

void expect_extent(const PlayedDrive& played, const std::string& name, double LaneExtent::*member = &LaneExtent::reach_centre_m) {
    const ReadingOfLight reading(named_reading(name), played.drive, played.route, played.moments);
    const Value by_grid = extent_by_grid(played, named_reading(name), member);
    ASSERT_TRUE(by_grid.number()) << name;
    EXPECT_NEAR(reading.value(played.moments).number().value(), *by_grid.number(), 1e-9) << name;
    expect_gradient(reading, played.moments, name);
}

TEST(ReadingOfLight, IsReachAndWidthOfOneMomentWithItsGradient) {
    const PlayedDrive played("straight.yaml", "xenon", 1, 20, 21);
    ASSERT_EQ(played.moments.size(), 1U);
    expect_extent(played, "reach_5lx_target_own_m");
    expect_extent(played, "reach_1lx_target_own_m");
    expect_extent(played, "reach_5lx_road_own_m");
    expect_extent(played, "reach_3lx_target_left_1_m");
    expect_extent(played, "reach_3lx_road_own_right_edge_m", &LaneExtent::reach_right_edge_m);
    expect_extent(played, "reach_3lx_target_own_left_edge_m", &LaneExtent::reach_left_edge_m);
    expect_extent(played, "width_3lx_road_all_at_20m_m");
    expect_extent(played, "width_3lx_target_all_at_33m_m");
}

TEST(ReadingOfLight, IsDecidedByTheMomentsOfItsStatistic) {
    const PlayedDrive played("s-bend.yaml", "halogen", 60);
    ASSERT_EQ(played.moments.size() % 2, 1U);
    for (const char* name : {"reach_3lx_target_own_m", "reach_3lx_target_own_min_m", "reach_3lx_target_own_p05_m", "reach_3lx_road_own_m",
                             "width_1lx_road_all_at_20m_m"})
        expect_extent(played, name);
    const auto deciders = [&](const char* name) {
        return ReadingOfLight(named_reading(name), played.drive, played.route, played.moments).gradient(played.moments).deciders;
    };
    EXPECT_EQ(deciders("reach_3lx_target_own_m").size(), 1U);
    EXPECT_EQ(deciders("reach_3lx_target_own_min_m").size(), 1U);
    const std::vector<ReadingOfLight::Decider> p05 = deciders("reach_3lx_target_own_p05_m");
    ASSERT_EQ(p05.size(), 2U);
    EXPECT_NEAR(p05[0].share + p05[1].share, 1.0, 1e-12);
}

TEST(ReadingOfLight, TellsWhatItTakesToStayBeyondABound) {
    const PlayedDrive played("s-bend.yaml", "halogen", 60);
    const auto side = [&](const char* name, bool at_least) {
        std::vector<std::pair<double, BeamGradient>> figures;
        ReadingOfLight(named_reading(name), played.drive, played.route, played.moments)
            .each_side_figure(played.moments, at_least,
                              [&](double figure, const BeamGradient& gradient) { figures.emplace_back(figure, gradient); });
        return figures;
    };
    const std::size_t moments = played.moments.size();
    ASSERT_EQ(moments % 2, 1U);
    EXPECT_EQ(side("reach_3lx_target_own_min_m", true).size(), moments);
    EXPECT_EQ(side("reach_3lx_target_own_min_m", false).size(), 1U);
    EXPECT_EQ(side("reach_3lx_target_own_p05_m", false).size(), 2U); // between two
    const auto figures = side("reach_3lx_target_own_m", true);
    ASSERT_EQ(figures.size(), moments / 2 + 1);
    const auto found =
        ReadingOfLight(named_reading("reach_3lx_target_own_m"), played.drive, played.route, played.moments).gradient(played.moments);
    EXPECT_EQ(figures.front().first, *found.value.number()); // its median moment first
    ASSERT_EQ(figures.front().second.size(), found.gradient.size());
    for (std::size_t k = 0; k < found.gradient.size(); ++k)
        EXPECT_EQ(figures.front().second[k].per_cd, found.gradient[k].per_cd);
    for (const auto& [figure, gradient] : figures)
        EXPECT_GE(figure, *found.value.number());
}

TEST(ReadingOfLight, TellsWhatItTakesOfAnEyeInARange) {
    PlayedDrive played("iihs-right-150.yaml", "halogen", 3);
    const auto count = [&](const std::string& statistic, bool at_least) {
        std::size_t figures = 0;
        const ReadingKey key =
            named_reading(fmt::format("glare_{}_facing_from_40_to_100m{}_lx", played.drive.seeing.glare->oncoming.front().name, statistic));
        ReadingOfLight(key, played.drive, played.route, played.moments)
            .each_side_figure(played.moments, at_least, [&](double, const BeamGradient&) { ++figures; });
        return figures;
    };
    const auto within = static_cast<std::size_t>(std::ranges::count_if(played.moments, [&](const Moment& moment) {
        const double to_go_m = played.drive.seeing.glare->oncoming.front().at_m - moment.distance_m - played.drive.bumper_m;
        return to_go_m >= 40.0 && to_go_m <= 100.0;
    }));
    ASSERT_GT(within, 5U);
    EXPECT_EQ(count("_max", false), within + 2); // light at both ends comes from between moments
    EXPECT_EQ(count("_max", true), 1U);
    EXPECT_NEAR(static_cast<double>(count("", false)), 0.5 * static_cast<double>(within), 1.1);
}

/// What all light moves, by 1 of itself: a reading that goes with the light gives itself, a ratio of two lights 0.
double by_all_light(const ReadingOfLight::Found& found) {
    ChangedTables doubled;
    for (const LampGradient& one : found.gradient) {
        doubled.push_back(one.file->table);
        for (double& cd : doubled.back().cd)
            cd *= 2.0;
    }
    return foretold_change(found.gradient, doubled);
}

TEST(ReadingOfLight, FollowsEverySensorEyeMirrorAndKerbAsTheirFoldsDo) {
    PlayedDrive played("iihs-right-150.yaml", "halogen", 3);
    played.drive.seeing.glare->mirrors = MirrorParameters{};
    played.drive.seeing.glare->mirrors->gaps_m = {15.0};
    played.drive.seeing.places = PlaceParameters{.kerb = true, .distances_m = {25.0}};
    played.drive.seeing.glare->adaptation_cdm2 = 0.1;
    SensorFold sensors(played.drive, played.route);
    OncomingFold oncoming(played.drive, played.route);
    MirrorFold mirrors(played.drive, played.route);
    PlaceFold places(played.drive, played.route);
    for (const Moment& moment : played.moments) {
        sensors.add(moment);
        oncoming.add(moment, played.drive.lamp_sets.front());
        mirrors.add(moment, played.drive.lamp_sets.front());
        places.add(moment);
    }
    int told = 0, refused = 0, of_eye = 0;
    for (const Readings& readings : {sensors.readings(), oncoming.readings(), mirrors.readings(), places.readings()})
        for (const Reading& one : readings) {
            const std::string name = one.name();
            try {
                const ReadingOfLight reading(one.key, played.drive, played.route, played.moments);
                const Value value = reading.value(played.moments);
                EXPECT_EQ(value.kind(), one.value.kind()) << name << ": " << value.reason();
                if (!one.value.number())
                    continue;
                EXPECT_NEAR(value.number().value(), *one.value.number(), 1e-9 * std::max(1.0, *one.value.number())) << name;
                if (*one.value.number() > 0.0)
                    expect_gradient(reading, played.moments, name, 3);
                ++told;
                const bool is_rating = one.key.quantity == Quantity::glare_de_boer;
                if (is_rating || one.key.quantity == Quantity::glare_veiling || one.key.quantity == Quantity::glare_increment) {
                    ++of_eye;
                    const double all = is_rating ? -2.0 / std::log(10.0) : *one.value.number(); // by W = 5 - 2 lg of the light
                    if (is_rating && one.key.to_m && one.key.statistic == Statistic::minimum)
                        continue; // at the range's end the rating runs in its logarithm between two moments
                    EXPECT_NEAR(by_all_light(reading.gradient(played.moments)), all, 1e-9 * std::abs(all)) << name;
                }
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), HasSubstr("a reading that is light or where light ends")) << name;
                ++refused;
            }
        }
    EXPECT_GT(told, 40);
    EXPECT_GE(of_eye, 3);
    EXPECT_GT(refused, 20);
}

TEST(ReadingOfLight, IsTheAreaOfALaneToTheBitWithItsGradient) {
    const PlayedDrive played("s-bend.yaml", "xenon", 110);
    for (const char* name : {"area_3lx_road_own_m2", "area_5lx_target_own_m2", "area_3lx_road_left_1_m2", "area_3lx_road_own_min_m2"}) {
        const ReadingOfLight reading(named_reading(name), played.drive, played.route, played.moments);
        EXPECT_EQ(reading.value(played.moments), extent_by_grid(played, named_reading(name), &LaneExtent::area_m2)) << name;
        expect_gradient(reading, played.moments, name);
    }
}

/// Of a fold's readings those that are told, each to the bit and with its gradient.
int expect_fold(const PlayedDrive& played, const Readings& readings) {
    int told = 0;
    for (const Reading& one : readings) {
        const std::string name = one.name();
        try {
            const ReadingOfLight reading(one.key, played.drive, played.route, played.moments);
            const Value value = reading.value(played.moments);
            EXPECT_EQ(value.kind(), one.value.kind()) << name << ": " << value.reason();
            EXPECT_EQ(value.figure(), one.value.figure()) << name;
            ++told;
            if (!value.number() || *value.number() == 0.0)
                continue;
            expect_gradient(reading, played.moments, name, 4);
            const double all = by_all_light(reading.gradient(played.moments)), tolerance = 1e-9 * *value.number();
            if (one.key.quantity != Quantity::detection && one.key.quantity != Quantity::visibility_level) {
                EXPECT_NEAR(all, one.key.quantity == Quantity::foreground ? *value.number() : 0.0, tolerance) << name;
            }
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a reading that is light or where light ends")) << name;
        }
    }
    return told;
}

TEST(ReadingOfLight, IsEvennessAsItsFoldHasItWithItsGradient) {
    for (const char* drive : {"straight.yaml", "s-bend.yaml"}) {
        PlayedDrive played(drive, "halogen", 55);
        played.drive.seeing.homogeneity = HomogeneityParameters{};
        HomogeneityFold fold(played.drive, played.route);
        for (const Moment& moment : played.moments)
            fold.add(moment);
        EXPECT_EQ(expect_fold(played, fold.readings()), 8 + 2 + 2) << drive; // all but patches
    }
}

TEST(ReadingOfLight, IsDetectionAndVisibilityAsTheirFoldHasThemWithTheirGradient) {
    for (const char* drive : {"s-bend.yaml", "adaptive-crest.yaml"}) {
        PlayedDrive played(drive, drive == std::string("s-bend.yaml") ? "xenon" : "low", 110);
        played.drive.seeing.visibility = VisibilityParameters{};
        VisibilityFold fold(played.drive, played.route);
        for (const Moment& moment : played.moments)
            fold.add(moment);
        const auto sights = static_cast<int>(std::ranges::count_if(fold.readings(), [](const Reading& one) {
            return one.key.quantity == Quantity::detection || one.key.quantity == Quantity::visibility_level;
        }));
        ASSERT_GT(sights, 20);
        EXPECT_EQ(expect_fold(played, fold.readings()), sights) << drive;
    }
}

TEST(ReadingOfLight, IsTheShareOfALimitThatIsLeft) {
    const PlayedDrive played("straight.yaml", "halogen", 1, 20, 23);
    std::vector<LimitedLight> lights;
    for (std::size_t k = 0; k < played.moments.size(); ++k)
        lights.push_back({k, {to_parent(played.moments[k].ego, {30.0 + static_cast<double>(k), 0.5, 0.6})}, k == 1 ? 5.0 : 50.0});
    const ReadingOfLight reading(lights);
    const ReadingOfLight::Found found = reading.gradient(played.moments);
    ASSERT_EQ(found.deciders.size(), 1U);
    EXPECT_EQ(found.deciders.front().moment, 1U); // its limit is the lowest
    EXPECT_NEAR(*found.value.number(), 100.0 * (1.0 - light_lx(played.moments[1], lights[1].place) / 5.0), 1e-9);
    EXPECT_NEAR(by_all_light(found), *found.value.number() - 100.0, 1e-9);
    expect_gradient(reading, played.moments, "margin");
}

TEST(ReadingOfLight, RefusesWhatItCannotTell) {
    const PlayedDrive played("straight.yaml", "xenon", 100);
    const auto refusal = [&](const std::string& name) {
        return tests::refusal_of([&] { ReadingOfLight(named_reading(name), played.drive, played.route, played.moments); });
    };
    EXPECT_THAT(refusal("patch_dark_own_m"), HasSubstr("reach_*_m, width_*_m"));
    EXPECT_THAT(refusal("reach_5lx_target_own_grid_error_m"), HasSubstr("reach_*_m, width_*_m"));
    EXPECT_THAT(refusal("area_3lx_road_all_m2"), HasSubstr("one lane"));
    EXPECT_THAT(refusal("detection_elk_own_m"), HasSubstr("a target at one of its places"));
    EXPECT_THAT(refusal("reach_5lx_target_all_m"), HasSubstr("one lane"));
    EXPECT_THAT(refusal("sensor_edge_max_lx"), HasSubstr("a drive with sensors"));
    EXPECT_THAT(refusal("glare_driver_facing_max_lx"), HasSubstr("oncoming drivers"));
}

TEST(ForetoldChange, AgreesWithWhatAHundredChangedLampsRead) {
    const PlayedDrive played("s-bend.yaml", "xenon", 110);
    for (const char* name : {"reach_5lx_target_own_m", "width_3lx_road_all_at_20m_m"}) {
        const ReadingOfLight reading(named_reading(name), played.drive, played.route, played.moments);
        const std::vector<double> sizes{1e-4, 1e-3};
        const auto tried = try_changes(reading, played.moments, reading.gradient(played.moments), sizes, 100, 1);
        for (std::size_t size = 0; size < sizes.size(); ++size) {
            double found = 0.0, error = 0.0;
            for (const ForetoldChange& one : tried[size]) {
                found += std::pow(one.found.number().value(), 2.0);
                error += std::pow(one.found.number().value() - one.foretold, 2.0);
            }
            EXPECT_GT(std::sqrt(found / 100.0), 1e-2 * sizes[size]) << name;                          // metres
            EXPECT_LT(std::sqrt(error / found), 10.0 * sizes[size]) << name << " of " << sizes[size]; // of second order
        }
    }
}

TEST(SpotMap, SaysWhatASpotOfLightChanges) {
    const PlayedDrive played("straight.yaml", "halogen", 1, 20, 21);
    const ReadingOfLight reading(named_reading("reach_5lx_target_own_m"), played.drive, played.route, played.moments);
    const ReadingOfLight::Found found = reading.gradient(played.moments);
    const LampFile& file = *found.gradient.front().file;
    const SpotMap map = spot_map(found.gradient, file, tests::steps(-3.0, 3.0, 0.1), tests::steps(-2.0, 1.0, 0.1), 0.5);
    const auto most = static_cast<std::size_t>(std::ranges::max_element(map.per_cd) - map.per_cd.begin());
    const BeamSpot spot{map.h_deg[most % map.h_deg.size()], map.v_deg[most / map.h_deg.size()], 0.5};
    ChangedTables tables(found.gradient.size(), with_spot(file.table, spot, 1.0));
    EXPECT_NEAR(foretold_change(found.gradient, tables), map.per_cd[most], 1e-9 * map.per_cd[most]);
    const double changed = *reading.value(with_tables(played.moments, found.gradient, tables)).number() - *found.value.number();
    EXPECT_NEAR(changed, map.per_cd[most], 1e-3 * map.per_cd[most]) << "1 cd more at " << spot.h_deg << ", " << spot.v_deg;
    EXPECT_EQ(map.per_cd.front(), 0.0) << "far from where the reach is decided";
}

} // namespace
} // namespace fernlicht
