// docs/readings.md has the table that the program prints.
#include "metrics/readings/reading_words.h"

#include <fstream>
#include <gmock/gmock.h>
#include <sstream>

namespace fernlicht {
namespace {

TEST(ReadingsList, IsTheTableOfTheDocumentation) {
    std::stringstream page;
    page << std::ifstream(FERNLICHT_SOURCE_DIR "/docs/readings.md").rdbuf();
    EXPECT_THAT(page.str(), testing::HasSubstr("<!-- readings: begin -->\n" + readings_markdown() + "<!-- readings: end -->"))
        << "put what `fernlicht readings --markdown` prints between the two comments";
}

TEST(ReadingsList, SaysEachQuantityInWords) {
    EXPECT_THAT(readings_text(), testing::HasSubstr("patch_dark_own[_max]_m\n    m: longest patch of a moment that is darker than its "
                                                    "surroundings; lower is better\n"));
    EXPECT_THAT(readings_text(), testing::HasSubstr("sensor_NAME_at_50m_lx\nsensor_NAME_max_lx\n"));
}

} // namespace
} // namespace fernlicht
