// Names of readings: printed, parsed and printed again, each shape of each quantity, those that were accepted, and random ones.
#include "metrics/readings/reading_key.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <stdexcept>

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
        {"probe_kerb-30m_twin_lx",
         {.quantity = Quantity::probe_illuminance, .subject = "kerb-30m", .aspect = Aspect::twin, .statistic = Statistic::median}},
        {"sensor_right-edge_at_50m_lx", {.quantity = Quantity::sensor_illuminance, .subject = "right-edge", .distance_m = 50.0}},
        {"sensor_right-edge_max_lx", {.quantity = Quantity::sensor_illuminance, .subject = "right-edge", .statistic = Statistic::maximum}},
        {"glare_opposite_time_above_10percent_s",
         {.quantity = Quantity::glare_time, .subject = "opposite", .threshold = {10.0, ThresholdUnit::percent}}},
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

TEST(ReadingKey, EveryShapeLeadsBackToItsKeyAndNoTwoShareAName) {
    std::set<std::string> names;
    std::size_t shapes = 0;
    for (const QuantityRow& row : quantities())
        for (const ReadingKey& shape :
             shapes_of({.quantity = row.quantity, .subject = "a_b-c.1", .lane = "left 3", .threshold = {0.5}, .distance_m = 12.5})) {
            const std::string name = name_of(shape);
            EXPECT_EQ(key_of(name), shape) << name;
            names.insert(name);
            ++shapes;
        }
    EXPECT_EQ(names.size(), shapes);
    EXPECT_GT(shapes, 150U);
}

TEST(ReadingKey, NamesOfAcceptedResultsComeBack) {
    std::set<std::string> units;
    std::size_t readings = 0;
    for (const auto& file : std::filesystem::recursive_directory_iterator(std::string(FERNLICHT_SOURCE_DIR) + "/references/objects")) {
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
        auto shapes = shapes_of(
            {.quantity = row.quantity, .subject = subject, .lane = lane, .threshold = {threshold}, .distance_m = std::ldexp(threshold, 3)});
        ReadingKey& shape = shapes[below(shapes.size())];
        if (shape.aspect == Aspect::value && below(8) == 0)
            shape.aspect = Aspect::standard_error;
        if (row.subject != SubjectKind::none && !is_clear_subject(row.subject, subject))
            continue;
        const std::string name = name_of(shape);
        EXPECT_EQ(key_of(name), shape) << name;
    }
}

TEST(ReadingKey, WhatIsNoNameIsRefused) {
    for (const char* name : {"",
                             "reach",
                             "reach_5lx_rod_own_m",
                             "reach_road_own_m",
                             "reach_5lx_road_own",
                             "reach_5lx_road_own_max_m",
                             "reach_5lx_road_own_m2",
                             "reach_5.0lx_road_own_m",
                             "reach_+5lx_road_own_m",
                             "reach_-5lx_road_own_m",
                             "reach_infl_road_own_m",
                             "reach_1e999lx_road_own_m",
                             "reach_5lx_road_left_m",
                             "reach_5lx_road_left_01_m",
                             "reach_5lx_road_left 1_m",
                             "Reach_5lx_road_own_m",
                             " reach_5lx_road_own_m",
                             "reach_5lx_road_own_m ",
                             "width_5lx_road_own_m",
                             "area_5lx_road_own_m",
                             "probe__lx",
                             "probe_lx",
                             "probe_a b_lx",
                             "sensor_a_lx",
                             "glare__facing_max_lx",
                             "glare_a_facing_lx",
                             "glare_a_time_above_5_de_boer_s",
                             "detection_card_m",
                             "detection_card_own_max_m",
                             "visibility_level_card_own_at_50m_1",
                             "control_class_x_share",
                             "frame_time_ms",
                             "_time_median_ms",
                             "board_top_at_5m_lx",
                             "reach_5lx_road_own_grid_error_standard_error_m",
                             "reach_5lx_road_own_standard_error_lx",
                             "foreground_ratio_own_standard_error_",
                             "_standard_error_m"})
        EXPECT_FALSE(key_of(name)) << name;
}

TEST(ReadingKey, WhatNoReadingHasIsNotNamed) {
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
    for (const char* name : {"x_min", "x_max", "x_twin", "x_standard_error", "min_max"})
        EXPECT_FALSE(is_clear_subject(SubjectKind::probe, name)) << name;
    for (const char* name : {"min", "twin", "kerb-30m", "x_min_x", "x_lx", "minimum"})
        EXPECT_TRUE(is_clear_subject(SubjectKind::probe, name)) << name;
    for (const char* name : {"own", "mirrors_at_15m"})
        EXPECT_FALSE(is_clear_subject(SubjectKind::eye, name)) << name;
    for (const char* name : {"oncoming", "opposite", "lane-centre", "far_away", "mirrors", "own_2"})
        EXPECT_TRUE(is_clear_subject(SubjectKind::eye, name)) << name;
    EXPECT_FALSE(is_clear_subject(SubjectKind::mirror, "left_standard_error_lx"));
    for (const char* name : {"left", "inside", "left_at_15m"})
        EXPECT_TRUE(is_clear_subject(SubjectKind::mirror, name)) << name;
    for (const char* name : {"card", "pedestrian-dark", "card_own"})
        EXPECT_TRUE(is_clear_subject(SubjectKind::target, name)) << name;
    for (const char* name : {"", "a b", "a/b"})
        EXPECT_FALSE(is_clear_subject(SubjectKind::sensor, name)) << name;
    EXPECT_TRUE(is_clear_subject(SubjectKind::pass, pass_subject("display: glare")));
}

TEST(ReadingKey, AnEyeHasANameOfItsOwn) {
    for (const char* name : {"glare_mirrors_at_15m", "glare_own", "glare_far_away"})
        EXPECT_EQ(eye_name(eye_of(name).value()), name);
    EXPECT_EQ(eye_of("glare_mirrors_at_15m")->distance_m, 15.0);
    EXPECT_EQ(eye_name(key("glare_mirrors_at_15m_time_above_1lx_s")), "glare_mirrors_at_15m");
    EXPECT_FALSE(eye_of("detection_card_own"));
}

TEST(ReadingKey, KindsAreTold) {
    EXPECT_TRUE(is_extent(key("unlit_before_reach_1lx_road_own_m")));
    EXPECT_FALSE(is_extent(key("sensor_a_reach_5lx_m")));
    EXPECT_TRUE(is_time(key("frame_time_median_ms")));
    EXPECT_FALSE(is_time(key("glare_a_time_above_1lx_s"))) << "the drive's time, not the machine's";
    EXPECT_TRUE(says_how_exact(key("probe_a_twin_lx")));
    EXPECT_FALSE(says_how_exact(key("probe_twin_lx"))) << "a probe of this name";
    EXPECT_FALSE(says_how_exact(key("control_others_still_max_lx")));
}

} // namespace
} // namespace fernlicht
