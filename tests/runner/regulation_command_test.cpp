// `fernlicht lamp FILE --regulation` and `--cut-off` through the program.
#include "metrics/regulation/regulation.h"
#include "tests/runner/program.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace fernlicht {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

std::string lamp(const std::string& name) { return "lamp '" + library_file("lamps/" + name + ".ies") + "' "; }

TEST(RegulationCommand, PrintsRowsVerdictAndTheNarrowest) {
    const std::string said = printed(lamp("halogen-low") + "--regulation r112-b");
    EXPECT_THAT(said, AllOf(HasSubstr("per our table of UN R112"), HasSubstr("two published transcriptions"), HasSubstr("set to 0.57 D"),
                            ContainsRegex("\nnarrowest +75R \\+27\\."), HasSubstr("pass: meets all 18 rows of our table; no approval")));
    EXPECT_LT(said.find("\nB50L "), said.find("\nzone III ")); // in the regulation's order
    EXPECT_LT(said.find("\nzone III "), said.find("\n75R "));
}

TEST(RegulationCommand, IdsAreTakenInCapitalsAndTheirBeginningsAreCompleted) {
    EXPECT_EQ(run_program(lamp("halogen-low") + "--regulation R112-B").output,
              run_program(lamp("halogen-low") + "--regulation r112-b").output);
    EXPECT_THAT(printed(lamp("halogen-low") + "--regulation R112", 2),
                AllOf(HasSubstr("found 'R112', expected one of 'r112-a', 'r112-b'"), Not(HasSubstr("r98"))));
}

TEST(RegulationCommand, EachRowHasItsUnit) {
    const std::string text = run_program(lamp("halogen-low") + "--regulation r112-b").output;
    const auto row = [&](const std::string& id) {
        const std::size_t at = text.find("\n" + id);
        return text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    };
    EXPECT_THAT(row("cut-off sharpness G"), HasSubstr(" 0.13 to 0.4  1 "));
    EXPECT_THAT(row("cut-off linearity"), HasSubstr(" <= 0.2  deg "));
    EXPECT_THAT(row("B50L"), HasSubstr(" <= 350  cd "));
    EXPECT_THAT(text, AllOf(Not(HasSubstr("limit in cd")), Not(HasSubstr("\nmounted "))));
}

TEST(RegulationCommand, AMisaimedLampIsNamed) {
    // The beam as a matrix, its vertical angles raised by 0.3 degrees; the model's cut-off lies at 0.57 to 0.58 D.
    const TemporaryFolder folder;
    ASSERT_EQ(run_program(lamp("halogen-low") + "--convert " + (folder / "low.csv")).exit_code, 0);
    std::istringstream lines(content_of(folder / "low.csv"));
    std::ofstream raised(folder / "raised.csv");
    for (std::string line; std::getline(lines, line);) {
        const std::size_t comma = line.find(',');
        if (line.starts_with('#') || comma == 0 || comma == std::string::npos || line.find_first_not_of("-.0123456789") != comma)
            raised << line << '\n';
        else
            raised << std::stod(line.substr(0, comma)) + 0.3 << line.substr(comma) << '\n';
    }
    raised.close();
    EXPECT_THAT(printed("lamp " + (folder / "raised.csv") + " --regulation r112-b"),
                ContainsRegex("\nmounted +as the file has it, the cut-off lies 0.29 degrees too high\n"));
}

TEST(RegulationCommand, AFailedRowIsExitCode1AndNamed) {
    const std::string said = printed(lamp("halogen-low") + "--scale 0.7 --regulation r112-b --no-re-aim --json", 1);
    const json j = json::parse(said);
    EXPECT_EQ(j["verdict"], "fail");
    EXPECT_EQ(j["narrowest"][0], "75R");
    EXPECT_EQ(j["rows"].size(), 18u);
    EXPECT_FALSE(j["aim"][0]["cut_off"]["kink_h_deg"].is_null());
    // Turned up by what the edition allows, more light reaches 75R.
    EXPECT_THAT(printed(lamp("halogen-low") + "--scale 0.7 --regulation r112-b"), HasSubstr("within what the edition allows"));
}

