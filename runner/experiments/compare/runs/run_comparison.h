// Two runs against each other: every reading that both have, every stored frame that both have, and what could not be compared. Plain
// values.
#pragma once

#include "metrics/beam/lamp_difference.h"
#include "runner/experiments/compare/picture_comparison.h"
#include "runner/experiments/compare/runs/run_folder.h"
#include "runner/experiments/compare/runs/yaml_difference.h"

namespace fernlicht {

struct RunChange : ReadingChange {
    bool decides = false; ///< the study's usual ones, those that a limit names, and all that are no extents
};

/// How long a pass took, old against new. The uncertainty is half the range from the 5th to the 95th percentile of each run's frames,
/// both added as the root of their squares; fewer than six frames tell nothing.
struct TimeChange : ReadingChange {
    std::size_t old_samples = 0, new_samples = 0;
};

/// One stored file of a moment, of both runs.
struct FramePair {
    StoredFrame old_frame, new_frame;
    bool is_display = false;           ///< the PNGs; else the EXRs
    View view;                         ///< of the new run
    PictureComparison comparison;      ///< without its maps
    std::vector<std::string> pictures; ///< that were drawn, below the comparison's folder
    std::string file(const StoredFrame& frame) const { return is_display ? frame.png : frame.exr; }
    bool is_equal() const; ///< no pixel of any channel differs
};

/// The files of lamps of one name, where they are not the same bytes.
struct LampFilesDifference {
    std::string lamps; ///< "left, right"
    std::filesystem::path before, now;
    LampDifference difference;
};

struct DriveComparison {
    RunDrive before, now;
    std::string name;                   ///< good for a file: "first-light-1_xenon-against-halogen"
    std::vector<YamlChange> settings;   ///< of the drives as they were played, lamp sets included
    std::vector<std::string> new_bytes; ///< files of one path in both runs whose content is another
    std::vector<LampFilesDifference> lamp_files;
    std::vector<RunChange> changes; ///< all readings that both have
    std::vector<TimeChange> times;
    std::vector<FramePair> frames;
    std::vector<std::string> left_out; ///< what could not be compared and why, one sentence each
    std::vector<ComparedFigure> figures;

    double lamp_noise() const; ///< the largest noise of the lamps' tables, relative; 0 where they are the same

    std::string old_label() const; ///< "A: halogen"
    std::string new_label() const;
};

struct RunComparison : Findings {
    RunFolder before, now;
    std::vector<DriveComparison> drives;
    std::vector<std::string> left_out;                        ///< drives that one run alone has, one sentence each
    std::vector<std::pair<std::size_t, std::size_t>> largest; ///< drive and change: at most three, the largest real ones, each reading once
    std::string strictness_name;                              ///< "" for none
    std::vector<std::string> not_judged;                      ///< why a picture was not held to the strictness asked for

    bool passed() const; ///< true where no strictness was asked for
    std::size_t count(ChangeKind kind) const;
};

struct RunCompareOptions {
    std::optional<double> pixels_per_degree; ///< of driver's views; none: from their field of view
    const StrictnessClass* strictness = nullptr;
};

/// Pairs drives by name, lamp set and technique, then by lamp set, then the one left on either side. Throws InputError where nothing can be
/// compared, with the reason.
RunComparison compare_runs(RunFolder before, RunFolder now, const RunCompareOptions& options);

/// Draws, below frames/, pictures of `pictured` moments of each drive and view that differ: spread evenly, and the one that
/// differs most. Fills in what was drawn, and every drive's figures.
void draw_runs(RunComparison& runs, const RunCompareOptions& options, std::size_t pictured, const TakePlot& take);

Document document(const RunComparison& runs);
JsonMembers runs_members(RunComparison& runs); ///< of compare.json
/// RFC 4180: a line a reading and a time; a line a figure of a stored frame's channel.
std::string runs_csv(const RunComparison& runs);
std::string frames_csv(const RunComparison& runs);

/// "c0-12": a reading's row in the page, in compare.json and in compare.csv.
std::string row_id(std::size_t drive, std::size_t change);

} // namespace fernlicht
