// Thirty nights with planted changes, each night added to a file and explained, as a nightly job would.
#include "runner/experiments/history/history_document.h"
#include "runner/write/document.h"
#include "tests/runner/experiments/history/planted_nights.h"
#include "tests/trial.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <set>

namespace fernlicht {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::date_of_night;
using tests::PlantedNights;
using tests::World;

constexpr int lamp_night = 6, slow_night = 10, driver_night = 14, first_drift = 17, last_drift = 26, both_night = 28, nights_played = 30;

World world_of(int night) {
    World world;
    if (night >= lamp_night)
        world.version["xenon"] = 1, world.lamp_light["xenon"] = 1.02;
    if (night >= slow_night)
        world.version["renderer"] = 1, world.slow = 1.1;
    if (night >= driver_night)
        world.driver = "Mesa 25.0.1", world.last_digits = 2e-6;
    const int drifted = std::clamp(night - first_drift + 1, 0, last_drift - first_drift + 1);
    world.version["scenarios"] = drifted;
    world.drift_of_halogen = std::pow(1.001, drifted);
    if (night >= both_night)
        world.version["halogen"] = 1, world.lamp_light["halogen"] = 1.03, world.version["metrics"] = 1, world.program_area = 0.995;
    return world;
}

/// One sentence a claim, for comparing.
std::set<std::string> claims_of(const HistoryFindings& found) {
    std::set<std::string> claims;
    const auto date = [&](std::size_t night) { return found.nights[night].date(); };
    const auto names = [](const InputChanges& causes) {
        std::string all;
        for (const InputChange& cause : causes)
            all += std::string(" ") + cause_name(cause_of(cause.kind)) + ":" + cause.name;
        return all;
    };
    for (const HistoryEvent& event : found.events)
        claims.insert(
            fmt::format("{}{} moved {} within {}", date(event.night), names(event.causes), event.moved.size(), event.within_rounding));
    for (const HistoryDrift& drift : found.drifts)
        claims.insert(fmt::format("{}{} drift of {}", date(drift.nights.front()), names(drift.causes), drift.moved.size()));
    for (const HistoryTimes::Change& change : found.times.changes)
        claims.insert(fmt::format("{}{} time of {}", date(change.night), names(change.causes), change.cell));
    return claims;
}

/// Plays a cell of tonight with other inputs, as the store and the player would.
TellApart player_of(const PlantedNights& planted, int night, int& played) {
    return [&planted, night, &played](const CellRequest& request) {
        World world = world_of(night);
        const World before = world_of(night - 1);
        ++played;
        for (const CellInput& input : request.inputs)
            if (input.kind == InputKind::lamp) {
                const std::string lamp = input.name.substr(0, input.name.find('-'));
                if (input.hash == before.hash(lamp) && before.lamp_light.contains(lamp))
                    world.lamp_light[lamp] = before.lamp_light.at(lamp);
                else if (input.hash == before.hash(lamp))
                    world.lamp_light.erase(lamp);
            } else if (input.kind == InputKind::program) {
                EXPECT_EQ(input.hash, world.hash(input.name)) << "today's program";
            }
        NightReadings readings;
        for (const auto& [name, value] : planted.readings(request.cell, world))
            readings.emplace(name, value);
        return Replayed{readings};
    };
}

/// Each night on its own, with the file as it is then.
struct ThirtyNights {
    std::filesystem::path file = tests::new_folder() / "history.db";
    std::vector<std::set<std::string>> claims;
    HistoryFindings last;
    int replays = 0;

