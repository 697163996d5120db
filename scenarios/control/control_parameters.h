// Lamp control in numbers: laws, actuators, failures. docs/control.md says where the defaults come from. What is absent is not computed.
#pragma once

#include "scenarios/lamps/lamp_file.h"
#include "scenarios/values/errors.h"
#include "scenarios/vehicle/vehicle_parameters.h"

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// What the bend light follows: the steering angle, the yaw rate, or the lane ahead.
enum class BendLaw { steering, yaw_rate, route };

struct BendParameters {
    BendLaw law = BendLaw::yaw_rate;
    std::vector<std::string> lamps;                            ///< empty: all but cornering lamps
    double preview_s = 1.5;                                    ///< how far ahead the light looks, in time
    double gain = 1.0;                                         ///< on the angle
    double filter_s = 0.1;                                     ///< time constant; 0: none
    double dead_band_rad = 0.0;                                ///< this much of the angle is left out on both sides of 0
    double from_speed_mps = 1.4;                               ///< slower: straight ahead; all of the angle from twice as fast
    double outer_share = 1.0;                                  ///< part of the angle that the lamp on the outside of the bend takes
    ActuatorParameters actuator = SwivelParameters{}.actuator; ///< its control period is not used: ControlParameters' holds

    bool operator==(const BendParameters&) const = default;
};

struct CorneringParameters {
    std::vector<std::string> left, right; ///< lamps
    double until_speed_mps = 40.0 / 3.6, again_below_mps = 35.0 / 3.6;
    double on_rad = 0.06, off_rad = 0.04; ///< of the front wheels' angle
    double fade_s = 0.5;

    bool operator==(const CorneringParameters&) const = default;
};

/// Classes of the passing beam as UN R123 names them: C country, V town, E motorway, W wet road.
enum class BeamMode { c, v, e, w };

/// What a class does to the lamps; their own file and aim where it says nothing.
struct BeamModeSettings {
    double level = 1.0;
    double pitch_rad = 0.0; ///< added to the aim; at once, as a part in the lamp turns
    std::shared_ptr<const LampFile> file;

    bool operator==(const BeamModeSettings&) const = default;
};

/// When which class. What takes speed away from a threshold to enter, needs `hysteresis_mps` more to leave.
struct ModeParameters {
    std::vector<std::string> lamps; ///< empty: all whose names have neither "high" nor "corner"
    double v_below_mps = 50.0 / 3.6, v_lit_below_mps = 60.0 / 3.6, v_lit_lx = 10.0;
    double e_above_mps = 110.0 / 3.6, e_motorway_above_mps = 70.0 / 3.6;
    double w_wetness = 0.5, w_wipers_s = 120.0;
    double hysteresis_mps = 5.0 / 3.6;
    double delay_s = 2.0; ///< a class is asked for so long before it comes
    std::array<BeamModeSettings, 4> settings;

    bool operator==(const ModeParameters&) const = default;
};

struct HighBeamParameters {
    std::vector<std::string> lamps; ///< empty: all whose names have "high"
    double on_above_mps = 40.0 / 3.6, off_below_mps = 30.0 / 3.6;
    double dark_below_lx = 5.0, lit_above_lx = 10.0;
    double oncoming_m = 400.0, preceding_m = 200.0; ///< others nearer than this have it dipped, or masked
    double on_delay_s = 1.5, dip_delay_s = 0.2;
    double fade_s = 0.1;

    bool operator==(const HighBeamParameters&) const = default;
};

/// A high beam in windows that go dark one by one: as many as the lamp's file is cut into, or one for a lamp that is a segment itself.
struct SegmentedLamp {
    std::string name;
    std::vector<std::pair<double, double>> windows_deg; ///< from, to; right positive as on the goniometer; ascending
    bool pixels = false;                                ///< in place of windows those that its file describes

    bool operator==(const SegmentedLamp&) const = default;
};

/// Glare-free high beam: with it the automatic high beam stays on, and windows that meet others are dark.
struct GlareFreeParameters {
    std::vector<SegmentedLamp> lamps;
    double margin_rad = 0.0087; ///< to each side of others, 0.5 degrees
    double mask_delay_s = 0.1, relight_delay_s = 0.5;
    double foresee_s = 0.0; ///< others are taken to be where they are and, going straight on, will be so much later

    bool operator==(const GlareFreeParameters&) const = default;
};

enum class CameraGrade { good, legal };

