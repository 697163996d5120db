// Schema, reference and example of drive files say what the descriptions of their keys say. FERNLICHT_WRITE_KEYS=1 writes the first two
// (ci/write-keys), and the test fails once more.
#include "scenarios/drives/keys/control_fields.h"
#include "scenarios/drives/keys/drive_keys.h"
#include "scenarios/drives/keys/vehicle_keys.h"
#include "scenarios/fields/key_table.h"
#include "scenarios/fields/schema.h"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
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
    if (found != text && std::getenv("FERNLICHT_WRITE_KEYS"))
        std::ofstream(file) << text;
    EXPECT_TRUE(found == text) << file << " is not what the descriptions say: ci/write-keys writes it";
}

void drop_unused_definitions(nlohmann::ordered_json& schema) {
    const nlohmann::ordered_json definitions = schema["definitions"];
    for (const auto& [name, definition] : definitions.items())
        if (schema.dump().find("\"#/definitions/" + name + "\"") == std::string::npos)
            schema["definitions"].erase(name);
}

/// Described keys beside those of the same map that are not described yet.
void put_properties(nlohmann::ordered_json& into, const Group& group) {
    nlohmann::ordered_json& map = into.contains("anyOf") ? into["anyOf"][1] : into.contains("items") ? into["items"] : into;
    map["properties"].update(nlohmann::ordered_json::parse(schema_of(group))["properties"]);
}

TEST(DescribedKeys, AreTheSchema) {
    const std::filesystem::path file = source / "scenarios/drive.schema.json";
    auto schema = nlohmann::ordered_json::parse(content(file));
    for (const Field& field : drive_fields().fields)
        if (field.schema != schema_by_hand)
            schema["properties"][field.key] = nlohmann::ordered_json::parse(schema_of(field));
    schema["definitions"]["actuators"] = nlohmann::ordered_json::parse(schema_of(actuators_fields()));
    nlohmann::ordered_json& control = schema["definitions"]["control"];
    for_each_law([&](const std::string& path, const Group& group) {
        put_properties(path.empty() ? control : control["anyOf"][1]["properties"][path.substr(0, path.find('['))], group);
    });
    drop_unused_definitions(schema);
    expect_file(file, schema.dump(2) + "\n");
}

TEST(DescribedKeys, AreTheReference) {
    Drive usual;
    usual.extent.emplace();
    std::string text = "# Keys of a drive file\n\nWritten by `ci/write-keys` from the descriptions of the keys. "
                       "[drives.md](drives.md) explains drives, `scenarios/drive.example.yaml` shows one.\n\n";
    text += key_tables("", drive_fields(), &usual);
    text += key_tables("actuators", actuators_fields(), actuators_fields().usual.get());
    text += key_tables("control", law_fields(), law_fields().usual.get());
    text += key_tables("control.modes", threshold_fields(), threshold_fields().usual.get());
    text.pop_back();
    expect_file(source / "docs/keys.md", text);
}

void expect_in(const std::string& example, const Group& group) {
    for (const Field& field : group.fields) {
        if (field.kind != FieldKind::inlined && !(field.group && field.group->is_bare)) {
            const std::string unit = field.rule.units.empty() ? "" : "_[a-z_]+";
            EXPECT_TRUE(std::regex_search(example, std::regex("\\b" + field.key + unit + "\\b"))) << field.key << " is not in the example";
        }
        if (field.group)
            expect_in(example, *field.group);
    }
}

TEST(DescribedKeys, AreInTheExample) {
    const std::string example = content(source / "scenarios/drive.example.yaml");
    expect_in(example, drive_fields());
    expect_in(example, actuators_fields());
    for_each_law([&](const std::string&, const Group& group) { expect_in(example, group); });
}

void expect_ids_once(const std::string& path, const Group& group) {
    std::vector<int> ids;
    for (const Field& field : group.fields) {
        EXPECT_EQ(std::ranges::count(ids, field.id), 0) << path << "." << field.key << ": id " << field.id << " is another field's";
        ids.push_back(field.id);
        if (field.group)
            expect_ids_once(path + "." + field.key, *field.group);
    }
}

TEST(DescribedKeys, HaveIdsOfTheirOwn) {
    expect_ids_once("drive", drive_fields());
    expect_ids_once("actuators", actuators_fields());
    for_each_law([](const std::string& path, const Group& group) { expect_ids_once("control." + path, group); });
}

} // namespace
} // namespace fernlicht
