// Names of readings: printed, parsed and printed again, each shape of each quantity, those that were accepted, and random ones.
#include "metrics/folds/reading_names.h"
#include "metrics/readings/reading_key.h"
#include "metrics/readings/reading_labels.h"
#include "metrics/readings/significance.h"
#include "metrics/readings/value.h"
#include "scenarios/drives/edits/mirrored_drive.h"
#include "scenarios/values/errors.h"
#include "tests/trial.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>

namespace fernlicht {
namespace {

ReadingKey key(const std::string& name) {
    const auto found = key_of(name);
    EXPECT_TRUE(found) << name;
    return found.value_or(ReadingKey{});
}

TEST(ReadingKey, EveryFieldHasItsPlaceInTheName) {
    const std::pair<const char*, ReadingKey> names[] = {
        {"reach_5lx_road_own_m",
         {.quantity = Quantity::reach,
          .surface = ReadingSurface::road,
          .lane = "own",
          .threshold = {5.0, ThresholdUnit::lx},
          .statistic = Statistic::median}},
        {"reach_0.5lx_target_left_2_twin_difference_worst_m",
         {.quantity = Quantity::reach,
          .surface = ReadingSurface::target,
          .lane = "left 2",
          .threshold = {0.5, ThresholdUnit::lx},
          .aspect = Aspect::twin_difference,
          .statistic = Statistic::maximum}},
        {"reach_1lx_road_all_edge_grid_error_m",
         {.quantity = Quantity::reach,
          .surface = ReadingSurface::road,
          .lane = "all",
          .threshold = {1.0, ThresholdUnit::lx},
          .place = ReadingPlace::edges,
          .aspect = Aspect::grid_error,
          .statistic = Statistic::median}},
        {"width_3lx_road_right_12_at_50m_p05_m",
         {.quantity = Quantity::width,
          .surface = ReadingSurface::road,
          .lane = "right 12",
          .threshold = {3.0, ThresholdUnit::lx},
          .distance_m = 50.0,
          .statistic = Statistic::p05}},
        {"reach_5lx_target_own_p95_m",
         {.quantity = Quantity::reach,
          .surface = ReadingSurface::target,
          .lane = "own",
          .threshold = {5.0, ThresholdUnit::lx},
          .statistic = Statistic::p95}},
        {"probe_kerb-30m_twin_lx",
         {.quantity = Quantity::probe_illuminance, .subject = "kerb-30m", .aspect = Aspect::twin, .statistic = Statistic::median}},
        {"sensor_right-edge_at_50m_lx", {.quantity = Quantity::sensor_illuminance, .subject = "right-edge", .distance_m = 50.0}},
        {"sensor_right-edge_max_lx", {.quantity = Quantity::sensor_illuminance, .subject = "right-edge", .statistic = Statistic::maximum}},
        {"glare_opposite_time_above_10percent_s",
         {.quantity = Quantity::glare_time, .subject = "opposite", .threshold = {10.0, ThresholdUnit::percent}}},
        {"glare_opposite_facing_from_30_to_60m_max_lx",
         {.quantity = Quantity::glare_facing, .subject = "opposite", .distance_m = 30.0, .to_m = 60.0, .statistic = Statistic::maximum}},
        {"glare_a_threshold_increment_from_7.5_to_15m_max_percent",
         {.quantity = Quantity::glare_increment, .subject = "a", .distance_m = 7.5, .to_m = 15.0, .statistic = Statistic::maximum}},
        {"glare_a_de_boer_from_60_to_120m_min",
         {.quantity = Quantity::glare_de_boer, .subject = "a", .distance_m = 60.0, .to_m = 120.0, .statistic = Statistic::minimum}},
        {"glare_opposite_facing_from_30_to_60m_lx",
         {.quantity = Quantity::glare_facing, .subject = "opposite", .distance_m = 30.0, .to_m = 60.0, .statistic = Statistic::median}},
        {"glare_opposite_veiling_from_30_to_60m_p95_cdm2",
         {.quantity = Quantity::glare_veiling, .subject = "opposite", .distance_m = 30.0, .to_m = 60.0, .statistic = Statistic::p95}},
        {"glare_mirrors_at_15m_facing_p95_lx",
         {.quantity = Quantity::glare_facing, .place = ReadingPlace::mirrors, .distance_m = 15.0, .statistic = Statistic::p95}},
        {"glare_own_de_boer_p05", {.quantity = Quantity::glare_de_boer, .place = ReadingPlace::own_eyes, .statistic = Statistic::p05}},
        {"mirror_left_at_15m_p95_lx",
         {.quantity = Quantity::mirror_illuminance, .subject = "left", .distance_m = 15.0, .statistic = Statistic::p95}},
        {"glare_mirrors_at_15m_adaptation_cdm2",
         {.quantity = Quantity::glare_adaptation, .place = ReadingPlace::mirrors, .distance_m = 15.0, .statistic = Statistic::median}},
        {"glare_own_length_below_5_de_boer_m",
         {.quantity = Quantity::glare_length, .threshold = {5.0, ThresholdUnit::de_boer}, .place = ReadingPlace::own_eyes}},
        {"glare_mirrors_at_15m_de_boer_min",
         {.quantity = Quantity::glare_de_boer, .place = ReadingPlace::mirrors, .distance_m = 15.0, .statistic = Statistic::minimum}},
        {"detection_pedestrian-dark_right_min_m",
         {.quantity = Quantity::detection, .subject = "pedestrian-dark", .place = ReadingPlace::right, .statistic = Statistic::minimum}},
        {"visibility_level_card_own_at_50m",
         {.quantity = Quantity::visibility_level, .subject = "card", .lane = "own", .distance_m = 50.0, .statistic = Statistic::median}},
        {"kerb_target_at_50m_lx",
         {.quantity = Quantity::kerb_illuminance, .surface = ReadingSurface::target, .distance_m = 50.0, .statistic = Statistic::median}},
        {"control_left_bends_glare_cost_at_50m_lx",
         {.quantity = Quantity::control_glare,
          .place = ReadingPlace::left_bends,
          .distance_m = 50.0,
          .aspect = Aspect::by_control,
          .statistic = Statistic::median}},
        {"control_class_v_share", {.quantity = Quantity::control_class, .subject = "v", .statistic = Statistic::mean}},
        {"display__glare_time_p95_ms", {.quantity = Quantity::pass_time, .subject = "display__glare", .statistic = Statistic::p95}},
        {"board_left_at_25m_standard_error_cdm2",
         {.quantity = Quantity::board_luminance,
          .place = ReadingPlace::left,
          .distance_m = 25.0,
          .aspect = Aspect::standard_error,
          .statistic = Statistic::median}},
        {"foreground_ratio_own_standard_error_1",
         {.quantity = Quantity::foreground_ratio, .lane = "own", .aspect = Aspect::standard_error, .statistic = Statistic::median}}};
    for (const auto& [name, fields] : names) {
        EXPECT_EQ(name_of(fields), name);
        EXPECT_EQ(key_of(name), fields) << name;
    }
}

TEST(ReadingKey, EveryShapeLeadsBackToItsKeyAsItsOtherSideDoesAndNoTwoShareAName) {
    std::set<std::string> names;
    std::size_t shapes = 0;
    for (const QuantityRow& row : quantities())
        for (const ReadingKey& shape : shapes_of({.quantity = row.quantity,
                                       .subject = "a_b-left.1",
                                       .lane = "left 3",
                                       .threshold = {0.5},
                                       .distance_m = 12.5,
                                       .to_m = 25.0})) {
            const std::string name = name_of(shape);
            EXPECT_EQ(key_of(name), shape) << name;
            EXPECT_EQ(name_of(key(other_side(name))), other_side(name));
            names.insert(name);
            ++shapes;
        }
    EXPECT_EQ(names.size(), shapes);
    EXPECT_GT(shapes, 140U);
}

TEST(ReadingKey, NamesOfAcceptedResultsComeBack) {
    std::size_t readings = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(std::string(FERNLICHT_SOURCE_DIR) + "/baselines/objects")) {
        if (!file.is_regular_file())
            continue;
        std::ifstream stream(file.path());
        const auto object = nlohmann::json::parse(stream);
        for (const auto& reading : object.value("readings", nlohmann::json::array())) {
            const std::string name = reading.at("name");
            EXPECT_EQ(name_of(key(name)), name);
            EXPECT_EQ(unit_of(key(name)), reading.at("unit").get<std::string>()) << name;
            ++readings;
        }
    }
    EXPECT_GT(readings, 10000U);
}

TEST(ReadingKey, RandomKeysComeBack) {
    std::mt19937 random(7);
    const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
    const char* const ends[] = {"_own", "_max", "_at_5m", "_time", "_eye", "_standard_error", "_min", "_right"};
    const std::string letters = "abcXYZ019._-";
    for (int i = 0; i < 4000; ++i) {
        const QuantityRow& row = quantities()[below(quantities().size())];
        std::string subject;
        for (std::size_t n = 1 + below(8); n > 0; --n)
            subject += below(3) == 0 ? std::string(ends[below(std::size(ends))]) + letters[below(letters.size())]
                                     : std::string(1, letters[below(letters.size())]);
        const double threshold = std::ldexp(static_cast<double>(below(1U << 20U)), static_cast<int>(below(40)) - 30);
        const std::string lane = below(2) == 0 ? "all" : "right " + std::to_string(1 + below(30));
        auto shapes = shapes_of({.quantity = row.quantity,
                                 .subject = subject,
                                 .lane = lane,
                                 .threshold = {threshold},
                                 .distance_m = std::ldexp(threshold, 3),
                                 .to_m = std::ldexp(threshold, 4)});
        ReadingKey& shape = shapes[below(shapes.size())];
        if (shape.aspect == Aspect::value && below(8) == 0)
            shape.aspect = Aspect::standard_error;
        if (row.subject != SubjectKind::none && !is_clear_subject(row.subject, subject))
            continue;
        const std::string name = name_of(shape);
        EXPECT_EQ(key_of(name), shape) << name;
    }
}

TEST(ReadingKey, WhatIsNoNameIsRefusedAndWhatNoReadingHasNotNamed) {
    for (const std::string& name : tests::each_of(
             {{"", "|reach|reach_5lx_rod_own_m|reach_road_own_m|reach_5lx_road_own|reach_5lx_road_own_max_m|reach_5lx_road_own_m2|"
                   "reach_5.0lx_road_own_m|reach_+5lx_road_own_m|reach_-5lx_road_own_m|reach_infl_road_own_m|reach_1e999lx_road_own_m|"
                   "reach_5lx_road_left_m|reach_5lx_road_left_01_m|reach_5lx_road_left 1_m|Reach_5lx_road_own_m| reach_5lx_road_own_m|"
                   "reach_5lx_road_own_m |width_5lx_road_own_m|area_5lx_road_own_m|probe__lx|probe_lx|probe_a b_lx|sensor_a_lx|"
                   "glare__facing_max_lx|glare_a_facing_p05_lx|glare_a_de_boer_p95|glare_a_time_above_5_de_boer_s|detection_card_m|"
                   "detection_card_own_max_m|"
                   "visibility_level_card_own_at_50m_1|control_class_x_share|frame_time_ms|_time_median_ms|board_top_at_5m_lx|"
                   "reach_5lx_road_own_grid_error_standard_error_m|reach_5lx_road_own_standard_error_lx|"
                   "foreground_ratio_own_standard_error_|_standard_error_m"}}))
        EXPECT_FALSE(key_of(name)) << name;
    EXPECT_THROW(name_of(ReadingKey{}), std::logic_error);
    ReadingKey reach = key("reach_5lx_road_own_m");
    reach.distance_m = 5.0;
    EXPECT_THROW(name_of(reach), std::logic_error) << "only a width is at a distance";
    reach = key("reach_5lx_road_own_m");
    reach.threshold.unit = ThresholdUnit::percent;
    EXPECT_THROW(name_of(reach), std::logic_error);
    ReadingKey probe = key("probe_x_lx");
    probe.subject = "x_min";
    EXPECT_THROW(name_of(probe), std::logic_error) << "the smallest of x";
}

TEST(ReadingKey, SubjectsThatOthersNamesHoldAreNotClear) {
    for (const auto& [kind, clear, names] :
         {std::tuple(SubjectKind::probe, false, "x_min|x_max|x_twin|x_standard_error|min_max"),
          std::tuple(SubjectKind::probe, true, "min|twin|kerb-30m|x_min_x|x_lx|minimum"),
          std::tuple(SubjectKind::eye, false, "own|mirrors_at_15m"),
          std::tuple(SubjectKind::eye, true, "oncoming|opposite|lane-centre|far_away|mirrors|own_2"),
          std::tuple(SubjectKind::mirror, false, "left_standard_error_lx"),
          std::tuple(SubjectKind::mirror, true, "left|inside|left_at_15m"),
          std::tuple(SubjectKind::target, true, "card|pedestrian-dark|card_own"), std::tuple(SubjectKind::sensor, false, "|a b|a/b")})
        for (const std::string& name : tests::each_of({{"", names}}))
            EXPECT_EQ(is_clear_subject(kind, name), clear) << name;
    EXPECT_TRUE(is_clear_subject(SubjectKind::pass, pass_subject("display: glare")));
}

TEST(ReadingKey, EyesHaveNamesOfTheirOwnAndKindsAreTold) {
    for (const char* name : {"glare_mirrors_at_15m", "glare_own", "glare_far_away"})
        EXPECT_EQ(eye_name(eye_of(name).value()), name);
    EXPECT_EQ(eye_of("glare_mirrors_at_15m")->distance_m, 15.0);
    EXPECT_EQ(eye_name(key("glare_mirrors_at_15m_time_above_1lx_s")), "glare_mirrors_at_15m");
    EXPECT_FALSE(eye_of("detection_card_own"));
    EXPECT_TRUE(is_extent(key("unlit_before_reach_1lx_road_own_m")));
    EXPECT_FALSE(is_extent(key("sensor_a_reach_5lx_m")));
    EXPECT_TRUE(is_time(key("frame_time_median_ms")));
    EXPECT_FALSE(is_time(key("glare_a_time_above_1lx_s"))) << "the drive's time, not the machine's";
    EXPECT_TRUE(is_uncertainty(key("probe_a_twin_lx")));
    EXPECT_FALSE(is_uncertainty(key("probe_twin_lx"))) << "a probe of this name";
    EXPECT_FALSE(is_uncertainty(key("control_others_still_max_lx")));
}

// Readings in words: the usual ones word for word, of all others that nothing is left open.

TEST(ReadingWords, SayWhatANameSaysAndLeaveNothingOpen) {
    const std::pair<const char*, const char*> readings[] = {
        {"reach_5lx_target_own_m", "reach at 5 lx on a target, own lane"},
        {"reach_0.5lx_road_left_1_left_edge_m", "reach at 0.5 lx on the road, left 1, left edge"},
        {"reach_5lx_road_own_twin_difference_worst_m", "reach at 5 lx on the road, own lane, largest, rendered against the twin"},
        {"width_1lx_road_all_at_20m_m", "width at 1 lx on the road, whole width, 20 m ahead"},
        {"width_1lx_road_all_at_20m_min_m", "width at 1 lx on the road, whole width, 20 m ahead, least"},
        {"area_1lx_road_all_p05_m2", "area at 1 lx on the road, whole width, 5th percentile"},
        {"probe_kerb_lx", "illuminance, probe kerb"},
        {"sensor_right-edge_at_50m_lx", "illuminance at 50 m, sensor right-edge"},
        {"glare_oncoming_facing_max_lx", "largest illuminance, eyes of an oncoming driver"},
        {"glare_opposite_facing_from_30_to_60m_max_lx", "largest illuminance at 30 to 60 m, eyes of oncoming driver opposite"},
        {"glare_opposite_facing_from_30_to_60m_lx", "illuminance at 30 to 60 m, eyes of oncoming driver opposite"},
        {"glare_opposite_facing_from_30_to_60m_p95_lx", "95th percentile of illuminance at 30 to 60 m, eyes of oncoming driver opposite"},
        {"mirror_left_at_15m_p95_lx", "95th percentile of illuminance on the mirror left of a car 15 m ahead"},
        {"glare_opposite_de_boer_from_30_to_60m_min", "smallest de Boer rating at 30 to 60 m, eyes of oncoming driver opposite"},
        {"glare_own_adaptation_cdm2", "adaptation luminance, eyes of the own driver"},
        {"glare_opposite_at_50m_lx", "illuminance at 50 m, eyes of oncoming driver opposite"},
        {"glare_far_away_length_above_0.5lx_m", "metres above 0.5 lx, eyes of oncoming driver far_away"},
        {"glare_mirrors_at_15m_de_boer_min", "smallest de Boer rating, mirrors of a car 15 m ahead"},
        {"glare_own_time_above_10percent_s", "time above 10 % of threshold increment, eyes of the own driver"},
        {"detection_card_own_m", "detection distance of card, own lane"},
        {"detection_pedestrian-dark_right_p05_m", "detection distance of pedestrian-dark, right edge of the lanes, 5th percentile"},
        {"visibility_level_card_own_at_50m", "visibility level of card, own lane, 50 m ahead"},
        {"kerb_at_50m_lx", "illuminance on the road at the right edge of the lanes, 50 m ahead"},
        {"board_overhead_at_50m_cdm2", "luminance of a board, overhead, 50 m ahead"},
        {"marking_left_at_50m_cdm2", "luminance of the left marking, 50 m ahead"},
        {"control_left_bends_reach_gain_5lx_m", "reach at 5 lx in left bends, gained by control"}};
    for (const auto& [name, words] : readings)
        EXPECT_EQ(reading_label(key_of(name).value()), words);
    for (const QuantityRow& row : quantities())
        for (const ReadingKey& key :
             shapes_of({.quantity = row.quantity, .subject = "a", .lane = "own", .threshold = {5.0}, .distance_m = 50.0}))
            EXPECT_THAT(reading_label(key), testing::Not(testing::ContainsRegex("[{}_]|  |, ,|,$|^ "))) << name_of(key);
}

// The table of quantities: complete, in order, without double ids.

TEST(Quantities, EachHasOneRowInTheOrderOfTheirNames) {
    std::set<std::string> ids;
    for (std::size_t i = 0; i < quantities().size(); ++i) {
        const QuantityRow& row = quantities()[i];
        EXPECT_EQ(static_cast<std::size_t>(row.quantity), i) << row.id;
        EXPECT_EQ(&row_of(row.quantity), &row);
        EXPECT_TRUE(ids.insert(row.id).second) << row.id;
        for (const char* text : {row.id, row.forms, row.unit, row.words, row.meaning})
            EXPECT_STRNE(text, "") << row.id;
    }
    EXPECT_EQ(row_of(Quantity::pass_time).id, std::string("pass_time")) << "the last one";
    EXPECT_EQ(quantities().size(), static_cast<std::size_t>(Quantity::pass_time) + 1);
}

TEST(Quantities, NamesEndInTheirUnitAndHoldTheirSubject) {
    const std::pair<const char*, const char*> ends[] = {{"m", "_m"},       {"m2", "_m2"},         {"lx", "_lx"},  {"cd/m2", "_cdm2"},
                                                        {"%", "_percent"}, {"s", "_s"},           {"ms", "_ms"},  {"1", ""},
                                                        {"1/m", "_per_m"}, {"1/deg", "_per_deg"}, {"deg", "_deg"}};
    for (const QuantityRow& row : quantities()) {
        const auto end =
            std::find_if(std::begin(ends), std::end(ends), [&](const auto& known) { return std::string(known.first) == row.unit; });
        ASSERT_NE(end, std::end(ends)) << row.unit;
        for (const ReadingKey& key :
             shapes_of({.quantity = row.quantity, .subject = "a", .lane = "own", .threshold = {1.0}, .distance_m = 5.0, .to_m = 9.0}))
            EXPECT_TRUE(name_of(key).ends_with(end->second)) << name_of(key);
    }
    for (const QuantityRow& row : quantities())
        EXPECT_EQ(row.subject != SubjectKind::none,
                  std::string(row.forms).find("<name>") != std::string::npos || std::string(row.forms).find("<eye>") != std::string::npos)
            << row.id;
}

// A limit on a reading that cannot exist is found before a drive is played, not after.

Drive limited_by(const std::string& reading) {
    return {.file = "night.yaml", .probes = {{"kerb-30m", 30.0, 0.0, 0.0}}, .limits = {{reading, 1.0, std::nullopt, 7}}};
}

TEST(ReadingNames, WhatARunCanMeasureIsKnownAndAllElseRefused) {
    for (const char* name : {"reach_5lx_road_own_m", "reach_0.5lx_target_left_1_min_m", "width_3lx_road_all_at_50m_m",
                             "area_1lx_target_own_m2", "unlit_before_reach_1lx_road_own_m", "reach_1lx_target_own_grid_error_m",
                             "probe_kerb-30m_lx", "probe_kerb-30m_twin_lx", "frame_time_median_ms"})
        EXPECT_NO_THROW(check_names(limited_by(name))) << name;
    for (const char* name : {"reach_1lx_rod_own_m", "reach_road_own_m", "width", "probe_kerb_lx", "probe_kerb-30m", "frame_time_ms", ""})
        EXPECT_THAT(tests::refusal_of([&] { check_names(limited_by(name)); }), testing::HasSubstr("night.yaml:7: limits: found reading '"));
    Drive drive = limited_by("probe_kerb-30m_lx");
    drive.probes.push_back({"kerb-30m_max", 30.0, 1.0, 0.0});
    EXPECT_THROW(check_names(drive), InputError) << "its median would be the largest of kerb-30m";
    drive.probes.back().name = "kerb-31m";
    EXPECT_NO_THROW(check_names(drive));
    drive.seeing.glare.emplace().oncoming.push_back({.name = "own"});
    EXPECT_THROW(check_names(drive), InputError) << "the own driver's eyes";
}

// Changes between a figure and a bound.

/// Of a reach that goes on beyond the grid nothing is told of the grid's error.
ReadingsOfCell reaching(const Value& reach) {
    ReadingsOfCell played;
    const auto put = [&](const char* name, const Value& value) {
        const ReadingKey key = key_of(name).value();
        played.readings[key] = {key, value};
        if (value.number())
            played.readings[key].sensitivity.aim_up = 4.0;
    };
    put("reach_1lx_target_own_m", reach);
    if (reach.number()) {
        put("reach_1lx_target_own_grid_error_m", 0.3);
        put("reach_1lx_target_own_twin_difference_m", 0.1);
    }
    return played;
}

ReadingChange change(const Value& now, const Value& before) {
    return change_of_reading(key_of("reach_1lx_target_own_m").value(), reaching(now), reaching(before));
}

TEST(Significance, ABoundIsExactAsABound) {
    for (const auto& [now, before] : {std::pair{Value::at_least(200.0), Value(56.9)}, std::pair{Value(56.9), Value::at_least(200.0)}}) {
        const ReadingChange found = change(now, before);
        EXPECT_EQ(found.kind, ChangeKind::real) << found.reason_unknown;
        EXPECT_DOUBLE_EQ(found.uncertainty.value(), 0.4) << "that of the figure alone";
        EXPECT_NEAR(found.least(), 143.1, 1e-9);
    }
    EXPECT_EQ(change(Value::at_least(200.0), 199.9).kind, ChangeKind::unknown) << "it may be much more";
    EXPECT_EQ(change(Value::at_least(200.0), Value::at_least(200.0)).reason_unknown,
              "both are over 200 m (a larger `measure.extent.ahead_m` of the drives looks farther; in a study it is one of `axes:`)");
}

TEST(Significance, QuantilesOfGlareAreJudgedAsTheLargestIs) {
    for (const auto& [now, kind] : {std::pair(0.6, ChangeKind::real), {0.52, ChangeKind::within_aim}, {0.5 + 1e-8, ChangeKind::none}})
        for (const char* name : {"glare_a_facing_from_30_to_60m_lx", "glare_a_facing_from_30_to_60m_p95_lx",
                                 "glare_a_facing_from_30_to_60m_max_lx", "mirror_left_at_15m_p95_lx", "glare_mirrors_at_15m_facing_lx"}) {
            const ReadingKey key = key_of(name).value();
            const auto side = [&](double lx) {
                ReadingsOfCell played;
                played.readings[key] = {key, Value(lx)};
                played.readings[key].sensitivity.aim_up = 0.05;
                return played;
            };
            const ReadingChange found = change_of_reading(key, side(now), side(0.5), 0.01);
            EXPECT_EQ(found.kind, kind) << name << ' ' << now;
            EXPECT_NEAR(found.noise_effect.value(), 3.0 * 0.01 * now, 1e-9) << "goes with the light";
            EXPECT_EQ(row_of(key.quantity).better, Better::lower);
        }
}

TEST(Significance, WhatLiesBetweenMomentsLeavesAChangeOpen) {
    const ReadingKey key = key_of("glare_a_facing_from_30_to_60m_max_lx").value();
    const auto side = [&](double lx, std::optional<double> between) {
        ReadingsOfCell played;
        played.readings[key] = {key, Value(lx)};
        played.readings[key].sensitivity.aim_up = 0.01;
        played.readings[key].between_moments = between;
        return played;
    };
    EXPECT_EQ(change_of_reading(key, side(0.6, {}), side(0.5, {})).kind, ChangeKind::real);
    EXPECT_EQ(change_of_reading(key, side(0.6, 0.03), side(0.5, 0.04)).kind, ChangeKind::real) << "0.05, and 0.01 by aim";
    const ReadingChange open = change_of_reading(key, side(0.6, 0.3), side(0.5, 0.4));
    EXPECT_EQ(open.kind, ChangeKind::unknown);
    EXPECT_THAT(open.reason_unknown, testing::HasSubstr("too few moments"));
    EXPECT_EQ(change_of_reading(key, side(0.5, 0.3), side(0.5, 0.4)).kind, ChangeKind::none);
}

TEST(Significance, TheGridsErrorIsAReadingAtEveryPlaceThatRestsOnIt) {
    for (const QuantityRow& row : quantities())
        if (row.exactness == Exactness::grid || row.exactness == Exactness::grid_and_drawing)
            for (ReadingKey shape : shapes_of({.quantity = row.quantity, .lane = "right 1", .threshold = {1.0}}))
                if (shape.aspect == Aspect::value) {
                    shape.place = shape.place == ReadingPlace::none ? ReadingPlace::none : ReadingPlace::edges;
                    shape.aspect = Aspect::grid_error;
                    shape.statistic = Statistic::median;
                    EXPECT_NO_THROW(name_of(shape)) << row.id;
                }
}

// Values that are numbers, bounds or not measured, and what they make of each other.

const Value none = Value::not_measured("dark");

TEST(Value, ADifferenceIsWhatBothLetItBe) {
    EXPECT_EQ(difference(90.0, 60.0, "m"), Value(30.0));
    EXPECT_EQ(difference(Value::at_least(200.0), 60.0, "m"), Value::at_least(140.0));
    EXPECT_EQ(difference(60.0, Value::at_least(200.0), "m"), Value::at_most(-140.0));
    EXPECT_EQ(difference(60.0, Value::at_most(10.0), "m"), Value::at_least(50.0));
    EXPECT_EQ(difference(Value::at_least(200.0), Value::at_most(10.0), "m"), Value::at_least(190.0));
    EXPECT_EQ(difference(Value::at_least(200.0), Value::at_least(200.0), "m"), Value::not_measured("both are over 200 m"));
    EXPECT_EQ(difference(Value::at_most(5.0), Value::at_most(5.0), "m"), Value::not_measured("both are below 5 m"));
    EXPECT_EQ(difference(Value::at_least(40.0), Value::at_least(200.0), "m"),
              Value::not_measured("one is over 40 m, the other over 200 m"));
    EXPECT_EQ(difference(none, 60.0, "m"), none);
    EXPECT_EQ(difference(60.0, none, "m"), none);
}

TEST(Value, KeepsALimitOrLeavesItOpenAndIsNeverNan) {
    const Value beyond = Value::at_least(200.0);
    EXPECT_EQ(holds(beyond, 180.0, {}), true);
    EXPECT_EQ(holds(beyond, {}, 150.0), false);
    EXPECT_EQ(holds(beyond, 220.0, {}), std::nullopt);
    EXPECT_EQ(holds(beyond, 180.0, 220.0), std::nullopt);
    EXPECT_EQ(holds(Value::at_most(30.0), 50.0, {}), false);
    EXPECT_EQ(holds(Value::at_most(30.0), {}, 30.0), true);
    EXPECT_EQ(holds(Value::at_most(30.0), 20.0, {}), std::nullopt);
    EXPECT_EQ(holds(61.0, 61.0, 61.0), true);
    EXPECT_EQ(holds(none, 1.0, {}), std::nullopt);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(Value{bad}, std::invalid_argument);
        EXPECT_THROW(Value::at_least(bad), std::invalid_argument);
        EXPECT_THROW(Value::at_most(bad), std::invalid_argument);
    }
}