/// By what laws know of others; without it they know all of them exactly and at once.
struct ControlCameraParameters {
    CameraGrade grade = CameraGrade::good;
    std::optional<double> oncoming_m, preceding_m, bicycle_m; ///< reach; nullopt: the grade's
    double field_rad = 0.8727;                                ///< 50 degrees, from side to side
    double rate_hz = 20.0, latency_s = 0.1;                   ///< from a frame to what is told of it
    double noise_rad = 0.0;                                   ///< standard deviation of a bearing, anew in each frame
    double missed = 0.0;                                      ///< share of frames in which a road user is not found
    bool hides = true;                                        ///< the road's crests and other vehicles hide those behind
    int seed = 1;

    bool operator==(const ControlCameraParameters&) const = default;
};

/// Where a law stands in the drive file: told, not compared.
struct PluginPlaces {
    InputError::Where own;
    std::vector<InputError::Where> maps; ///< parameters, inputs, outputs, as far as they are given

    /// Of one of them, else its own.
    InputError::Where of(const std::string& key) const {
        for (const InputError::Where& map : maps)
            if (map.key.ends_with('.' + key))
                return map;
        return {own.file, own.line, own.column, own.key + '.' + key};
    }
    bool operator==(const PluginPlaces&) const { return true; }
};

/// A control law in a shared library (fernlicht_control.h), or in an FMU (fmu_law.h).
struct PluginParameters {
    std::filesystem::path library;  ///< or the FMU
    std::string parameters;         ///< handed over as it is; not to an FMU
    std::vector<std::string> lamps; ///< that it may move
    double period_s = 0.02;         ///< a whole number of control periods, or the next one after
    double budget_s = 0.001;        ///< of a call; longer ones are counted
    double give_up_s = 10.0;        ///< a call that takes so long ends the run
    bool fmu = false;
    /// Of an FMU, by its variables' names: start values, what its inputs read and its outputs command where names differ.
    std::vector<std::pair<std::string, std::string>> values = {}, inputs = {}, outputs = {};
    PluginPlaces places = {};

    bool operator==(const PluginParameters&) const = default;
};

/// What is wrong from when to when.
struct ControlFailure {
    enum class Kind { stuck_swivel, stuck_levelling, lost_signal };
    Kind kind = Kind::lost_signal;
    double at_s = 0.0, until_s = std::numeric_limits<double>::infinity();
    std::string what; ///< the lamp, or the signal

    bool operator==(const ControlFailure&) const = default;
};

/// What lamp control does about a swivel that is stuck (control_loop.h): the others look straight ahead, and the lamp, where it is stuck
/// more than `off_rad` aside, is levelled down to `pitch_rad`, or without levelling dimmed to `level`.
struct StuckSwivelParameters {
    double off_rad = 0.0349, after_s = 0.5;  ///< 2 degrees from what it is asked for, for so long
    double pitch_rad = -0.0262, level = 0.1; ///< 1.5 degrees down; times its level

    bool operator==(const StuckSwivelParameters&) const = default;
};

/// A signal written by the drive: each value holds from its time on.
struct ScriptedSignal {
    std::string name;
    std::vector<std::pair<double, double>> values; ///< time in s, value; by time

    bool operator==(const ScriptedSignal&) const = default;
};

/// Weight added to the axles since the lamps were aimed: the body rests on its springs and tyres otherwise.
struct AxleLoad {
    double front_n = 0.0, rear_n = 0.0;

    bool operator==(const AxleLoad&) const = default;
};

struct ControlParameters {
    double period_s = 0.02; ///< of the laws
    std::optional<BendParameters> bend;
    std::optional<CorneringParameters> cornering;
    std::optional<LevellingParameters> levelling; ///< its actuator's control period is not used: the one above holds
    AxleLoad load;
    std::optional<ModeParameters> modes;
    std::optional<HighBeamParameters> high_beam;
    std::optional<GlareFreeParameters> glare_free; ///< only beside a high beam
    std::optional<ControlCameraParameters> camera;
    std::vector<PluginParameters> plugins; ///< called in this order, after the laws
    std::vector<ControlFailure> failures;
    double safe_pitch_rad = -0.01;                                               ///< of a lamp that cannot be trusted
    std::optional<StuckSwivelParameters> stuck_swivel = StuckSwivelParameters{}; ///< nullopt: nobody looks
    std::vector<ScriptedSignal> inputs;

    bool operator==(const ControlParameters&) const = default;
};

} // namespace fernlicht
