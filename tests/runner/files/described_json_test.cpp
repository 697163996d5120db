// Files in JSON come back as they were written, and their schemas are what the descriptions of their members say.
// FERNLICHT_WRITE_SCHEMAS=1 writes the schemas (ci/write-reference), and the test fails once more.
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/experiments/compare/lamps/lamp_comparison.h"
#include "runner/experiments/compare/runs/run_comparison.h"
#include "runner/experiments/fit/fit_result.h"
#include "runner/experiments/importance/importance_result.h"
#include "runner/experiments/improve/improve_result.h"
#include "runner/experiments/masks/masks_result.h"
#include "runner/experiments/rating/rating_result.h"
#include "runner/experiments/reference/reference_result.h"
#include "runner/experiments/run/run_report.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/experiments/study/study_document.h"
#include "scenarios/values/errors.h"
#include "tests/runner/program.h"
#include "tests/runner/schema_check.h"
#include "tests/trial.h"

#include <cstdlib>
#include <gmock/gmock.h>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

enum class Colour { red, green };
struct Part {
    std::string name;
    std::optional<double> length_m;
    std::string why_not;
    Value value;
};
struct Whole {
    int count = 3, tick = -1;
    std::uint64_t seed = 0;
    bool flag = false;
    double share = 0.5;
    Colour colour = Colour::red;
    std::string note;
    JsonTexts texts;
    std::array<double, 2> ends{};
    std::vector<Part> parts;
    std::optional<Part> best;
};

JsonMembers part_of_whole(Part& part) {
    return {{"name", part.name},
            {"length_m", or_why(json_part(part.length_m,
                                          [](double& metres) -> JsonMembers {
                                              return {{"m", metres}};
                                          }),
                                part.why_not, &part.why_not)},
            {"value", part.value}};
}

JsonMembers whole_members(Whole& whole) {
    return joined({{"count", whole.count},
                   {"tick", or_null(whole.tick, -1)},
                   {"seed", whole.seed},
                   {"flag", whole.flag},
                   {"share", whole.share},
                   {"colour", one_of(whole.colour,
                                     [] {
                                         return std::vector<std::string>{"red", "green"};
                                     })},
                   {"note", or_null(whole.note)},
                   {"texts", whole.texts}},
                  when(!whole.parts.empty(), {{"parts", whole.parts, part_of_whole}}),
                  JsonMembers{{"ends", {{"from", whole.ends[0]}, {"to", whole.ends[1]}}},
                              {"best", whole.best, part_of_whole},
                              {"sum", whole.share + whole.count}});
}

TEST(DescribedJson, ComesBack) {
    const Part part{"a", 1.5, "", Value::at_least(200.0)};
    const Whole filled{
        7, 30, 1ULL << 63, true, 0.1, Colour::green, "a note", {{"key", "text"}}, {1.0, 2.0}, {part, {"b", {}, "too dark", {}}}, part};
    for (const Whole& whole : {Whole{}, filled})
        tests::checked(json_text(as_json(whole, whole_members)), whole_members);
    EXPECT_EQ(
        as_json(filled.parts, part_of_whole).dump(),
        R"([{"name":"a","length_m":{"m":1.5},"value":{"at_least":200.0}},{"name":"b","length_m":{"not_measured":"too dark"},"value":null}])");
    EXPECT_EQ(
        as_json(Whole{}, whole_members).dump(),
        R"({"count":3,"tick":null,"seed":0,"flag":false,"share":0.5,"colour":"red","note":null,"texts":{},"ends":{"from":0.0,"to":0.0},"best":null,"sum":3.5})");
}

/// One item at a time, and as if all were there at once: none, a few on one line, and many on lines of their own.
TEST(DescribedJson, IsWrittenItemByItem) {
    const std::filesystem::path file = tests::new_folder() / "whole.json";
    for (const std::size_t parts : {0U, 1U, 2U, 3U, 4U, 100U}) {
        Whole whole{.texts = {{"key", "text"}}, .parts = std::vector<Part>(parts, {"a", 1.5, "", 2.0})};
        write_json(file, whole, whole_members);
        EXPECT_EQ(content_of(file), json_text(as_json(whole, whole_members))) << parts;
    }
}

TEST(DescribedJson, SaysWhatIsRefusedWhere) {
    const auto refused = [](const std::string& from, const std::string& to, const std::string& place) {
        std::string text = json_text(as_json(Whole{.best = Part{"a", 1.5, "", 2.0}}, whole_members));
        text.replace(text.find(from), from.size(), to);
        EXPECT_THAT([&] { from_json<Whole>(CheckedJson::parse(text, {}), whole_members); },
                    testing::ThrowsMessage<InputError>(testing::HasSubstr(place)));
    };
    refused("\"red\"", "\"blue\"", "colour");
    refused("1.5", "true", "best.length_m.m");
    refused("\"flag\"", "\"flags\"", "flag");
}

