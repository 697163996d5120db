// Files in JSON come back as they were written, and their schemas are what the descriptions of their members say.
// FERNLICHT_WRITE_KEYS=1 writes the schemas (ci/write-keys), and the test fails once more.
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/experiments/aliasing/aliasing_result.h"
#include "runner/experiments/run/run_report.h"
#include "runner/experiments/shadows/shadow_result.h"
#include "runner/experiments/study/study_document.h"
#include "runner/files/described_json.h"
#include "scenarios/values/errors.h"
#include "tests/runner/schema_check.h"

#include <cstdlib>
#include <fstream>
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

void write_described(const std::string& text) { std::ofstream("described.json") << text; }
Whole read_described() { return from_json<Whole>(CheckedJson::read("described.json"), whole_members); }

TEST(DescribedJson, ComesBack) {
    const Part part{"a", 1.5, "", Value::at_least(200.0)};
    const Whole filled{
        7, 30, 1ULL << 63, true, 0.1, Colour::green, "a note", {{"key", "text"}}, {1.0, 2.0}, {part, {"b", {}, "too dark", {}}}, part};
    for (const Whole& whole : {Whole{}, filled}) {
        const std::string text = json_text(as_json(whole, whole_members));
        write_described(text);
        EXPECT_EQ(json_text(as_json(read_described(), whole_members)), text);
        EXPECT_THAT(tests::Schema(nlohmann::json::parse(json_schema(whole_members))).check(nlohmann::json::parse(text)),
                    testing::IsEmpty());
    }
    EXPECT_EQ(
        as_json(filled.parts, part_of_whole).dump(),
        R"([{"name":"a","length_m":{"m":1.5},"value":{"at_least":200.0}},{"name":"b","length_m":{"not_measured":"too dark"},"value":null}])");
    EXPECT_EQ(
        as_json(Whole{}, whole_members).dump(),
        R"({"count":3,"tick":null,"seed":0,"flag":false,"share":0.5,"colour":"red","note":null,"texts":{},"ends":{"from":0.0,"to":0.0},"best":null,"sum":3.5})");
}

TEST(DescribedJson, SaysWhatIsRefusedWhere) {
    const auto refused = [](const std::string& from, const std::string& to, const std::string& place) {
        std::string text = json_text(as_json(Whole{.best = Part{"a", 1.5, "", 2.0}}, whole_members));
        write_described(text.replace(text.find(from), from.size(), to));
        EXPECT_THAT(read_described, testing::ThrowsMessage<InputError>(testing::HasSubstr(place)));
    };
    refused("\"red\"", "\"blue\"", "colour");
    refused("1.5", "true", "best.length_m.m");
    refused("\"flag\"", "\"flags\"", "flag");
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
    if (found.str() != json_text(schema) && std::getenv("FERNLICHT_WRITE_KEYS"))
        std::ofstream(path) << json_text(schema);
    EXPECT_TRUE(found.str() == json_text(schema)) << path << " is not what the descriptions say: ci/write-keys writes it";
}

TEST(DescribedJson, IsTheSchema) {
    expect_schema("accuracy/accuracy.schema.json", accuracy_json_schema());
    expect_schema("shadows/shadows.schema.json", shadow_json_schema());
    expect_schema("aliasing/aliasing.schema.json", aliasing_json_schema());
    expect_schema("run/report.schema.json", report_json_schema());
    expect_schema("study/study.schema.json", json_schema(study_members));
}

} // namespace
} // namespace fernlicht
