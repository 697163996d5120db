// What a run's page shows, drive by drive; with the moments' pictures, which it takes from the report itself.
#pragma once

#include "runner/findings/document.h"
#include "runner/findings/report.h"

namespace fernlicht {

/// One drive with every lamp set that it was played with, in the order of the report.
struct ComparedDrive {
    std::string name;
    std::vector<const PlayedCell*> lamp_sets;
};
std::vector<ComparedDrive> compared_drives(const Report& report);

struct RunPage {
    Section verdict;
    std::vector<Section> live;
    struct OfDrive {
        ComparedDrive drive;
        std::vector<Section> lead = {};       ///< the figures that matter and how they went over the drive: beside its pictures
        std::vector<Section> extents, others; ///< before and behind its pictures
    };
    std::vector<OfDrive> drives;
};

} // namespace fernlicht