    explicit ThirtyNights(std::uint64_t seed) {
        PlantedNights planted(seed);
        for (int night = 0; night < nights_played; ++night) {
            const StudyResult result = planted.play(night, world_of(night));
            HistoryOptions options;
            options.tell_apart = player_of(planted, night, replays);
            last = history_of(file, result, "/nights/" + date_of_night(night), options);
            claims.push_back(claims_of(last));
            History history(file, History::For::collecting);
            Night tonight = night_of_study(result, "/nights/" + date_of_night(night));
            take_replays(tonight, last.replays);
            const std::int64_t number = history.add(tonight).number;
            if (night == 0)
                history.accept(number, "the beginning");
        }
    }
};

const ThirtyNights& first_thirty() {
    static const ThirtyNights thirty(1);
    return thirty;
}

const std::set<std::string> planted_claims{
    "2026-01-07 inputs:xenon-low.ies moved 9 within 0",
    "2026-01-11 program:renderer time of s-bend_halogen",
    "2026-01-11 program:renderer time of s-bend_xenon",
    "2026-01-11 program:renderer time of straight_halogen",
    "2026-01-11 program:renderer time of straight_xenon",
    "2026-01-15 machine:driver moved 0 within 24",
    "2026-01-18 program:scenarios drift of 3",
    "2026-01-29 inputs:halogen-low.ies program:metrics moved 12 within 0", // reaches and the probe by the lamp, areas by the program
    "2026-01-29 program:metrics moved 3 within 0",                         // areas of the other lamp
};

TEST(ThirtyNights, AllPlantedChangesAreFoundDatedAndAttributedAndNothingElseIsClaimed) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const ThirtyNights thirty(seed);
        EXPECT_EQ(thirty.claims.back(), planted_claims) << seed;
        for (int night = 0; night < nights_played; ++night) {
            for (const std::string& claim : thirty.claims[static_cast<std::size_t>(night)]) {
                EXPECT_LE(claim.substr(0, 10), date_of_night(night));
                // Two nights of a drift are two changes; from the third on they are one drift.
                if (night != first_drift && night != first_drift + 1) {
                    EXPECT_TRUE(planted_claims.contains(claim)) << "seed " << seed << ", " << date_of_night(night) << ": " << claim;
                }
            }
            // What readings tell, they tell the same night.
            for (const std::string& claim : planted_claims)
                if (claim.substr(0, 10) == date_of_night(night) && claim.find(" time of ") == std::string::npos && night != first_drift) {
                    EXPECT_TRUE(thirty.claims[static_cast<std::size_t>(night)].contains(claim)) << claim;
                }
        }
        // A tenth more time is known after three nights in most cells, after four in all.
        const auto times_known = [&](int night) {
            return std::ranges::count_if(thirty.claims[static_cast<std::size_t>(night)],
                                         [](const std::string& one) { return one.find(" time of ") != std::string::npos; });
        };
        EXPECT_GE(times_known(slow_night + 2), 3) << seed;
        EXPECT_EQ(times_known(slow_night + 3), 4) << seed;
    }
}

TEST(ThirtyNights, TheDriftIsTheSumAndDatedWhereItPassesItsBound) {
    const ThirtyNights& thirty = first_thirty();
    ASSERT_EQ(thirty.last.drifts.size(), 1U);
    const HistoryDrift& drift = thirty.last.drifts.front();
    EXPECT_EQ(drift.nights.size(), 10U);
    EXPECT_EQ(drift.nights.back(), static_cast<std::size_t>(last_drift));
    EXPECT_EQ(drift.exceeded, static_cast<std::size_t>(first_drift + 4)); // 1.001^5 is beyond 0.5 %
    for (const MovedReading& moved : drift.moved)
        EXPECT_NEAR(*moved.share(), std::pow(1.001, 10) - 1.0, 1e-12) << moved.cell;
    // The sum since the accepted night has the lamp's part as well.
    const auto sum = std::ranges::find_if(
        thirty.last.since, [](const MovedReading& one) { return one.cell == "straight_halogen" && one.reading == "probe_kerb_lx"; });
    ASSERT_NE(sum, thirty.last.since.end());
    EXPECT_NEAR(*sum->share(), std::pow(1.001, 10) * 1.03 - 1.0, 3e-6);
}

