// Readings in words: the usual ones word for word, of all others that nothing is left open.
#include "metrics/readings/reading_words.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

TEST(ReadingWords, SayWhatANameSays) {
    const std::pair<const char*, const char*> readings[] = {
        {"reach_5lx_target_own_m", "reach at 5 lx on a target, own lane"},
        {"reach_0.5lx_road_left_1_left_edge_m", "reach at 0.5 lx on the road, left 1, left edge"},
        {"reach_5lx_road_own_twin_difference_worst_m", "reach at 5 lx on the road, own lane, largest, drawn against calculated"},
        {"width_1lx_road_all_at_20m_m", "width at 1 lx on the road, whole width, 20 m ahead"},
        {"width_1lx_road_all_at_20m_min_m", "width at 1 lx on the road, whole width, 20 m ahead, least"},
        {"area_1lx_road_all_p05_m2", "area at 1 lx on the road, whole width, 5th percentile"},
        {"probe_kerb_lx", "illuminance, probe kerb"},
        {"sensor_right-edge_at_50m_lx", "illuminance 50 m before it, sensor right-edge"},
        {"glare_oncoming_facing_max_lx", "largest illuminance, eyes of an oncoming driver"},
        {"glare_opposite_at_50m_lx", "illuminance 50 m before it, eyes of oncoming driver opposite"},
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
        EXPECT_EQ(reading_in_words(key_of(name).value()), words);
}

TEST(ReadingWords, LeaveNothingOpen) {
    for (const QuantityRow& row : quantities())
        for (const ReadingKey& key :
             shapes_of({.quantity = row.quantity, .subject = "a", .lane = "own", .threshold = {5.0}, .distance_m = 50.0}))
            EXPECT_THAT(reading_in_words(key), testing::Not(testing::ContainsRegex("[{}_]|  |, ,|,$|^ "))) << name_of(key);
}

} // namespace
} // namespace fernlicht