/// Lists in lists, 200 000 deep: what shows the refused value would run out of stack.
TEST(DescribedJson, IsNotNestedWithoutEnd) {
    for (const std::size_t levels : {66U, 200'000U})
        EXPECT_THAT([&] { CheckedJson::parse(std::string(levels, '[') + std::string(levels, ']'), "deep.json").text(); },
                    testing::ThrowsMessage<InputError>(testing::HasSubstr("deep.json: is JSON nested deeper than 64 levels")));
    EXPECT_THAT([&] { CheckedJson::parse(std::string(64, '[') + std::string(64, ']'), "deep.json").text(); },
                testing::ThrowsMessage<InputError>(testing::HasSubstr("expected a text")));
}

LayerComparison judged_layer() {
    const StrictnessResult kept{"mean FLIP", true, 0.0, 0.5, "", 6, 2, 1, 1.0, {}},
        broken{"no pixel differs", false, 1.5, 0.0, "lx", 6, 2, 1};
    LayerComparison layer{"illuminance.lx", "lx"};
    layer.values = {{"rmse", "lx", 0.5}, {"max_error", "lx", 1.5, {}, 2, 1}, {"psnr_db", "dB", {}, "the reference has no light"}};
    layer.strictness = StrictnessResult{.statement = "all of", .children = {kept, broken}};
    layer.histogram = {5, std::vector<std::size_t>(ErrorHistogram::bins, 0)};
    layer.histogram.counts[18] = 1;
    return layer;
}

LampDifference undecided_difference() {
    LampDifference difference{1000, 0.01, 4.0, 12.5, FittedFigure{0.1, 0.02}, FittedFigure{-0.2, 0.03}, {}, FittedFigure{0.05, 0.001}};
    difference.zones = {{-0.05, 0.01, -10.0, -5.0, 0.0, 1.0, 9.5, 40}};
    difference.zones.push_back(difference.zones.front());
    difference.zones.front().holds = {"75R", "50V"};
    difference.zones.back().part_of = "zone I";
    difference.zones.back().extent = ZoneExtent::below_cut_off;
    difference.places = {
        {{"75R", "the kerb side", {{1.15, -0.57}}, "a table"}, 100.0, 105.0, 0.01, true},
        {{"foreground", "the near road", {{-1.0, -5.0}, {1.0, -5.0}, {0.0, -4.0}}, "ours"}, {}, {}, {}, false, "outside a table"}};
    difference.side = TrafficSide::left;
    difference.undecided = "aim or level: both explain it";
    return difference;
}

TEST(DescribedJson, ComparedPicturesComeBack) {
    PicturesFound found;
    found.pair.reference = "a.exr", found.pair.tested = "b.exr", found.pair.width = 3, found.pair.height = 2;
    found.pair.notes = {"B does not tell how it was shown"};
    found.comparison = {67.0, "", {judged_layer(), {"distance.m", "m"}}};
    found.pictures = {"side-by-side.png"};
    EXPECT_EQ(tests::checked(json_text(as_json(found, pictures_members)), pictures_members).at("passed"), nullptr);
    found.comparison.strictness_name = "same-light";
    const nlohmann::json told = tests::checked(json_text(as_json(found, pictures_members)), pictures_members);
    EXPECT_EQ(told.at("passed"), false);
    EXPECT_EQ(told.at("layers").at(0).at("strictness").at("children").at(1).at("found"), 1.5);
}

TEST(DescribedJson, ComparedLampsComeBack) {
    LampPairComparison lamps;
    lamps.before.path = "old.ies", lamps.now.path = "new.ies", lamps.now.file.name = "new";
    lamps.before.cut_off_told = lamps.now.cut_off_told = R"({"elbow":{"not_measured":"no edge"},"lamp":"a"})";
    lamps.difference = undecided_difference();
    lamps.facts = {{"peak_cd", "cd", "", 100.0, 150.0, 0.5}, {"kink_h_deg", "deg", "", 1.0, {}, {}, "no kink"}};
    EXPECT_EQ(tests::checked(json_text(as_json(lamps, lamps_members)), lamps_members).at("regulation"), nullptr);
    lamps.regulation = &regulation("r112-b");
    lamps.before.check_told = lamps.now.check_told = R"({"verdict":"fail"})";
    lamps.now.check.emplace().verdict = RowVerdict::fail;
    RowResult fails{.id = "50V", .verdict = RowVerdict::fail, .found = 4000.0, .margin = -0.25};
    lamps.rows = {{"50V", "cd", fails, RowResult{.id = "50V"}}, {"HV", "cd", {}, fails}};
    lamps.figures = {{"ratio", "B over A", {}}};
    const nlohmann::json told = tests::checked(json_text(as_json(lamps, lamps_members)), lamps_members);
    EXPECT_EQ(told.at("passed"), false);
    EXPECT_THAT(told.at("difference").at("says").dump(), testing::HasSubstr("aim or level: both explain it"));
    EXPECT_EQ(told.at("regulation").at("rows").at(1).at("old_verdict"), "");
}

TEST(DescribedJson, ComparedRunsComeBack) {
    RunComparison runs;
    runs.before = {"out/a", "fernlicht run", "2026-01-01T00:00:00Z", "1", "egl", "llvmpipe", "x", {}};
    runs.strictness_name = "identical", runs.largest = {{0, 1}};
    DriveComparison& drive = runs.drives.emplace_back();
    drive.now.drive = "straight", drive.before.technique = "full";
    drive.settings = {{"lamps.left.file", "a.ies", ""}};
    drive.lamp_files = {{"left, right", "a.ies", "b.ies", undecided_difference()}};
    const ReadingKey reach = *key_of("reach_1lx_road_own_m");
    drive.changes = {{{reach, Value::at_least(200.0), 50.0, 0.5, 0.25, 0.2, 0.15, {}, 0.125, ChangeKind::real}, true},
                     {{reach, 50.0, 40.0, {}, {}, {}, {}, {}, {}, ChangeKind::unknown, "nothing tells"}, false}};
    drive.times = {{{reach, 3.0, 2.0, 1.5, {}, {}, {}, {}, {}, ChangeKind::none}, 20, 30}};
    drive.frames = {{{0, 0.0, "map", "", "a.exr"}, {0, 0.0, "map", "", "b.exr"}},
                    {{6, 0.2, "driver", "a.png"}, {6, 0.2, "driver", "b.png"}, true}};
    drive.frames[1].comparison = {67.0, "", {judged_layer()}};
    drive.frames[1].pictures = {"frames/straight/driver-000006/flip.png"};
    drive.figures = {{"lux-lines_straight.1", "Isolux lines", {}}};
    const nlohmann::json told = tests::checked(json_text(as_json(runs, runs_members)), runs_members).at("drives").at(0);
    EXPECT_EQ(told.at("changes").at(0).at("change").at("at_least"), 150.0);
    EXPECT_EQ(told.at("figures").at(0).at("png"), "figures/lux-lines_straight.1.png");
}

/// What stands there in words alone, beside what the descriptions say.
void keep_words(Json& schema, const Json& old) {
    if (old.contains("description"))
        schema["description"] = old["description"];
    for (auto& [key, value] : schema.items())
        if (value.is_object() && old.contains(key) && old[key].is_object())
            keep_words(value, old[key]);
}

void expect_schema(const std::string& file, const std::string& described) {
    const std::filesystem::path path = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "runner/experiments" / file;
    std::ostringstream found;
    found << std::ifstream(path).rdbuf();
    const Json old = Json::parse(found.str());
    Json schema{{"$schema", old.at("$schema")}, {"title", old.at("title")}, {"description", old.at("description")}};
    schema.update(Json::parse(described));
    keep_words(schema, old);
    if (found.str() != json_text(schema) && std::getenv("FERNLICHT_WRITE_SCHEMAS"))
        std::ofstream(path) << json_text(schema);
    EXPECT_TRUE(found.str() == json_text(schema)) << path << " is not what the descriptions say: ci/write-reference writes it";
}

TEST(DescribedJson, IsTheSchema) {
    expect_schema("accuracy/accuracy.schema.json", json_schema(accuracy_members));
    expect_schema("shadows/shadows.schema.json", json_schema(shadow_members));
    expect_schema("aliasing/aliasing.schema.json", json_schema(aliasing_members));
    expect_schema("fit/fit.schema.json", json_schema(fit_members));
    expect_schema("importance/importance.schema.json", json_schema(importance_members));
    expect_schema("rating/rating.schema.json", json_schema(rating_members));
    expect_schema("masks/masks.schema.json", json_schema(masks_members));
    expect_schema("improve/improve.schema.json", json_schema(improve_members));
    expect_schema("run/report.schema.json", report_json_schema());
    expect_schema("compare/pictures.schema.json", json_schema(pictures_members));
    expect_schema("compare/lamps/lamps.schema.json", json_schema(lamps_members));
    expect_schema("compare/runs/runs.schema.json", json_schema(runs_members));
    expect_schema("reference/reference.schema.json", reference_json_schema());
    expect_schema("study/study.schema.json", json_schema(study_members));
}

} // namespace
} // namespace fernlicht
