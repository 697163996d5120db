#include "runner/experiments/run/run_document.h"
#include "runner/findings/series.h"
#include "scenarios/studies/study.h"

#include <algorithm>
#include <utility>

namespace fernlicht {

void add_cars(const ComparedDrive& drive, Sections& sections) {
    bool introduced = false;
    for (const PlayedCell* const played : drive.lamp_sets) {
        if (!played->series || played->series->readings.empty())
            continue;
        const SeriesFindings& series = *played->series;
        const std::string name = drive.name + "-" + played->lamp_set;
        if (!std::exchange(introduced, true))
            sections.push_back(
                {"Cars of a series",
                 {std::string("Readings of cars whose lamps, height and load differ by the drive’s tolerances. Each car counts "
                              "from the car as designed, whose figures are those of this page.") +
                      (series.rendered ? "" : " Calculated from the candela tables, without shadows."),
                  tolerances_table(series, drive.name + "-tolerances")},
                 3});
        Section& section = sections.emplace_back(Section{played->lamp_set, {}, 4});
        if (!series.within.empty())
            section.blocks.emplace_back(within_table(series, name + "-within"));
        section.blocks.emplace_back(cars_table(series, name + "-cars", &decides_by_default()));
        Table all = cars_table(series, name + "-all-cars", nullptr);
        all.caption = "All readings";
        all.folded = all.off_terminal = true;
        section.blocks.emplace_back(std::move(all));
    }
}

} // namespace fernlicht
