// What `fernlicht rate` found. The writers only format it.
#pragma once

#include "metrics/rating/score.h"
#include "metrics/readings/reading_key.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

namespace fernlicht {

struct PhotometerFound {
    Photometer photometer;
    LightApproach approach;                       ///< all moments in which the car comes nearer; not in JSON
    std::optional<double> pitch_deg;              ///< mean over the distance measured
    std::vector<RangeJudgement> ranges;           ///< by distance
    std::vector<std::optional<double>> higher_lx; ///< of each: the light that decides with all lamps aimed 0.1 degrees higher
    RatingVerdict verdict = RatingVerdict::told;
    std::string why = {}; ///< not measured
};

struct RowFound {
    RatingRow row;
    std::string drive; ///< its name
    RatingVerdict verdict = RatingVerdict::told;
    std::string why = {};                     ///< not measured
    bool counts = true;                       ///< false: told alone, and of a lamp set that the lamps under test have not
    std::vector<PhotometerFound> photometers; ///< of a row of light
    std::optional<ReadingKey> key;            ///< of a row of a reading, as the next
    std::string unit;                         ///< "": none, or of a row of light
    Value value, higher;                      ///< higher: with all lamps aimed 0.1 degrees higher
    Value points;                             ///< not measured without points
    bool of_reading() const { return row.of_reading(); }
};

/// A sentence, and the drives that say it.
struct RatingNote {
    std::string note;
    std::vector<std::string> drives;
};

struct RatingFound : Findings {
    Rating rating;
    std::string lamps, lamp_set; ///< file of the lamps under test; which of it is rated
    std::vector<RatingNote> notes;
    std::vector<RowFound> rows;
    Score score;
    RatingVerdict verdict() const;
};

/// Nothing exceeded, and all measured that counts.
bool all_within(const RatingFound& found);

/// "modelled on FMVSS 108 S14.9.3.12, 2022": never that it is that test.
std::string modelled_text(const Rating& rating);

/// docs/ratings.md tells how to read it.
Document document(const RatingFound& found);
JsonMembers rating_members(RatingFound& found); ///< of rating.json
/// A line for each range of each photometer, and for each reading.
std::string rating_csv(const RatingFound& found);
/// A line for each moment of each photometer.
std::string light_csv(const RatingFound& found);

} // namespace fernlicht
