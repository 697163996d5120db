// What asks for a reading in a drive's `measure:`.
#include "metrics/folds/reading_names.h"
#include "metrics/readings/quantities.h"

#include <gmock/gmock.h>

namespace fernlicht {
namespace {

/// Each form of each quantity's names, up to where it varies: "glare_".
TEST(ReadingNames, EachBeginningSaysWhatAsksForIt) {
    for (const QuantityRow& row : quantities()) {
        const std::string_view forms = row.forms;
        for (std::size_t from = 0; from < forms.size();) {
            const std::size_t end = std::min(forms.find(' ', from), forms.size());
            std::string_view form = forms.substr(from, end - from);
            form.remove_prefix(form.starts_with('(') ? 1 : 0); // of several words the first
            std::string beginning(form.substr(0, form.find_first_of("<(|")));
            if (!beginning.empty() && !beginning.ends_with('_'))
                beginning += '_';
            from = end + 1;
            const bool is_always_there = beginning.empty() || beginning.starts_with("probe_") || beginning.starts_with("frame_") ||
                                         beginning.starts_with("control_") || beginning.starts_with("cars_");
            EXPECT_EQ(asked_for_by(beginning).empty(), is_always_there) << row.id << ": " << beginning;
        }
    }
    EXPECT_EQ(asked_for_by("foreground_own_lx"), "homogeneity");
    EXPECT_EQ(asked_for_by("rech_5lx"), "");
}

} // namespace
} // namespace fernlicht
