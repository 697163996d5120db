// What a study tells of its result: documents for people, tables for programs, pictures.
#pragma once

#include "runner/experiments/study/study_result.h"
#include "runner/files/described_json.h"
#include "runner/findings/paper_figure.h"
#include "runner/findings/plots/dot_plot.h"
#include "runner/findings/report.h"

namespace fernlicht {

/// The page: verdict, largest changes, lamps, plots, all deciding readings, pictures, cells. It leads to the files of `papers` beside it.
Document document(const StudyResult& result, const std::vector<std::string>& papers = {});
/// For a terminal: verdict, what differs between the lamps, the largest changes, what failed.
Document study_summary(const StudyResult& result);
/// For papers and for pages of CI servers: verdict, what is red and how it is repeated, the decision, the table of the deciding readings.
Document study_paper(const StudyResult& result);

/// study.schema.json describes it. What differs from call to call stands under `context`.
JsonMembers study_members(StudyResult& result); ///< of its JSON; what was played does not come back
/// RFC 4180: one line a change, piece by piece.
void study_csv(const StudyResult& result, const TakePiece& take);
/// The verdicts as those of a run: one suite a cell, and one of the study's own limits.
Report suites_of(const StudyResult& result);
/// The cells in the names of their drives and lamp sets, as known failures have them, and last the study's own verdicts.
Report as_report(const StudyResult& result);

/// Pictures are of the first so many places: a page shows no thousands.
inline constexpr std::size_t max_pictured_places = 48;
/// Of more cells only what decides or has limits is told, and the folders are kept of those that are pictured or red.
inline constexpr std::size_t most_told_cells = 500;

/// Of --fail-on-change, among the study's own.
inline constexpr const char* unchanged_verdict = "history";

/// Reach over each drive, lux from above and its difference, error over time, the lamps' difference. EXR files are read below `folder`.
std::vector<StudyFigure> study_figures(const StudyResult& result, const std::filesystem::path& folder);

/// Adds a figure for each axis of numbers and each of the first readings of what decides that run over it: a line a lamp through the
/// medians of the cells at each value; of a sample, whose cells all have values of their own, dots. Titles say where each line begins and
/// ends.
void add_over_axes(const StudyResult& result, std::vector<StudyFigure>& figures);

/// Lanes and car on the shown maps of cells that are played over the same road from the same drive; `drive` is one of theirs.
void add_map_edges(const Drive& drive, std::vector<CellResult*> cells);

/// Cells that differ in nothing but the lamp, in order; those that were not played are left out, and groups without any.
std::vector<std::vector<std::size_t>> groups_of(const StudyResult& result);

/// What decides first of all that was measured.
std::optional<ReadingKey> first_deciding(const StudyResult& result);
/// By how much the first of these cells that is compared with another is better than that, relative; below 0: worse. 0 within what is open;
/// nullopt where nothing tells.
std::optional<double> gain_among(const StudyResult& result, const std::vector<std::size_t>& cells, const ReadingKey& key);

/// "dimmer against production: part of zone I 5.0 % dimmer (8.2 to 2.9 degrees left, 4.2 to 1.5 degrees down). Nothing else differs
/// beyond the noise of the tables, 0.82 %." Of a shift, the three named places that it changed most. Zones beyond the clearest three are
/// counted. Angles are the goniometer's.
std::string lamp_verdict(const LampComparison& lamps);
/// How each lamp's beams stand under each aim that was played.
Section aims_section(const StudyResult& result);
/// What cars within tolerances read, route by route; no blocks where nothing was asked.
Section cars_section(const StudyResult& result);
/// What decides first: best and worst lamp in a sentence, lamps by routes, and all that decides, ranked; no blocks where nothing was
/// measured.
struct Decision;
Section answer_section(const StudyResult& result, const std::vector<Decision>& decisions);
/// All that decides, ranked by how much better it becomes; nullopt where nothing is better or worse.
std::optional<plots::DotPlot> ranking_of(const StudyResult& result, const Decision& decision);
/// For papers: rankings, reach and glare over each drive, at column width.
std::vector<PaperFigure> paper_figures(const StudyResult& result);
/// For papers: lamps by routes, and what decides.
Document paper_tables(const StudyResult& result);
/// The check of the lamp files as a section: before all else where a file makes readings meaningless, else before the cells.
void add_lamp_files(const StudyResult& result, Document& document);
/// How many deciding readings changed, or why that is not known.
std::string study_sentence(const StudyResult& result);

} // namespace fernlicht
