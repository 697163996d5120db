// Two lamps against each other. Plain values.
#pragma once

#include "metrics/beam/cut_off.h"
#include "metrics/beam/lamp_difference.h"
#include "metrics/regulation/regulation_check.h"
#include "runner/experiments/compare/lamps/lamp_description.h"
#include "runner/experiments/compare/picture_comparison.h"

namespace fernlicht {

struct ComparedLamp {
    std::filesystem::path path;
    LampFile file;
    LampDescription description;
    CutOffFigures cut_off;                ///< of the lamp as its file has it
    std::string cut_off_told, check_told; ///< as JSON, as `fernlicht lamp` writes them
    std::optional<RegulationCheck> check; ///< where a regulation was asked for
};

/// One figure of both.
struct LampFact {
    std::string name, unit; ///< "peak_cd"
    std::string words;      ///< for people
    std::optional<double> before, now;
    std::optional<double> uncertainty; ///< of the difference: how well a place is known; nullopt when nothing tells
    std::string why_not = {};          ///< where one has none
    std::optional<double> change() const { return before && now ? std::optional(*now - *before) : std::nullopt; }
};

/// A row of the regulation; nullopt: this lamp's check has no such row.
struct ComparedRow {
    std::string id, unit;
    std::optional<RowResult> before, now;
};

struct LampPairComparison : Findings {
    ComparedLamp before, now;
    LampDifference difference;
    std::vector<LampFact> facts;
    const Regulation* regulation = nullptr;
    std::vector<ComparedRow> rows;
    std::vector<ComparedFigure> figures; ///< where they are to be drawn

    bool passed() const; ///< false where a regulation was asked for and B does not pass it
};

struct LampCompareOptions {
    double noise_relative = 0.0;  ///< standard deviation of an intensity
    std::string regulation;       ///< id; "" for none
    std::filesystem::path recipe; ///< of those that are text grids; "" for none
};

/// Throws InputError: files that are no lamps or have no light, a regulation that is not known.
LampPairComparison compare_lamp_files(const std::filesystem::path& before, const std::filesystem::path& now,
                                      const LampCompareOptions& options);

/// Isocandela diagrams beside each other and in one, difference in cd, ratio, cut-off lines.
std::vector<ComparedFigure> lamp_figures(const LampPairComparison& lamps);

Document document(const LampPairComparison& lamps);
JsonMembers lamps_members(LampPairComparison& lamps); ///< of compare.json
/// RFC 4180: a line a figure and a row of the regulation.
std::string lamps_csv(const LampPairComparison& lamps);

} // namespace fernlicht