TEST(CensoredSamples, QuantilesRestOnBoundsWhereTheyMust) {
    CensoredSamples moments;
    EXPECT_EQ(moments.quantile(0.5), Value::not_measured("not there in any moment"));
    for (const Value& value : {Value(130.0), Value(140.0), Value(150.0), Value::at_least(200.0)})
        moments.add(value);
    EXPECT_EQ(moments.quantile(0.0), Value(130.0));
    EXPECT_EQ(moments.quantile(0.5), Value(145.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(200.0));
    EXPECT_EQ(moments.quantile(0.9), Value::at_least(150.0 + 0.7 * 50.0)) << "of type 7: 0.7 of the way from the third to the fourth";
    EXPECT_FALSE(moments.mean().measured());
    moments.add(Value::not_measured("cut off"));
    EXPECT_EQ(moments.account(), "4 moments, 1 left out: cut off");
}

TEST(CensoredSamples, BoundsAmongTheNumbersRankWhereTheyMayLie) {
    CensoredSamples moments; // the first may be anything from 20 up
    for (const Value& value : {Value::at_least(20.0), Value(30.0), Value(40.0)})
        moments.add(value);
    EXPECT_EQ(moments.quantile(0.0), Value::at_least(20.0));
    EXPECT_EQ(moments.quantile(0.5), Value::at_least(30.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(40.0));
    moments.add(Value::at_most(35.0));
    EXPECT_EQ(moments.quantile(1.0), Value::at_least(40.0));
    EXPECT_EQ(moments.quantile(0.0), Value::at_most(30.0));
    EXPECT_EQ(moments.quantile(2.0 / 3.0), Value::not_measured("between 30 and 40"));
}

TEST(CensoredSamples, MeansNeedNumbers) {
    CensoredSamples moments;
    for (const double value : {1.0, 2.0, 6.0})
        moments.add(value);
    EXPECT_EQ(moments.mean(), Value(3.0));
    EXPECT_NEAR(*moments.standard_deviation().number(), std::sqrt(7.0), 1e-12);
    CensoredSamples cut;
    cut.add(Value::not_measured("cut off"));
    EXPECT_EQ(cut.quantile(0.5), Value::not_measured("cut off in every moment"));
}

} // namespace
} // namespace fernlicht
