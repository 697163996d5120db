// study.schema.json says the same as the reader of studies: editors that use it must neither refuse good studies nor pass misspelt keys.
#include "scenarios/studies/study.h"
#include "scenarios/values/errors.h"
#include "tests/scenarios/drives/yaml_schema_check.h"

#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <set>
#include <unistd.h>

namespace fernlicht {
namespace {

const std::filesystem::path scenarios = std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios";

std::string content(const std::filesystem::path& file) {
    FilesRead opened;
    return read_file(file, opened);
}

class StudySchema : public testing::Test {
  protected:
    /// Beside the example, so that its relative paths hold.
    std::filesystem::path file_ = scenarios / fmt::format("study-schema-test-{}.yaml", ::getpid());
    SchemaCheck check_{json::parse(std::ifstream(scenarios / "study.schema.json"))};
    void TearDown() override { std::filesystem::remove(file_); }

    std::string violation(const std::string& yaml) { return check_.violation(to_json(parse_yaml(yaml, "test.yaml"))); }
    std::string refusal(const std::string& yaml) {
        std::ofstream(file_) << yaml;
        try {
            read_study(file_);
        } catch (const InputError& error) {
            return error.what();
        }
        return "not refused";
    }
};

TEST_F(StudySchema, PassesTheExampleAndEveryShippedStudy) {
    const std::string example = content(scenarios / "study.example.yaml");
    EXPECT_EQ(violation(example), "");
    EXPECT_EQ(refusal(example), "not refused");
    int studies = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scenarios / "library/studies")) {
        if (entry.path().extension() != ".yaml")
            continue;
        EXPECT_EQ(violation(content(entry.path())), "") << entry.path();
        ++studies;
    }
    EXPECT_GE(studies, 2);
}

TEST_F(StudySchema, EveryKeyOfTheExampleMisspeltIsRefusedByBoth) {
    const std::string example = content(scenarios / "study.example.yaml");
    const std::regex key(R"(\b([a-z_]{3,})(: ?))");
    std::size_t tried = 0;
    bool in_measure = false; // whose parts are a drive's, and tested there
    for (std::sregex_iterator match(example.begin(), example.end(), key), end; match != end; ++match) {
        const auto at = static_cast<std::size_t>(match->position(1));
        const std::size_t line = example.rfind('\n', at) + 1;
        if (example.substr(line, at - line).find('#') != std::string::npos)
            continue; // a comment
        const std::string name = match->str(1);
        in_measure = at == line ? name == "measure" : in_measure;
        if ((in_measure && at > line + 2) || name == "production" || (name == "new" && example.substr(at - 2, 2) == "  "))
            continue; // names are the user's
        std::string misspelt = example;
        misspelt.insert(at + 2, "q");
        EXPECT_NE(violation(misspelt), "") << name;
        EXPECT_THAT(refusal(misspelt), testing::HasSubstr("unknown key")) << name;
        ++tried;
    }
    EXPECT_GT(tried, 25U);
}

/// What stands in quotes in the reader's lists of known keys stands in the schema and in the example.
TEST_F(StudySchema, KnowsEveryKeyOfTheReader) {
    const std::string reader = content(scenarios / "studies/study_file.cpp"), schema = content(scenarios / "study.schema.json"),
                      example = content(scenarios / "study.example.yaml");
    const std::regex list(R"((?:\.map\(|keys\(whole, )\{([^}]*)\})"), quoted("\"([a-z_]+)\"");
    std::set<std::string> known;
    for (std::sregex_iterator part(reader.begin(), reader.end(), list), end; part != end; ++part) {
        const std::string keys = part->str(1);
        for (std::sregex_iterator key(keys.begin(), keys.end(), quoted); key != end; ++key)
            known.insert(key->str(1));
    }
    EXPECT_GT(known.size(), 30U);
    for (const std::string& key : known) {
        EXPECT_THAT(schema, testing::HasSubstr("\"" + key + "\": ")) << "not in the schema";
        EXPECT_THAT(example, testing::HasSubstr(key)) << "not in the example";
    }
}

TEST_F(StudySchema, AgreesWithTheReader) {
    const std::string low = (scenarios / "library/lamps/halogen-low.ies").string(),
                      study = fmt::format("fernlicht_study: 1\ndrives: [{}]\n", (scenarios / "library/drives/straight.yaml").string()),
                      lamps = study + fmt::format("lamps: {{a: {{low: {}}}, b: {{low: {}}}}}\n", low, low);
    ASSERT_EQ(refusal(lamps), "not refused");
    for (const char* ending : {"title: 5",
                               "name: a/b",
                               "techniques: []",
                               "techniques: [photometric]",
                               "conditions: {time_of_day: dusk}",
                               "conditions: {time_of_day: [day, night]}",
                               "conditions: {aim_percent: [11]}",
                               "conditions: {aim_percent: []}",
                               "conditions: {voltage_v: 11}",
                               "conditions: {voltage_v: [12, 13]}",
                               "conditions: {mirror: true}",
                               "conditions: {mirror: [false, true]}",
                               "conditions: {mirror: []}",
                               "conditions: {mirror: left}",
                               "compare: []",
                               "compare: [{new: a}]",
                               "compare: [{new: b, against: a}]",
                               "readings: []",
                               "limits: [{at_least: 1}]",
                               "limits: [{reading: x_m, at_least: 1}]",
                               "pictured_moments: 0",
                               "pictured_moments: 13",
                               "resolution_px: [64]",
                               "resolution_px: [64, 48]",
                               "lamp_noise_percent: -1",
                               "lamp_noise_percent: 1",
                               "measure: {visibility: true}",
                               "measure: {visibilty: true}",
                               "nonsense: 1"}) {
        const std::string yaml = lamps + ending + "\n", by_reader = refusal(yaml), by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << ending << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
    for (const char* lamp : {"source: xenon", "source: arc", "temperature_k: 30", "temperature_k: 3000", "file_aim_percent: 11",
                             "file_aim_percent: -1.5", "mirrors: false", "mirrors: maybe", "left: low.ies", "beam: low.ies"}) {
        const std::string yaml = study + fmt::format("lamps: {{a: {{low: {}, {}}}}}\n", low, lamp), by_reader = refusal(yaml),
                          by_schema = violation(yaml);
        EXPECT_EQ(by_reader == "not refused", by_schema.empty()) << lamp << "\n reader: " << by_reader << "\n schema: " << by_schema;
    }
}

} // namespace
} // namespace fernlicht
