// What a study decides: of each deciding reading whether the new lamp is better, over all routes and conditions.
#pragma once

#include "runner/experiments/study/study_result.h"

namespace fernlicht {

/// More: 1; less: -1; 0 where neither is.
double better_is(const ReadingKey& reading);

enum class DecisionOutcome {
    better,
    worse,
    mixed,      ///< better in some places, worse in others
    changed,    ///< for real, by a reading of which neither more nor less is better
    within_aim, ///< nowhere by more than 0.1 degrees of aim would do
    undecided,  ///< nothing tells in any place
    same
};
const char* outcome_name(DecisionOutcome outcome); ///< "better", "within aim"

/// One deciding reading of one comparison.
struct DecidedReading {
    ReadingKey reading;
    DecisionOutcome outcome = DecisionOutcome::same;
    std::vector<std::size_t> changes;    ///< of the study: one for each place
    std::vector<std::size_t> decided_by; ///< those of `changes` that make the outcome
    std::size_t told = 0;                ///< of `decided_by` the one whose change is the median in size, of two the smaller
};

struct Decision {
    std::size_t comparison = 0;              ///< of the study
    std::vector<DecidedReading> readings;    ///< in the order in which the study names them
    bool aim_alone = false;                  ///< the beams of both lamps differ by their aim and by nothing else
    std::optional<double> aimed_up_deg = {}; ///< of the new lamp's low beams against the old one's, as mounted; nullopt: not known
    std::size_t count(DecisionOutcome outcome) const;
};

/// For each comparison of which something was compared.
std::vector<Decision> decide(const StudyResult& result);

/// "Better by ...", "Worse by ...", "Undecided: ... because ...": what there is of these, without full stops.
/// `doubts`: those alone that speak against the lamp or the comparison.
enum class DecisionParts { all, doubts };
std::vector<std::string> decision_parts(const StudyResult& result, const Decision& decision, DecisionParts which = DecisionParts::all);
/// "xenon against halogen: better by .... Worse by .... Undecided: ... because ...."
std::string decision_sentence(const StudyResult& result, const Decision& decision);
/// "0.11° higher": the new lamp's cut-off as mounted; "" within 0.05°, or where it is not known.
std::string mounted_words(const Decision& decision);
/// "xenon is better in 9, worse in 4 of 22 deciding readings".
std::string decision_count(const StudyResult& result, const Decision& decision);
/// That of one comparison, "What 2 comparisons decide" of several.
std::string decision_heading(const StudyResult& result, const std::vector<Decision>& decisions);
/// "7 results of village-1 repeat what straight-1 has: no further evidence", for each such pair of drives: under one condition neither old
/// nor new values differ by more than their uncertainty.
std::vector<std::string> same_results(const StudyResult& result, const std::vector<Decision>& decisions);
/// One row for each deciding reading of each comparison.
Table decision_table(const StudyResult& result, const std::vector<Decision>& decisions);

} // namespace fernlicht