TEST(ThirtyNights, LampAndProgramOfOneNightAreToldApartByOneCell) {
    const ThirtyNights& thirty = first_thirty();
    EXPECT_EQ(thirty.replays, 1) << "one cell, and once: the night after knows it";
    const auto both = std::ranges::find_if(thirty.last.events, [](const HistoryEvent& event) { return event.told_apart.has_value(); });
    ASSERT_NE(both, thirty.last.events.end());
    EXPECT_EQ(thirty.last.nights[both->night].date(), date_of_night(both_night));
    EXPECT_TRUE(both->told_apart->program_moved);
    EXPECT_TRUE(both->told_apart->inputs_moved);
    ASSERT_EQ(both->told_apart->parts.size(), 4U);
    for (const ToldApart::Part& part : both->told_apart->parts) {
        const bool is_area = part.reading.starts_with("area");
        EXPECT_NEAR(*part.with_earlier_inputs.number() / *part.before.number(), is_area ? 0.995 : 1.0, 1e-12) << part.reading;
        EXPECT_NEAR(*part.now.number() / *part.with_earlier_inputs.number(), is_area ? 1.0 : 1.03, 1e-12) << part.reading;
    }
}

TEST(ThirtyNights, ThePageLeadsWithWhatChanged) {
    const ThirtyNights& thirty = first_thirty();
    const Document page = document(thirty.last);
    EXPECT_EQ(page.sections.front().title, "What changed since 2026-01-01");
    const std::string text = document_text(page);
    EXPECT_THAT(
        text,
        HasSubstr("4 changes, 1 drift and 1 change of times since the accepted night of 2026-01-01 (\"the beginning\"), in 29 nights."));
    const World before = world_of(lamp_night - 1), after = world_of(lamp_night);
    EXPECT_THAT(text, HasSubstr(fmt::format("2026-01-07: inputs: lamp xenon-low.ies ({} → {}); 9 readings of 3 cells, above all reach at 5 "
                                            "lx on a target, own lane, xenon on ",
                                            before.hash("xenon").substr(0, 12), after.hash("xenon").substr(0, 12))));
    EXPECT_THAT(text, HasSubstr("(+2 %)"));
    EXPECT_THAT(text,
                HasSubstr("2026-01-15: machine: driver Mesa 22.3.6 → Mesa 25.0.1; 24 readings of 6 cells within rounding, at most 0.0"));
    EXPECT_THAT(text, HasSubstr("2026-01-18 to 2026-01-27: drift in 10 nights; 3 readings of 3 cells"));
    EXPECT_THAT(text, HasSubstr("(+1 %), beyond 0.5 % since 2026-01-22; program: sources in scenarios"));
    EXPECT_THAT(text, AllOf(HasSubstr("both moved readings"), HasSubstr("own lane: program 0 %, inputs +3 %"),
                            HasSubstr("whole width: program −0.5 %, inputs 0 %")));
    EXPECT_THAT(text, HasSubstr("2026-01-11: time a frame of 4 cells +"));
    EXPECT_THAT(text, HasSubstr("Benjamini and Hochberg over all cells, at a false discovery rate of 1 %"));
    EXPECT_THAT(text, HasSubstr("Changed, and moved no reading"));
    EXPECT_THAT(text, HasSubstr("2026-01-11: program: sources in renderer"));
    EXPECT_THAT(text, HasSubstr("/nights/2026-01-01"));
    const std::vector<Plot> lines = sparklines(thirty.last);
    ASSERT_GE(lines.size(), 3U);
    EXPECT_EQ(lines.back().name, "history-frame_s");
    EXPECT_THAT(plot_svg(lines.front()), AllOf(HasSubstr("halogen"), HasSubstr("xenon"), HasSubstr("s-bend, night"), HasSubstr("<circle")));
    HistoryFindings long_names = thirty.last;
    const std::string condition = "night, aim -1.3 %, 13.2 V, damp road, rain on the windscreen";
    for (NightCell& cell : long_names.nights.back().cells)
        cell.condition = condition;
    EXPECT_THAT(plot_svg(sparklines(long_names).front()), HasSubstr("s-bend, " + condition));
    EXPECT_THAT(document_html(page, thirty.last), HasSubstr("What changed since 2026-01-01"));
}

