// How the lamps of the own car are aimed and where that puts their beams, as pages and JSON show it.
#pragma once

#include "runner/findings/document.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// One lamp with one file. Angles up and to the right are positive, as on the goniometer.
struct LampAim {
    std::string lamp;    ///< by name
    std::string file;    ///< name of its file
    double from_s = 0.0; ///< since when it has this file
    bool automatic = false, high_beam = false;
    std::optional<double> cut_off_percent;              ///< that was asked for; of an automatic aim alone
    double height_m = 0.0;                              ///< over the road
    std::string by;                                     ///< what its table was looked through for: "kink", "middle of the maximum"
    std::optional<double> file_up_deg, file_right_deg;  ///< where that lies in the file
    double up_bound_deg = 0.0, right_bound_deg = 0.0;   ///< of both, in 99 of 100 beams
    std::string why_not;                                ///< of what was not found there; "" where all was
    double turned_up_deg = 0.0, turned_right_deg = 0.0; ///< the lamp against car and place, by rule and angles together
    std::optional<double> percent;                      ///< where that puts the mark: height over run, up positive
    std::optional<double> right_deg;                    ///< and to the right of the car's axis
    std::optional<double> band_lowest_percent, band_highest_percent; ///< that UN R48 allows; of low beams at heights it tells of
    std::string warning; ///< "the cut-off lies ...": where it lies outside the band; "" elsewhere

    bool operator==(const LampAim&) const = default;
};

struct JsonMember;
std::vector<JsonMember> lamp_aim_members(LampAim& aim);

/// Marks of the low beams of one car as two lamp sets have them, lamp by lamp.
struct AimsApart {
    double most_deg = 0.0; ///< up and sideways together, at most
    double up_deg = 0.0;   ///< the first ones lie higher on average
};
/// nullopt where no mark was found in both.
std::optional<AimsApart> low_beams_apart(const std::vector<LampAim>& now, const std::vector<LampAim>& before);
/// "0.20° higher"; "" up to 0.05°.
std::string higher_words(double up_deg);

/// Lamps that are told with the same words in one row, by name; before those columns stand the ones that the caller names, as columns_of()
/// has them ("" for none), filled with `before`.
std::vector<Column> aim_columns(const std::string& before);
void add_aim_rows(Table& table, const std::vector<Cell>& before, const std::vector<LampAim>& aims);
/// What the columns mean.
std::string aim_legend();

/// One sentence for each warning, lamps with the same in one: "halogen, left and right: the cut-off lies ...".
std::vector<std::string> aim_warnings(const std::string& lamp_set, const std::vector<LampAim>& aims);

} // namespace fernlicht
