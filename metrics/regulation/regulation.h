// What a regulation asks of a lamp's beam, as plain data: rows of points, segments, zones and sums with limits in candela.
// Directions are those of the goniometer: H right positive, V up positive, degrees, for right-hand traffic.
#pragma once

#include "metrics/beam/received_beam.h"

#include <limits>
#include <string>
#include <vector>

namespace fernlicht {

enum class RowKind {
    point,     ///< one direction
    segment,   ///< all directions between two, straight in H and V: each keeps to the limits
    zone,      ///< all directions in a polygon: each keeps to the limits
    sum,       ///< intensities of several directions added
    brightest, ///< the maximum over a polygon keeps to the limits: a minimum is met by one direction in it
};

/// What is measured when a beam is made by both sides of a car, one lamp file each.
enum class Scope {
    beam,        ///< what the regulation judges: the lamp, or half the sum of both sides where Regulation::half_sum says so
    each_side,   ///< each lamp by itself
    either_side, ///< the better one of the two
    each_of_two, ///< each lamp by itself, and only where two were given
};

struct Limits {
    double min_cd = 0.0; ///< 0: no minimum
    double max_cd = std::numeric_limits<double>::infinity();
};

/// How well known what a table says is.
enum class Sureness {
    as_table,    ///< of a row: as the rest of its table
    one_source,  ///< one reading of one print
    two_prints,  ///< two prints of it, or of a text that took it over, read by the same hand
    two_sources, ///< two readings of two prints
    inferred,    ///< not read where the table says it stands: taken from the text that the other one says it took over
};
const char* in_words(Sureness sureness); ///< "one source"; "" of as_table

struct RegulationRow {
    std::string id;
    RowKind kind = RowKind::point;
    std::vector<Direction> places; ///< one, two ends, the polygon's corners, or the sum's directions
    Limits limits;
    Scope scope = Scope::beam;
    std::string ratio_of = {};    ///< another row of the table, whose value times `ratio` is a limit; empty: none
    double ratio = 0.0;           ///< above 0
    bool ratio_is_minimum = true; ///< else it is a maximum
    std::string note = {};
    Sureness sureness = Sureness::as_table;
};

enum class AimRule {
    as_is,           ///< as the file has it
    cut_off,         ///< UN: inflection 2.5 degrees left at 0.57 D, kink by the three verticals at 1, 2 and 3 R on V-V
    automatic,       ///< UN: cut_off, else cut_off_by_line, else elbow: the first that finds what it aims by; else the regulation's way
    cut_off_by_line, ///< UN: the same height, horizontally by the line at 0.2 D onto line A, 0.5 R
    elbow,           ///< ours: the same height, the elbow by a fit over all columns on V-V
    vol,             ///< FMVSS 108: greatest gradient 2.5 degrees left at 0.4 D; no horizontal aim
    vor,             ///< FMVSS 108: greatest gradient 2.0 degrees right on H-H; no horizontal aim
    maximum,         ///< middle of the area of maximum intensity on HV
};

/// How far the beam may be turned once more when it fails as first aimed, degrees, all >= 0.
struct ReAim {
    double left_deg = 0.0, right_deg = 0.0, vertical_deg = 0.0;
    bool any() const { return left_deg > 0.0 || right_deg > 0.0 || vertical_deg > 0.0; }
};

struct Regulation {
    std::string id;      ///< "r149-c"
    std::string title;   ///< "UN R149, passing beam class C"
    std::string edition; ///< of the text that the table stands for
    std::string source;  ///< who read it where
    Receiver receiver;
    AimRule aim = AimRule::as_is;
    ReAim re_aim = {};
    double row_re_aim_deg = 0.0; ///< each row by itself may be measured this far off its place
    bool half_sum = false;       ///< values hold for half the sum of both sides
    bool pairs = false;          ///< two lamps may be given: the left and the right
    bool mirrors = true;         ///< has a form for left-hand traffic
    std::vector<RegulationRow> rows = {};
    std::vector<std::string> notes = {};
    std::string aim_note = {};                ///< what `aim` means here; "" where it needs no word
    Sureness sureness = Sureness::one_source; ///< of rows that say no other

    Sureness sureness_of(const RegulationRow& row) const { return row.sureness == Sureness::as_table ? sureness : row.sureness; }
};

/// All tables, in the order of `regulation_ids()`.
const std::vector<Regulation>& regulations();
std::vector<std::string> regulation_ids();
/// In capitals or small letters. Throws InputError with the known ids that begin so, or the nearest one.
const Regulation& regulation(const std::string& asked);

} // namespace fernlicht