/// Two nights of one world each, explained.
HistoryFindings explained(const std::vector<World>& worlds, const HistoryOptions& options = {}) {
    PlantedNights planted(7);
    std::vector<Night> nights;
    for (std::size_t i = 0; i < worlds.size(); ++i)
        nights.push_back(night_of_study(planted.play(static_cast<int>(i), worlds[i]), "/nights/" + std::to_string(i)));
    nights.front().accepted = true;
    return explain_nights(std::move(nights), options);
}

TEST(HistoryCauses, WithoutAPlayerItSaysWhyItCannotTell) {
    World both;
    both.version["xenon"] = both.version["metrics"] = 1;
    both.lamp_light["xenon"] = 1.05;
    EXPECT_THAT(document_text(document(explained({{}, both}))),
                AllOf(HasSubstr("cannot be told apart: no cell was played"), HasSubstr("inputs: lamp xenon-low.ies"),
                      HasSubstr("program: sources in metrics")));
    EXPECT_THAT(document_text(document(explained({{}, both, both}))), HasSubstr("its program is no longer the one at hand"));
    const HistoryFindings refused = explained({{}, both}, {.tell_apart = [](const CellRequest&) {
                                                  return Replayed{std::nullopt, "the store lost the lamp"};
                                              }});
    EXPECT_THAT(document_text(document(refused)), HasSubstr("cannot be told apart: the store lost the lamp"));
    EXPECT_TRUE(refused.replays.empty());
}

TEST(HistoryCauses, ALampThatChangedInItsWordsAlone) {
    World both;
    both.version["xenon"] = both.version["metrics"] = 1;
    both.program_area = 0.9;
    HistoryOptions options;
    options.tell_apart = [&](const CellRequest& request) {
        EXPECT_EQ(request.study, "planted");
        EXPECT_EQ(request.folder_before, "/nights/0");
        NightReadings readings;
        for (const auto& [name, value] : PlantedNights(7).readings(request.cell, both))
            readings.emplace(name, value);
        return Replayed{readings};
    };
    const HistoryFindings found = explained({{}, both}, options);
    EXPECT_THAT(document_text(document(found)),
                HasSubstr("the program alone moved them (area at 5 lx on the road, whole width: program −10 %, inputs 0 %)"));
}

TEST(HistoryCauses, ABitThatMovesWithoutACauseIsAClaim) {
    World odd;
    odd.last_digits = 1e-15;
    const HistoryFindings found = explained({{}, odd});
    ASSERT_EQ(found.events.size(), 1U);
    EXPECT_TRUE(found.events.front().causes.empty());
    EXPECT_THAT(document_text(document(found)), HasSubstr("cause not known: inputs, program and machine are as they were"));
}

TEST(HistoryCauses, NothingChangedIsSaidWithItsNumbers) {
    const HistoryFindings found = explained({{}, {}, {}});
    EXPECT_TRUE(found.nothing_changed());
    EXPECT_THAT(
        document_text(document(found)),
        HasSubstr(
            "Nothing changed since the accepted night of 2026-01-01, in 2 nights: 24 readings of 6 cells are the same to the last bit."));
    EXPECT_THAT(document_text(document(explained({{}}))), HasSubstr("This is the first night in the history."));
}

TEST(HistoryCauses, TwoMachinesInTurnAreComparedEachWithItself) {
    World other;
    other.driver = "Mesa 25.0.1";
    other.last_digits = 1e-2; // far beyond rounding
    const HistoryFindings found = explained({{}, other, {}, other, {}, other});
    ASSERT_EQ(found.events.size(), 1U) << "the second machine's first night";
    EXPECT_EQ(found.events.front().night, 1U);
    EXPECT_EQ(causes_of(found.events.front().causes), "machine");
    EXPECT_THAT(explained({{}, other, {}, other, {}}).events, IsEmpty());
}

