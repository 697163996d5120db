// `fernlicht lamp FILE`: what a lamp file holds, as text, JSON or picture; scaled, mirrored, summed and converted.
#pragma once

#include "runner/experiments/regulation/regulation_result.h"
#include "runner/write/plots/svg.h"
#include "scenarios/lamps/lamp_file.h"
#include "scenarios/lamps/pixel_lamp.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fernlicht {

/// Of tables of adaptive beams: whom a lamp of pixels spares, or of fmvss108-adb where the beam is dimmed.
struct AdaptiveRequest {
    std::vector<double> dimmed_deg = {}; ///< left, right, bottom, top in the file's angles, turned with the lamp; empty: the other itself
    std::vector<double> other_m = {};    ///< ahead of the lamp, left of the car's middle: its nearer end; empty: nobody
    std::vector<double> other_size_m{1.8, 1.5}; ///< width, height
    std::vector<double> lamp_at_m{0.45, 0.65};  ///< left of the car's middle, above the road
    double margin_deg = 0.7;                    ///< of dark round the other
    std::vector<std::string> tables{"fmvss108-lb2v-vol", "fmvss108-ub2"};

    bool asked() const { return !dimmed_deg.empty() || !other_m.empty(); }
    /// Throws InputError naming the flag whose numbers are none of its kind, or that nothing hears.
    void check() const;
};

struct LampRequest {
    std::filesystem::path file;
    std::string model; ///< one of our own models in place of a file
    LampReadOptions reading;
    std::filesystem::path levels;   ///< of a pixel lamp's pixels over time; empty: all at full
    std::optional<double> levels_s; ///< when
    std::string levels_lamp;        ///< of a file of levels that a run wrote: whose; empty: of its only lamp
    double scale = 1.0;
    bool mirror = false;
    std::vector<std::filesystem::path> add, subtract;
    std::filesystem::path other_side;       ///< the lamp of the other side, of --check and of tables that judge both; empty: none
    std::filesystem::path convert, picture; ///< empty: none
    bool force = false;                     ///< files of these names may be replaced
    std::vector<double> window;             ///< of the picture: left, right, bottom, top in degrees; empty: chosen
    std::optional<int> spots;               ///< spot lights to fit, 1 to 8
    bool json = false;
    std::filesystem::path against; ///< a lamp to be told apart from; empty: none
    double noise_relative = 0.0;   ///< with `against`: standard deviation of an intensity
    std::string regulation;        ///< id or "list"; empty: none
    std::string aim;               ///< --aim-rule of --regulation; empty: the regulation's own
    std::filesystem::path aim_by;
    bool left_hand_traffic = false, no_re_aim = false;
    AdaptiveRequest adaptive; ///< of --regulation fmvss108-adb
    bool cut_off = false;
    bool check = false, strict = false, watch = false;
    std::string function;                             ///< of --check; empty: recognised
    std::optional<double> voltage_v;                  ///< of --check; nullopt: not stated
    SharpnessRule sharpness = SharpnessRule::maximum; ///< of --cut-off
    double detector_mm = 30.0;                        ///< of --cut-off, at 25 m
};

/// Reads or models the lamp, sets its pixels as they are at a time of a file of levels, then scales, mirrors, adds and subtracts, in this
/// order. Throws InputError.
LampFile lamp_of(const LampRequest& request);

/// To request.picture, as its extension says.
void write_lamp_picture(const plots::Figure& figure, const LampRequest& request);

/// All that the request asks for; text or JSON goes to standard output. Returns 0, or 1 when a regulation's row fails. Throws InputError,
/// DeviceError.
int lamp_command(const LampRequest& request);

/// Prints the check; 0 when every row passes, else 1. Throws InputError.
int lamp_regulation(const LampRequest& request);

/// The same for --regulation fmvss108-adb, whose table follows from where the beam is dimmed.
int lamp_adaptive(const LampRequest& request);
/// Puts the lamp of pixels into the state in which it spares the other one; says how. Returns the other's own outline. Throws InputError.
AngleBox spare_other(LampFile& lamp, const AdaptiveRequest& request, std::string& how);
inline constexpr const char* adaptive_table = "fmvss108-adb";

/// How request.aim is meant; nullopt: the regulation's own. Throws InputError.
std::optional<AimRule> requested_aim(const LampRequest& request);
/// Prints what was found; 0 when every row passes, else 1.
int tell_regulation(const RegulationFound& found, const LampRequest& request);

/// Prints the cut-off's figures; 0. Throws InputError.
int lamp_cut_off(const LampRequest& request);

/// Prints the intake check, with `other_side` as the right lamp beside `file` as the left one; 0. Throws InputError, with `strict` also for
/// what makes readings meaningless.
int lamp_check(const LampRequest& request);

/// Throws InputError where flags of the check are given without it.
void refuse_check_options(const LampRequest& request);

/// Throws InputError where flags of these two are given without either.
void refuse_regulation_options(const LampRequest& request);

/// The flags of both.
void add_regulation_options(CLI::App& command, LampRequest& request);
/// Those of tables of adaptive beams.
void add_adaptive_options(CLI::App& command, AdaptiveRequest& request);
/// Those of the check.
void add_check_options(CLI::App& command, LampRequest& request);

} // namespace fernlicht