TEST(RegulationCommand, TheAimTellsItsRuleItsBoundAndWhatItChanged) {
    const json j = json::parse(run_program(lamp("halogen-low") + "--regulation r112-a --aim-rule elbow --json").output);
    const json& aim = j["aim"][0];
    EXPECT_EQ(aim["rule"], "elbow");
    EXPECT_NEAR(aim["turned_deg"][0].get<double>(), 0.0, aim["bound_deg"][0].get<double>());
    EXPECT_LE(std::abs(aim["residual_deg"][1].get<double>()), 0.002);
    EXPECT_GE(aim["rounds"].get<int>(), 2);
    EXPECT_EQ(j["as_filed"]["verdict"], "fail");
    EXPECT_EQ(j["as_filed"]["rows_changed"][0]["id"], "zone I");
    const Outcome text = run_program(lamp("halogen-low") + "--regulation r112-a");
    EXPECT_THAT(text.output, AllOf(ContainsRegex("\nAs filed, where the aim changes the verdict\nrow .*\nzone I "),
                                   ContainsRegex("\nas filed +fail: the aim changes the verdict\n")));
}

TEST(RegulationCommand, LeftHandTrafficIsTheMirrorImage) {
    const Outcome right = run_program(lamp("xenon-low") + "--regulation r98-d --json");
    const Outcome left = run_program(lamp("xenon-low") + "--mirror --regulation r98-d --left-hand-traffic --json");
    const json r = json::parse(right.output)["rows"], l = json::parse(left.output)["rows"];
    ASSERT_EQ(r.size(), l.size());
    for (std::size_t i = 0; i < r.size(); ++i) {
        EXPECT_EQ(r[i]["found"], l[i]["found"]) << r[i];
        EXPECT_EQ(r[i]["margin"], l[i]["margin"]);
        EXPECT_EQ(r[i]["h_deg"].get<double>(), 0.0 - l[i]["h_deg"].get<double>());
    }
    EXPECT_THAT(left.output, AllOf(HasSubstr("\"B50R\""), HasSubstr("\"75L\""), Not(HasSubstr("\"75R\""))));
    EXPECT_EQ(run_program(lamp("xenon-low") + "--regulation r98-d --left-hand-traffic --aim-rule as-is").exit_code, 1);
}

TEST(RegulationCommand, TwoFilesAreHalfTheirSumWhereTheTableSaysSo) {
    const auto rows = [](const std::string& arguments) { return json::parse(run_program(arguments).output)["rows"]; };
    const std::string table = "--regulation r123-c --aim-rule as-is --json";
    const json one = rows(lamp("halogen-low") + table);
    const std::string halogen = "'" + library_file("lamps/halogen-low.ies") + "' ";
    const json same = rows("lamp --other-side " + halogen + halogen + table);
    const json both = rows(lamp("halogen-low") + "--other-side '" + library_file("lamps/xenon-low.ies") + "' " + table);
    const json other = rows(lamp("xenon-low") + table);
    const auto found = [](const json& all, const std::string& id) {
        for (const json& row : all)
            if (row["id"] == id)
                return row["found"].get<double>();
        return -1.0;
    };
    for (const char* id : {"B50L", "75R", "50V", "25LL", "S50LL + S50 + S50RR"}) {
        EXPECT_NEAR(found(same, id), found(one, id), 1e-9 * found(one, id)) << id;
        EXPECT_NEAR(found(both, id), (found(one, id) + found(other, id)) / 2.0, 1e-9 * found(one, id)) << id;
    }
    EXPECT_EQ(found(one, "HV, each side"), -1.0);
    EXPECT_NEAR(found(both, "HV, each side"), std::min(found(one, "HV"), found(other, "HV")), 1e-6);
    EXPECT_THAT(run_program(lamp("halogen-low") + "--regulation r123-c").output, HasSubstr("half the sum of both sides; one file given"));
}

TEST(RegulationCommand, ADrivingBeamKeepsThePassingBeamsAim) {
    const std::string aim_by = "--aim-by '" + library_file("lamps/halogen-low.ies") + "' ";
    const json j = json::parse(run_program(lamp("halogen-high") + "--regulation r112-driving-b --json " + aim_by).output);
    EXPECT_THAT(j["aim"][0]["how"].get<std::string>(), HasSubstr("by the passing beam: cut-off found"));
    EXPECT_NEAR(j["aim"][0]["turned_deg"][1].get<double>(), 0.011, 0.005);
    EXPECT_THAT(j["notes"][0].get<std::string>(),
                HasSubstr("aimed as asked for, not in the regulation's own way: aimed by its own maximum"));
    const std::string check = lamp("halogen-high") + "--regulation r112-driving-b --aim-rule ";
    EXPECT_THAT(run_program(check + "as-is").output, ContainsRegex("\nnote +aimed as asked for, not in the regulation's own way: "));
    for (const char* own : {"auto", "maximum"})
        EXPECT_THAT(run_program(check + own).output, ContainsRegex("\nnote +aimed by its own maximum")) << own;
}