TEST(HistoryCauses, NightsThatKeptNoInputsKnowProgramAndMachine) {
    PlantedNights planted(7);
    std::vector<Night> nights;
    for (int i = 0; i < 3; ++i) {
        World world;
        world.driver = i == 2 ? "Mesa 25.0.1" : "Mesa 22.3.6";
        world.program_area = i == 0 ? 1.0 : 1.1;
        world.last_digits = i == 2 ? 0.01 : 0.0;
        StudyResult result = planted.play(i, world);
        result.context.versions = {{"fernlicht", i == 0 ? "0.1" : "0.2"}};
        result.context.os = fmt::format("Debian 12.{}", i); // decides over times alone
        for (CellResult& cell : result.cells)
            cell.inputs.clear();
        nights.push_back(night_of_study(result, "/n"));
    }
    const HistoryFindings found = explain_nights(nights);
    ASSERT_EQ(found.events.size(), 2U);
    EXPECT_EQ(phrase_of(found.events[0].causes), "program: fernlicht 0.1 → 0.2");
    EXPECT_EQ(phrase_of(found.events[1].causes), "machine: driver Mesa 22.3.6 → Mesa 25.0.1");
    EXPECT_THAT(document_text(document(found)), HasSubstr("program: fernlicht 0.1 → 0.2 (what went in was not kept)"));
}

/// A drive as it is played differs from lamp to lamp: one edit of its file is one change with its keys, and what the study sets is told as
/// that.
TEST(HistoryCauses, ADriveThatIsPlayedOtherwiseIsOneChange) {
    PlantedNights planted(7);
    World brighter;
    brighter.program_area = 1.1;
    std::vector<Night> nights;
    for (int i = 0; i < 3; ++i) {
        StudyResult result = planted.play(i, i == 1 ? brighter : World{});
        result.study.conditions.aim_percent = {i < 2 ? -1.0 : -1.1};
        for (CellResult& cell : result.cells) {
            std::erase_if(cell.inputs, [](const CellInput& input) { return input.kind == InputKind::program; });
            if (i > 0)
                cell.inputs.push_back({InputKind::lamp, "another.ies", "0"});
            cell.inputs.push_back({InputKind::drive, "straight.yaml", fmt::format("{}{:031}", i, cell.cell.lamp)});
            for (const char* key : {"lamp_sets", "start"})
                cell.inputs.push_back({InputKind::drive, std::string("straight.yaml: ") + key, fmt::format("{}{:031}", i, cell.cell.lamp)});
        }
        nights.push_back(night_of_study(result, "/n"));
    }
    const HistoryFindings found = explain_nights(nights);
    ASSERT_EQ(found.events.size(), 2U);
    EXPECT_EQ(phrase_of(found.events[0].causes),
              "inputs: drive straight.yaml (lamp_sets, start) as it is played, lamp another.ies (none → 0)");
    EXPECT_EQ(phrase_of(found.events[1].causes), "inputs: conditions night, aim -1 %, 13.2 V → night, aim -1.1 %, 13.2 V");
    const std::string text = document_text(document(found));
    EXPECT_THAT(text, AllOf(HasSubstr("on country, night, aim -1 %, 13.2 V: "), HasSubstr("on country, night, aim -1.1 %, 13.2 V: ")))
        << text;
}

TEST(HistoryCauses, AnUncertaintyMayMoveByRoundingOfItsReading) {
    PlantedNights planted(7);
    World program;
    program.version["metrics"] = 1;
    std::vector<Night> nights;
    for (int i = 0; i < 2; ++i) {
        Night night = night_of_study(planted.play(i, i == 0 ? World{} : program), "/n");
        auto readings = *night.cells[0].readings;
        readings["reach_5lx_target_own_twin_difference_m"] = Value(i == 0 ? 1e-6 : 9e-6); // of a reach of 10 m or more
        readings["reach_5lx_target_own_edge_grid_error_m"] = Value(i == 0 ? 0.2 : 0.3);   // of two edges: stands for itself
        readings["named_by_an_older_fernlicht"] = Value(i == 0 ? 1.0 : 2.0);
        night.cells[0].readings = std::make_shared<NightReadings>(readings);
        nights.push_back(night);
    }
    const HistoryFindings found = explain_nights(nights);
    ASSERT_EQ(found.events.size(), 1U);
    EXPECT_EQ(found.events[0].within_rounding, 1U);
    ASSERT_EQ(found.events[0].moved.size(), 2U);
    EXPECT_EQ(found.events[0].moved[0].reading, "named_by_an_older_fernlicht");
    EXPECT_THAT(document_text(document(found)), HasSubstr("named_by_an_older_fernlicht"));
}

