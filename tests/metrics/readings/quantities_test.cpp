// The table of quantities: complete, in order, without double ids.
#include "metrics/readings/reading_key.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace fernlicht {
namespace {

TEST(Quantities, EachHasOneRowInTheOrderOfTheirNames) {
    std::set<std::string> ids;
    for (std::size_t i = 0; i < quantities().size(); ++i) {
        const QuantityRow& row = quantities()[i];
        EXPECT_EQ(static_cast<std::size_t>(row.quantity), i) << row.id;
        EXPECT_EQ(&row_of(row.quantity), &row);
        EXPECT_TRUE(ids.insert(row.id).second) << row.id;
        for (const char* text : {row.id, row.forms, row.unit, row.words, row.meaning})
            EXPECT_STRNE(text, "") << row.id;
    }
    EXPECT_EQ(row_of(Quantity::pass_time).id, std::string("pass_time")) << "the last one";
    EXPECT_EQ(quantities().size(), static_cast<std::size_t>(Quantity::pass_time) + 1);
}

TEST(Quantities, NamesEndInTheirUnit) {
    const std::pair<const char*, const char*> ends[] = {{"m", "_m"},       {"m2", "_m2"},         {"lx", "_lx"},  {"cd/m2", "_cdm2"},
                                                        {"%", "_percent"}, {"s", "_s"},           {"ms", "_ms"},  {"1", ""},
                                                        {"1/m", "_per_m"}, {"1/deg", "_per_deg"}, {"deg", "_deg"}};
    for (const QuantityRow& row : quantities()) {
        const auto end =
            std::find_if(std::begin(ends), std::end(ends), [&](const auto& known) { return std::string(known.first) == row.unit; });
        ASSERT_NE(end, std::end(ends)) << row.unit;
        for (const ReadingKey& key :
             shapes_of({.quantity = row.quantity, .subject = "a", .lane = "own", .threshold = {1.0}, .distance_m = 5.0}))
            EXPECT_TRUE(name_of(key).ends_with(end->second)) << name_of(key);
    }
}

TEST(Quantities, ASubjectStandsWhereTheTableSaysSo) {
    for (const QuantityRow& row : quantities())
        EXPECT_EQ(row.subject != SubjectKind::none,
                  std::string(row.forms).find("<name>") != std::string::npos || std::string(row.forms).find("<eye>") != std::string::npos)
            << row.id;
}

} // namespace
} // namespace fernlicht