TEST(RegulationCommand, ListNamesEveryTableAndItsRows) {
    const std::string text = printed("lamp --regulation list");
    const json list = json::parse(run_program("lamp --regulation list --json").output);
    ASSERT_EQ(list.size(), regulation_ids().size() + 1) << "and fmvss108-adb, whose rows follow from what is dimmed";
    EXPECT_EQ(list.back()["id"], "fmvss108-adb");
    EXPECT_THAT(text, ContainsRegex("\n  fmvss108-adb +Adaptive driving beam .*: rows by where the beam is dimmed"));
    for (const std::string& id : regulation_ids())
        EXPECT_THAT(text, HasSubstr("  " + id + " "));
    EXPECT_GT(list[0]["rows"].size(), 20u);
    EXPECT_THAT(text, AllOf(HasSubstr("class B (HC): 16 rows in the text"), HasSubstr("more rows where it is aimed by its cut-off")));
}

TEST(RegulationCommand, CutOffTellsItsFigures) {
    EXPECT_THAT(printed(lamp("xenon-low") + "--cut-off"),
                AllOf(HasSubstr("detector 30 mm at 25 m"), ContainsRegex("\nkink +H -0.0"), ContainsRegex("\nrise +14.")));
    const json j = json::parse(run_program(lamp("xenon-low") + "--cut-off --json --detector 0 --sharpness at-inflection").output);
    EXPECT_LT(j["level"][1]["sharpness_g"].get<double>(), 0.345);
    EXPECT_NEAR(j["level"][1]["inflection_v_deg"].get<double>(), -0.57, 0.02);
    EXPECT_NEAR(j["elbow"]["h_deg"].get<double>(), 0.0, 0.1);
    const TemporaryFolder folder;
    EXPECT_EQ(run_program(lamp("xenon-low") + "--cut-off --picture " + (folder / "edge.svg")).exit_code, 0);
    EXPECT_THAT(content_of(folder / "edge.svg"), AllOf(HasSubstr("fit: level, rise, shoulder"), HasSubstr("their inflections")));
    const Outcome high = run_program(lamp("halogen-high") + "--cut-off");
    EXPECT_THAT(high.output, HasSubstr("not measured"));
}

TEST(RegulationCommand, RefusesWhatItCannotDoInOneSentence) {
    const auto refused = [](const std::string& arguments, const std::string& words) {
        const Outcome o = run_program(arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments;
        EXPECT_THAT(o.output, HasSubstr(words));
        EXPECT_EQ(std::count(o.output.begin(), o.output.end(), '\n'), 1) << o.output;
    };
    refused(lamp("halogen-low") + "--regulation r112-x", "found 'r112-x', expected 'r112-");
    refused(lamp("halogen-low") + "--regulation r112-b --aim-rule sideways", "--aim-rule: found 'sideways'");
    refused(lamp("halogen-low") + "--regulation fmvss108-lb2m --left-hand-traffic", "--left-hand-traffic");
    refused(lamp("halogen-low") + "--regulation r112-b --convert x.ies", "--convert together with --regulation");
    refused(lamp("halogen-low") + "--regulation r112-b --picture x.svg", "--picture: found together with --regulation");
    refused(lamp("halogen-low") + "--cut-off --detector -1", "--detector: found -1");
    refused(lamp("halogen-low") + "--cut-off --sharpness most", "--sharpness: found 'most'");
    refused("lamp --regulation r112-b", "found no lamp");
    const std::string other = "--other-side '" + library_file("lamps/halogen-low.ies") + "' ";
    refused(lamp("halogen-low") + "--regulation r123-c " + other + other, "--other-side: given twice, expected it once");
    refused(lamp("halogen-low") + "--aim-rule as-is", "--regulation");
}

} // namespace
} // namespace fernlicht