TEST(HistoryCauses, NightsOfOneDateAreToldByTheirTimes) {
    PlantedNights planted(7);
    StudyResult again = planted.play(0, {});
    again.context.started_utc = "2026-01-01T05:30:00Z";
    const HistoryFindings found = explain_nights({night_of_study(planted.play(0, {}), "/a"), night_of_study(again, "/b")});
    EXPECT_THAT(document(found).sections.front().title, "What changed since 2026-01-01 02:00");
    StudyResult soon = planted.play(0, {});
    soon.context.started_utc = "2026-01-01T05:30:01Z";
    EXPECT_EQ(when_of({night_of_study(again, "/b"), night_of_study(soon, "/c")}, 1), "2026-01-01 05:30:01");
}

/// As the study asks for it: before it adds tonight, and when it goes on with a night that is there.
TEST(HistoryCauses, ANightIsComparedWithWhatWasAddedBeforeIt) {
    const std::filesystem::path file = tests::new_folder() / "history.db";
    PlantedNights planted(7);
    World lamp;
    lamp.version["xenon"] = 1;
    lamp.lamp_light["xenon"] = 1.1;
    const StudyResult ahead = planted.play(5, {}), tonight = planted.play(3, {}), later = planted.play(4, lamp);
    History history(file, History::For::collecting);
    history.accept(history.add(night_of_study(ahead, "/ahead")).number, "");
    const HistoryFindings found = history_of(file, tonight, "/tonight");
    EXPECT_FALSE(found.is_off_base());
    EXPECT_THAT(document_text(document(found)), AllOf(HasSubstr("since the accepted night of 2026-01-06"), HasSubstr("is dated after")));
    history.add(night_of_study(tonight, "/tonight"));
    history.add(night_of_study(later, "/later"));
    const HistoryFindings gone_on_with = history_of(file, tonight, "/tonight");
    EXPECT_EQ(gone_on_with.nights.size(), 2U) << "not with what came after it";
    EXPECT_FALSE(gone_on_with.is_off_base());
    EXPECT_EQ(*history_of(file, later, "/later").since.front().share() > 0.0, true) << "from before to after";
    // Whoever accepts a night that is dated rightly hears no more of it.
    history.accept(2, "");
    EXPECT_THAT(document_text(document(history_of(file, later, "/later"))), Not(HasSubstr("is dated after")));
}

TEST(HistoryTimes, NightsOnAnotherCpuTellNothingOfThisOne) {
    PlantedNights planted(7);
    std::vector<Night> nights;
    for (int night = 0; night < 40; ++night) {
        const bool other = night % 2 == 0 || night < 10;
        World world;
        world.slow = other ? 1.0 : night < 25 ? 1.5 : 1.8;
        StudyResult result = planted.play(night, world);
        result.context.cpu = other ? "Fast CPU (avx2)" : "Slow CPU (avx2)"; // one class
        nights.push_back(night_of_study(result, "/n"));
    }
    const HistoryTimes times = changes_of_times(nights, 0, 0.01);
    EXPECT_EQ(times.nights, 15U);
    ASSERT_EQ(times.changes.size(), 4U);
    for (const HistoryTimes::Change& change : times.changes) {
        EXPECT_EQ(change.night, 25U);
        EXPECT_NEAR(change.ratio, 1.2, 0.02);
    }
    EXPECT_THAT(document_text(trend_document(nights, "frame_s", {"straight_xenon"})), HasSubstr("2026-01-12  2026-01-24       7"));
    nights.pop_back();
    EXPECT_THAT(changes_of_times(nights, 0, 0.01).changes, IsEmpty());
}

