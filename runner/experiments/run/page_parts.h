// The parts of report.html as data for its template. Every text in them is clean; the template escapes it.
#pragma once

#include "runner/write/page_base.h"

namespace fernlicht {

/// One drive with every lamp set that it was played with, in the order of the report.
struct ComparedDrive {
    std::string name;
    std::vector<const PlayedVariant*> variants;
};
std::vector<ComparedDrive> compared_drives(const Report& report);

/// Verdict, its reasons, and what could not be measured.
kainjow::mustache::data verdict_part(const Report& report);

/// Reach, width and area per limit and lamp with differences from the first lamp set; one table per plane and lane.
kainjow::mustache::data extent_tables(const ComparedDrive& drive);

/// Figures for the top of the page: reach in the own lane at 1 and 5 lx per lamp set.
kainjow::mustache::data headline_reaches(const ComparedDrive& drive);

/// Moments with pictures: views and maps side by side per lamp set. Takes the bytes that it embeds from `budget_bytes`; pictures that no
/// longer fit are linked.
kainjow::mustache::data moments_part(const ComparedDrive& drive, const std::filesystem::path& folder, std::size_t& budget_bytes);

/// Readings beside each other per lamp set; lamps with their files; what was left out and noted, once where it holds for all.
kainjow::mustache::data details_part(const ComparedDrive& drive);

/// How `shadows: auto` was decided.
kainjow::mustache::data shadows_part(const ComparedDrive& drive);

/// How pictures are seen on the display of the drive's profile.
kainjow::mustache::data display_part(const ComparedDrive& drive);

/// What leaving out saved each lamp set, in a sentence and in counts.
kainjow::mustache::data savings_part(const ComparedDrive& drive);

/// How far each lamp set's lux images lie from the reference, and what that cost.
kainjow::mustache::data error_part(const ComparedDrive& drive);

/// Spread of each pass of each lamp set.
kainjow::mustache::data timing_table(const ComparedDrive& drive);

/// How fast each lamp set was played beside what drawing alone takes.
kainjow::mustache::data throughput_table(const ComparedDrive& drive);

/// Punctuality and losses of a live run.
kainjow::mustache::data live_part(const LiveFigures& live);

} // namespace fernlicht
