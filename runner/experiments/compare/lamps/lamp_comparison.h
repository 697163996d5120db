// Two lamps against each other. Plain values.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/beam/lamp_difference.h"
#include "metrics/regulation/regulation_check.h"
#include "runner/experiments/compare/lamps/lamp_description.h"
#include "runner/experiments/compare/picture_comparison.h"

#include <memory>

namespace fernlicht {

struct ComparedLamp {
    std::filesystem::path path;
    LampFile file;
    LampDescription description;
    CutOffFigures cut_off;                ///< of the lamp as its file has it
    std::optional<RegulationCheck> check; ///< where a regulation was asked for
};

/// One figure of both.
struct LampFact {
    std::string name, unit; ///< "peak_cd"
    std::string words;      ///< for people
    std::optional<double> before, now;
    std::optional<double> uncertainty; ///< of the difference: how well a place is known; nullopt when nothing tells
    std::string why_not = {};          ///< where one has none
};

/// A row of the regulation; `before` and `now` point into the lamps' checks.
struct ComparedRow {
    std::string id;
    const RowResult* before = nullptr; ///< nullptr: this lamp's check has no such row
    const RowResult* now = nullptr;
};

struct LampPairComparison {
    ComparedLamp before, now;
    LampDifference difference;
    std::vector<LampFact> facts;
    const Regulation* regulation = nullptr;
    std::vector<ComparedRow> rows;
    std::vector<ComparedFigure> figures;

    bool passed() const; ///< false where a regulation was asked for and B does not pass it
};

struct LampCompareOptions {
    double noise_relative = 0.0; ///< standard deviation of an intensity
    std::string regulation;      ///< id; "" for none
};

/// Throws InputError: files that are no lamps or have no light, a regulation that is not known. The result points into itself.
std::unique_ptr<LampPairComparison> compare_lamp_files(const std::filesystem::path& before, const std::filesystem::path& now,
                                                       const LampCompareOptions& options);

/// Isocandela diagrams beside each other and in one, difference in cd, ratio, cut-off lines.
std::vector<ComparedFigure> lamp_figures(const LampPairComparison& lamps);

std::string lamps_text(const LampPairComparison& lamps);
/// compare.schema.json describes it.
std::string lamps_json(const LampPairComparison& lamps);
/// RFC 4180: a line a figure and a row of the regulation.
std::string lamps_csv(const LampPairComparison& lamps);
/// One self-contained page.
std::string lamps_html(const LampPairComparison& lamps);

} // namespace fernlicht
