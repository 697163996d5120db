// What a drive measures beyond extents and probes: light at fixed places that the car drives up to, and what it does to the eyes of others.
#pragma once

#include "scenarios/drives/tolerance_parameters.h"

#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Where across the road: edges of the driving lanes as the driver sees them, centres of the own lane and of the nearest oncoming one.
enum class Across { own_centre, oncoming_centre, right_edge, left_edge };

/// A place beside or above the road at which illuminance is followed while the car comes nearer.
struct Sensor {
    std::string name;
    double at_m = 0.0; ///< along the route from its start
    Across across = Across::own_centre;
    double above_m = 0.25; ///< above the road's surface

    bool operator==(const Sensor&) const = default;
};

struct SensorParameters {
    std::vector<double> thresholds_lx{1.0, 3.0, 5.0, 10.0};
    std::vector<double> distances_m{25.0, 50.0, 75.0, 100.0, 150.0}; ///< from the front bumper, at which the illuminance is told
    std::vector<Sensor> points;

    bool operator==(const SensorParameters&) const = default;
};

/// An oncoming driver who stands still on the centre of the nearest oncoming lane and looks along it.
struct GlareObserver {
    std::string name;
    double at_m = 0.0; ///< along the route from its start
    double eye_height_m = 1.1;
    double look_ahead_m = 0.0; ///< where on the lane the eye looks: so far along it, at its own height; 0: along the lane's tangent

    bool operator==(const GlareObserver&) const = default;
};

struct Mirror {
    std::string name;
    glm::dvec3 position_m{0.0}; ///< in the frame of its car: x forward from the rear axle, y left, z up from the road

    bool operator==(const Mirror&) const = default;
};

/// A car ahead in the own lane, whose driver has this car's lamps in the mirrors: as this car's driver has those of a follower with the
/// same lamps.
struct MirrorParameters {
    std::vector<double> gaps_m{15.0, 30.0, 60.0, 100.0}; ///< from the front bumper to the rear axle of the car ahead
    glm::dvec3 eye_m{1.3, 0.35, 1.2};
    double reflectance = 0.8;
    std::vector<Mirror> mirrors{{"left", {1.9, 0.95, 1.0}}, {"inside", {1.85, 0.0, 1.3}}, {"right", {1.9, -0.95, 1.0}}};

    bool operator==(const MirrorParameters&) const = default;
};

enum class VeilingEquation { stiles_holladay, age_adjusted, cie_general };

/// A low beam for the dazzled driver's own car.
struct AdaptationLamp {
    std::filesystem::path file;
    bool mirrored = false; ///< left and right exchanged

    bool operator==(const AdaptationLamp&) const = default;
};

struct GlareParameters {
    std::vector<GlareObserver> oncoming;
    std::optional<MirrorParameters> mirrors;
    VeilingEquation equation = VeilingEquation::cie_general;
    double age_years = 25.0;
    double pigmentation = 0.5;
    std::optional<double> adaptation_cdm2; ///< nullopt: of his own lane in his own low beams (metrics/folds/adaptation.h)
    std::vector<double> distances_m{25.0, 50.0, 75.0, 100.0, 150.0}; ///< from the front bumper
    std::vector<double> thresholds_lx{0.5, 1.0, 3.0};                ///< of illuminance facing the lamps, for times above them
    std::vector<double> thresholds_percent{10.0};                    ///< of the threshold increment
    std::vector<double> thresholds_de_boer{5.0, 3.0};                ///< for times below them
    /// Edges of ranges before an oncoming driver, from the front bumper: each from one to the next.
    std::vector<double> ranges_m{15.0, 30.0, 60.0, 120.0, 220.0};
    std::optional<AdaptationLamp> adaptation_lamp; ///< in place of each low beam of the drive; nullopt: these

    bool operator==(const GlareParameters&) const = default;
};

/// Squares of one size and reflectance, one on the other, that stand on the road and face the car: a card, or a person's column of
/// segments.
struct VisibilityTarget {
    std::string name;
    double size_m = 0.2; ///< edge of a square
    int squares = 1;
    double reflectance = 0.2; ///< diffuse
    double level = 7.0;       ///< visibility level at which it counts as detected: its clearest square has it
    std::vector<Across> places{Across::own_centre};

    bool operator==(const VisibilityTarget&) const = default;
};

/// "card", "pedestrian-dark", "pedestrian-light" (docs/seeing.md has their sources).
const std::vector<VisibilityTarget>& default_targets();

/// Targets, and who looks for them.
struct VisibilityParameters {
    std::vector<VisibilityTarget> targets = default_targets();
    double dark_cdm2 = 0.001; ///< luminance of what is not road behind a target, without daylight
    double age_years = 25.0;
    double time_s = 0.2; ///< for which a target shows
    double k = 2.6;
    double ahead_m = 200.0; ///< how far is looked, from the front bumper
    double step_m = 1.0;
    std::vector<double> distances_m{25.0, 50.0, 75.0, 100.0}; ///< from the front bumper, at which level and background are told

    bool operator==(const VisibilityParameters&) const = default;
};

struct HomogeneityParameters {
    double min_lx = 1.0;   ///< darker ground does not count
    double ahead_m = 80.0; ///< how far is looked, from the front bumper
    double patch_factor = 1.5;
    std::vector<double> distances_m{20.0, 50.0}; ///< from the front bumper, where evenness across is told

    bool operator==(const HomogeneityParameters&) const = default;
};

struct PlaceParameters {
    bool kerb = false, boards = false, markings = false;
    std::vector<double> distances_m{25.0, 50.0, 75.0, 100.0, 150.0}; ///< from the front bumper

    bool operator==(const PlaceParameters&) const = default;
};

/// Off, all of it, unless a drive asks.
struct SeeingParameters {
    std::optional<SensorParameters> sensors;
    std::optional<GlareParameters> glare;
    std::optional<VisibilityParameters> visibility;
    std::optional<HomogeneityParameters> homogeneity;
    std::optional<PlaceParameters> places;
    std::optional<ToleranceParameters> tolerances; ///< what all of it, reach and width come to in other cars of the series

    bool operator==(const SeeingParameters&) const = default;
};

} // namespace fernlicht
