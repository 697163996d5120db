// What differs between two lamps' beams, and what is no more than noise: aim, cut-off, level, zones.
//
// Both are compared in log intensity at the samples of the tested file. First the noise: what two tables of the same lamp would
// differ by, from their rounding, from what the user says, and from how much neighbouring differences scatter. Then the smallest claim that
// explains the rest: nothing; the whole beam aimed otherwise (a shift of all its light); the cut-off moved while the light below stays (the
// band of 0.5 degrees round it fitted apart from the light more than 1 degree below); the whole beam brighter or dimmer; and last the zones
// that are left. A shift or a level is claimed when it lies beyond `z_limit` standard errors and the directions claimed as zones shrink by
// it. Zones are told by the named places that they hold, and beside all this stands what both lamps give at each of those.
#pragma once

#include "metrics/beam/beam_places.h"
#include "metrics/beam/beam_zones.h"
#include "scenarios/lamps/lamp_file.h"

#include <optional>
#include <string>

namespace fernlicht {

struct LampDifferenceOptions {
    /// Standard deviation of a sample of either table, relative. The estimate from the tables comes on top where it is larger. A tolerance
    /// of +-a is a / sqrt(3) when all within it is as likely.
    double noise_relative = 0.0;
    double false_claim_chance = 0.005; ///< of any claim at all between two tables of one lamp, were the noise known
    /// The tested beam lies so much higher, degrees, which is known already: level and zones are of what differs beside it, and nothing is
    /// claimed of aim and cut-off. 0: they are looked for.
    double tested_up_deg = 0.0;
    std::vector<BeamPlace> places = {}; ///< by whose names differences are told; metrics/regulation/named_places.h has the trade's
};

struct FittedFigure {
    double value = 0.0, uncertainty = 0.0; ///< standard error
};

struct LampDifference {
    std::size_t directions = 0;  ///< samples compared: both tables have data, and either has at least 1/1000 of the peak
    double noise_relative = 0.0; ///< standard deviation of one difference where the beam has more than a tenth of its peak
    double z_limit = 0.0;
    double floor_cd = 0.0;                                 ///< light below this is not compared
    std::optional<FittedFigure> aim_up_deg, aim_right_deg; ///< the whole beam, where claimed; both or neither
    std::optional<FittedFigure> cut_off_up_deg;            ///< over the light below it, where claimed
    std::optional<FittedFigure> level;                     ///< share: +0.03 is 3 % brighter all over; where claimed
    std::vector<BeamZone> zones;                           ///< clearest first
    std::string undecided;                                 ///< what could not be told apart, if anything: one sentence
    TrafficSide side = TrafficSide::unknown, side_against = TrafficSide::unknown;        ///< of the road that each is for
    std::vector<PlaceChange> places;                                                     ///< as the options name them
    BeamFunction function = BeamFunction::other, function_against = BeamFunction::other; ///< where the light leaves no doubt (intake.h)

    /// Claimed by shift, level or zones.
    bool is_explained() const { return aim_up_deg || cut_off_up_deg || level || !zones.empty(); }
    bool any() const;
};

/// A lamp's beam by its file's own samples where these lie on other angles than H and V: their noise is independent, that of a resampled
/// table's samples is not.
struct SampledBeam {
    const CandelaTable* table;               ///< on H and V
    const MeasuredTable* measured = nullptr; ///< the file's own samples; nullptr: those of `table`
    SampledBeam(const CandelaTable& on_h_and_v) : table(&on_h_and_v) {}
    SampledBeam(const LampFile& lamp) : table(&lamp.table), measured(lamp.measured ? &*lamp.measured : nullptr) {}

    const CandelaTable& samples() const { return measured ? measured->table : *table; }
};

/// `tested` against `against`, both with light. Throws std::invalid_argument for a table without light and options out of range (noise
/// 0..1, chance above 0 and below 1). The same tables give the same bytes.
LampDifference compare_lamps(const SampledBeam& tested, const SampledBeam& against, const LampDifferenceOptions& options = {});

/// One sentence each: a high against a low beam, lamps for different sides of the road, aim, cut-off, level, zones; regions whose mean
/// alone differs. "no difference beyond noise" when nothing is claimed.
std::vector<std::string> sentences_of(const LampDifference& difference);

/// A high beam against a low beam, or the other way round.
bool is_of_other_function(const LampDifference& difference);
std::string other_function_text(const LampDifference& difference); ///< where it is
bool is_for_other_side(const LampDifference& difference);
std::string other_side_text(const LampDifference& difference); ///< where it is
/// "75R, 50R and 50V"; "" where nothing named lies there.
std::string zone_where(const BeamZone& zone);
/// "part of zone I 5.0 % dimmer (8.2 to 2.9 degrees left, 4.2 to 1.5 degrees down)".
std::string zone_text(const BeamZone& zone);
/// "50L 5.0 % dimmer": names first.
std::string place_text(const PlaceChange& change);
/// Of a share: "±0.04 %"; "within the digits of the tables" where it is less than 0.005 %.
std::string uncertainty_text(double share);

} // namespace fernlicht
