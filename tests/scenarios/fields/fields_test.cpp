// A struct that is described once is read, refused, written, checked by editors and documented from that.
#include "scenarios/fields/field.h"
#include "scenarios/fields/key_list.h"
#include "scenarios/fields/read_fields.h"
#include "scenarios/fields/schema.h"
#include "scenarios/fields/write_fields.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace fernlicht {
namespace {

using testing::HasSubstr;

enum class Shape { round, square };

struct Cup {
    std::string name;
    double height_m = 0.1;
    int handles = 1;
    bool operator==(const Cup&) const = default;
};

struct Table {
    Shape shape = Shape::square;
    double tilt_rad = 0.0, push_mps = 1.0, corner_m = 0.02;
    std::optional<double> drop_m;
    std::vector<double> legs_m{0.7, 0.7};
    glm::dvec3 place_m{0.0};
    bool folds = false;
    std::optional<Cup> own_cup;
    std::vector<Cup> cups;
    bool operator==(const Table&) const = default;
};

const Fields<Cup>& cup_fields() {
    static const Fields<Cup> fields{
        field("height_m", 1, &Cup::height_m, range(0.01, 1.0), "without its saucer"),
        field("handles", 2, &Cup::handles, range(0.0, 4.0), "to hold it by"),
    };
    return fields;
}

bool is_square(const void* table) { return static_cast<const Table*>(table)->shape == Shape::square; }

void check_table(const YamlMap& keys, const Table& table) {
    if (table.legs_m.size() == 2 && table.folds)
        keys.entry().refuse("two legs that fold", "a third");
}

const Fields<Table>& table_fields() {
    static const Fields<Table> fields =
        Fields<Table>{
            field("shape", 1, &Table::shape, words({"round", "square"}), "of the top"),
            field("corner_m", 2, &Table::corner_m, range(0.0, 0.1), "radius of its corners").heard_if(is_square),
            field("tilt", 3, &Table::tilt_rad, degrees_within("tilt", 10.0), "to the north"),
            field("push", 4, &Table::push_mps, speed("push"), "when it is moved"),
            field("drop_m", 5, &Table::drop_m, range(0.0, 2.0), "it survives"),
            field("legs_m", 6, &Table::legs_m, numbers(2, 4, 0.1, 2.0), "their lengths"),
            field("place_m", 7, &Table::place_m, range(-9.0, 9.0), "in the room"),
            field("folds", 8, &Table::folds, any(), "for storage").written_off_default(),
            field("own_cup", 9, &Table::own_cup, cup_fields(), "its owner's").or_flag(),
            named("cups", 10, &Table::cups, 3, cup_fields(), "of guests"),
        }
            .block()
            .checked(check_table);
    return fields;
}

Table read(const std::string& yaml) {
    static const std::filesystem::path file = "/room/table.yaml";
    const YamlValue document = parse_yaml(yaml, file);
    return read_fields(table_fields(), YamlEntry(document, file, "table"));
}

std::string table_refusal(const std::string& yaml) {
    try {
        read(yaml);
    } catch (const InputError& error) {
        return error.what();
    }
    return "not refused";
}

TEST(Fields, ReadsWhatIsGivenAndKeepsDefaults) {
    EXPECT_EQ(read("{}"), Table{});
    const Table table = read("shape: square\ncorner_m: 0.01\ntilt_deg: 9\npush_kmh: 36\ndrop_m: 1\nlegs_m: [1, 1, 1]\nplace_m: [1, 2, 3]\n"
                             "folds: true\nown_cup: {handles: 2}\ncups: {a: {height_m: 0.5}, b: {}}\n");
    const Table expected{Shape::square,
                         radians(9.0),
                         10.0,
                         0.01,
                         1.0,
                         {1.0, 1.0, 1.0},
                         {1.0, 2.0, 3.0},
                         true,
                         Cup{"", 0.1, 2},
                         {{"a", 0.5, 1}, {"b", 0.1, 1}}};
    EXPECT_EQ(table, expected);
    EXPECT_EQ(read("own_cup: true").own_cup, Cup{});
    EXPECT_EQ(read("own_cup: false").own_cup, std::nullopt);
    EXPECT_EQ(read("{tilt_rad: 0.1, push_mps: 3}").push_mps, 3.0);
}

TEST(Fields, RefusesWithPlaceAndNearestKey) {
    EXPECT_EQ(table_refusal("shape: rund"),
              "/room/table.yaml:1:8: table.shape: found 'rund', expected one of round, square (nearest: 'round')");
    EXPECT_THAT(table_refusal("folds: true\nshap: round"),
                HasSubstr("table.yaml:2:1: table.shap: unknown key, expected 'shape', the nearest"));
    EXPECT_THAT(table_refusal("tilt: 3"), HasSubstr("'tilt_deg', the nearest known key"));
    EXPECT_THAT(table_refusal("{tilt_deg: 3, tilt_rad: 0.1}"), HasSubstr("'tilt_rad' beside 'tilt_deg', expected one of them"));
    EXPECT_THAT(table_refusal("tilt_deg: 11"), HasSubstr("expected a number from -10 to 10"));
    EXPECT_THAT(table_refusal("cups: {a: {height_m: 2}}"), HasSubstr("table.cups.a.height_m: found '2', expected a number from 0.01 to 1"));
    EXPECT_EQ(field_named(table_fields(), "drop_m").id, 5);
    EXPECT_THROW(field_named(table_fields(), "drop"), std::logic_error) << "a word of our own, no user's";
    EXPECT_THAT(table_refusal("own_cup: 3"), HasSubstr("expected true or false"));
    EXPECT_THAT(table_refusal("folds: true"), HasSubstr("two legs that fold"));
    EXPECT_THAT(table_refusal("{shape: round, corner_m: 0.1}"),
                HasSubstr("a key that shape 'round' does not use, expected none but shape"));
}

TEST(Fields, WritesWhatItReadsBack) {
    const Table table = read("tilt_deg: 9\npush_kmh: 36\nlegs_m: [1, 1, 1]\nown_cup: true\ncups: {a: {height_m: 0.5}}\nfolds: true");
    const std::string text = write_fields(table_fields(), table, 0);
    EXPECT_EQ(text, "shape: square\ncorner_m: 0.02\ntilt_deg: 9\npush_mps: 10\nlegs_m: [1, 1, 1]\nplace_m: [0, 0, 0]\nfolds: true\n"
                    "own_cup: {height_m: 0.1, handles: 1}\ncups:\n  \"a\": {height_m: 0.5, handles: 1}\n");
    EXPECT_EQ(read(text), table);
    EXPECT_THAT(write_fields(table_fields(), read("shape: round"), 1),
                testing::Not(testing::AnyOf(HasSubstr("corner"), HasSubstr("folds"))));
}

TEST(Fields, TellsEditorsAndReaders) {
    const auto schema = nlohmann::json::parse(schema_of(table_fields()));
    EXPECT_EQ(schema["properties"]["corner_m"], nlohmann::json::parse(R"({"type": "number", "minimum": 0, "maximum": 0.1,
        "description": "radius of its corners"})"));
    EXPECT_TRUE(schema["properties"].contains("tilt_deg") && schema["properties"].contains("tilt_rad"));
    EXPECT_EQ(schema["properties"]["own_cup"]["anyOf"][0]["type"], "boolean");
    const std::vector<KeyList> lists = key_lists("table", table_fields(), table_fields().usual.get());
    const auto line = [&](const std::string& name) {
        return *std::ranges::find_if(lists[0].lines, [&](const KeyLine& one) { return one.names.front() == name; });
    };
    EXPECT_EQ(line("corner_m"), (KeyLine{{"corner_m"}, "0..0.1 m", {}, "", "0.02", false, "radius of its corners"}));
    EXPECT_EQ(line("tilt_deg"), (KeyLine{{"tilt_deg", "tilt_rad"}, "-10..10 °", {}, "", "0", false, "to the north"}));
    EXPECT_EQ(line("cups").below, "table.cups.NAME");
    ASSERT_EQ(lists.size(), 3U);
    EXPECT_EQ(lists[2].path, "table.cups.NAME");
}

} // namespace
} // namespace fernlicht