TEST(HistoryCauses, ThereAndBackIsTwoChangesAndNoneInSum) {
    World other;
    other.version["xenon"] = 1;
    other.lamp_light["xenon"] = 1.1;
    const HistoryFindings found = explained({{}, other, {}});
    EXPECT_EQ(found.events.size(), 2U);
    EXPECT_THAT(found.since, IsEmpty());
    EXPECT_FALSE(found.is_off_base());
    EXPECT_THAT(document_text(document(found)), HasSubstr("2 changes since the accepted night of 2026-01-01, in 2 nights, and back: 24 "
                                                          "readings of 6 cells are as then, to the last bit."));
    World rounded;
    rounded.last_digits = 1e-15;
    EXPECT_TRUE(explained({{}, other, rounded}).is_off_base()) << "but for rounding";
}

TEST(HistoryCauses, WhatWasNotPlayedOrNotMeasuredIsSaid) {
    PlantedNights planted(7);
    StudyResult tonight = planted.play(1, {});
    tonight.cells[0].failed = "the disk is full";
    const ReadingKey reach = key_of("reach_5lx_target_own_m").value();
    tonight.cells[1].readings[reach].value = Value::not_measured("beyond the grid");
    tonight.cells.pop_back();
    std::vector<Night> nights{night_of_study(planted.play(0, {}), "/a"), night_of_study(tonight, "/b")};
    const HistoryFindings found = explain_nights(nights);
    ASSERT_EQ(found.events.size(), 1U);
    EXPECT_EQ(found.events.front().moved.size(), 1U);
    EXPECT_TRUE(found.is_off_base());
    EXPECT_EQ(found.cells_compared, 4U);
    EXPECT_THAT(found.absent, ElementsAre("straight_halogen was not played: the disk is full", "country_xenon was not played tonight"));
    const std::string text = document_text(document(found));
    EXPECT_THAT(text, AllOf(HasSubstr("→ not measured"), HasSubstr("none is accepted"), Not(HasSubstr("nan"))));
}

TEST(HistoryDocument, NothingIsAcceptedWhereNoNightIs) {
    PlantedNights planted(7);
    std::vector<Night> nights;
    for (int i = 0; i < 2; ++i)
        nights.push_back(night_of_study(planted.play(i, {}), "/n"));
    const HistoryFindings found = explain_nights(nights);
    EXPECT_THAT(plot_svg(sparklines(found).front()), AllOf(HasSubstr("as in the first night"), Not(HasSubstr("as accepted"))));
    EXPECT_THAT(document_text(document(found)), HasSubstr("since the first night, 2026-01-01 (none is accepted), in 1 night"));
}

TEST(HistoryDocument, AStepHasAsManyDigitsAsTellItsEndsApart) {
    EXPECT_EQ(told_step("reach_5lx_target_own_m", 40.25, 41.1), "40.25 m → 41.1 m");
    EXPECT_EQ(told_step("area_5lx_road_own_m2", 167.4312, 167.4329), "167.431 m² → 167.433 m²");
    EXPECT_EQ(told_step("area_5lx_road_own_m2", 167.4, Value::at_least(167.4)), "167.4 m² → > 167.4 m²");
}

TEST(HistoryTrend, LevelsWithTheirNightsAndCauses) {
    PlantedNights planted(1);
    std::vector<Night> nights;
    for (int night = 0; night < nights_played; ++night)
        nights.push_back(night_of_study(planted.play(night, world_of(night)), "/n"));
    const std::string text = document_text(trend_document(nights, "reach_5lx_target_own_m", {"straight_xenon"}));
    EXPECT_THAT(text, HasSubstr("2026-01-01  2026-01-06"));
    EXPECT_THAT(text, HasSubstr("inputs: lamp xenon-low.ies"));
    EXPECT_THAT(text, HasSubstr("machine: driver Mesa 22.3.6 → Mesa 25.0.1"));
    EXPECT_THAT(document_text(trend_document(nights, "frame_s", {"straight_xenon"})),
                AllOf(HasSubstr("2026-01-11  2026-01-30"), HasSubstr("program: sources in renderer")));
    EXPECT_THAT(tests::refusal_of([&] { trend_document(nights, "reach_5lx_target_own", {"*"}); }),
                HasSubstr("such as reach_5lx_target_own_m"));
}

} // namespace
} // namespace fernlicht
