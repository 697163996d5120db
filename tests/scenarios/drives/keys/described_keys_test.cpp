// Schemas and examples of files say what the descriptions of their keys say. FERNLICHT_WRITE_SCHEMAS=1 writes the first
// (ci/write-reference), and the test fails once more.
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/fields/field.h"
#include "scenarios/fields/key_list.h"
#include "scenarios/fields/schema.h"
#include "scenarios/lamps/grid_recipe.h"
#include "scenarios/lamps/pixel_lamp_file.h"
#include "scenarios/ratings/rating.h"
#include "scenarios/studies/study.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

namespace fernlicht {
namespace {

const std::filesystem::path source = FERNLICHT_SOURCE_DIR;

std::string content(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The file's text as it is, or after it was written.
void expect_file(const std::filesystem::path& file, const std::string& text) {
    const std::string found = content(file);
    if (found != text && std::getenv("FERNLICHT_WRITE_SCHEMAS"))
        std::ofstream(file) << text;
    EXPECT_TRUE(found == text) << file << " is not what the descriptions say: ci/write-reference writes it";
}

/// `measure` is a drive's.
Group keys_of_study() {
    Group keys = study_fields();
    std::erase_if(keys.fields, [](const Field& field) { return field.key == "measure"; });
    return keys;
}

void expect_schema(const std::filesystem::path& file, const Group& group, const std::map<std::string_view, const Group*>& definitions) {
    auto schema = nlohmann::ordered_json::parse(content(file));
    schema.update(nlohmann::ordered_json::parse(schema_of(group)));
    schema.erase("definitions");
    for (const auto& [name, definition] : definitions)
        schema["definitions"][name] = nlohmann::ordered_json::parse(schema_of(*definition));
    expect_file(file, schema.dump(2) + "\n");
}

TEST(DescribedKeys, AreTheSchemas) {
    expect_schema(source / "scenarios/drive.schema.json", drive_fields(), definitions(drive_fields()));
    expect_schema(source / "scenarios/study.schema.json", study_fields(), {});
    expect_schema(source / "scenarios/recipe.schema.json", grid_recipe_fields(), definitions(grid_recipe_fields()));
    expect_schema(source / "scenarios/rating.schema.json", rating_fields(), {});
    expect_schema(source / "scenarios/pixel-lamp.schema.json", pixel_lamp_fields(), {});
}

void expect_in(const std::string& example, const Group& group) {
    for (const Field& field : group.fields) {
        if (field.kind != FieldKind::inlined) {
            const std::string unit = field.rule.units.empty() ? "" : "_[a-z_]+";
            EXPECT_TRUE(std::regex_search(example, std::regex("\\b" + field.key + unit + "\\b"))) << field.key << " is not in the example";
        }
        if (field.group && !field.group->is_bare)
            expect_in(example, *field.group);
    }
}

TEST(DescribedKeys, AreInTheExamples) {
    expect_in(content(source / "scenarios/drive.example.yaml"), drive_fields());
    expect_in(content(source / "scenarios/study.example.yaml"), keys_of_study());
    expect_in(content(source / "scenarios/recipe.example.yaml"), grid_recipe_fields());
    expect_in(content(source / "scenarios/rating.example.yaml"), rating_fields());
    expect_in(content(source / "scenarios/pixel-lamp.example.yaml"), pixel_lamp_fields());
}

void expect_ids_once(const std::string& path, const Group& group) {
    std::vector<int> ids;
    for (const Field& field : group.fields) {
        EXPECT_EQ(std::ranges::count(ids, field.id), 0) << path << "." << field.key << ": id " << field.id << " is another field's";
        if (!field.is_form)
            ids.push_back(field.id);
        if (field.group)
            expect_ids_once(path + "." + field.key, *field.group);
    }
}

TEST(DescribedKeys, HaveIdsOfTheirOwn) {
    expect_ids_once("drive", drive_fields());
    expect_ids_once("study", study_fields());
    expect_ids_once("recipe", grid_recipe_fields());
    expect_ids_once("rating", rating_fields());
    expect_ids_once("pixel lamp", pixel_lamp_fields());
}

} // namespace
} // namespace fernlicht
