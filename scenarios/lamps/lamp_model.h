// A small model of headlamps: the parts of a beam, a cut-off line and the glow above it. It made the lamps in scenarios/library/lamps.
// Light with the shape, the sums and the limits of real lamps, but of no real lamp: a model, not a measurement.
#pragma once

#include "scenarios/lamps/lamp_file.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// One patch of light, bell-shaped: full in its middle, about 0.61 of it one width away.
struct BeamPart {
    double peak_cd = 0.0;
    double h_deg = 0.0;                      ///< middle, right positive
    double left_deg = 1.0, right_deg = 1.0;  ///< widths
    double depth_deg = 0.0;                  ///< middle, below the part's upper line
    double above_deg = 1.0, below_deg = 1.0; ///< widths
    double follows_rise = 0.0;               ///< 0: its upper line is level; 1: it is the cut-off line with its rise to the kerb
};

/// The upper edge of a low beam, right-hand traffic: level on the left, from the kink on rising to the right.
struct CutOff {
    double level_deg = 0.0; ///< V of the level part. Regulations measure with it at -0.57 (1 % down)
    double kink_h_deg = 0.0;
    double rise_slope = 0.0;      ///< tangent of the rise
    double rise_ends_h_deg = 8.0; ///< from here on the edge sinks back; also the width over which it does
    double top_deg = 0.0;         ///< V towards which the rise flattens
    double softness_deg =
        0.1;              ///< width of the transition in log intensity; sharpness G is about (decades across the edge) * 0.025 / softness
    double glow_cd = 0.0; ///< scattered light just above the edge
    double glow_h_deg = 1.0, glow_v_deg = 1.0; ///< its widths

    double line_deg(double h_deg, double kink_deg) const; ///< V of the edge, its kink rounded over kink_deg of H
    double glow(double h_deg, double v_deg) const;
};

struct LampModel {
    std::string name;  ///< "halogen-low"
    std::string title; ///< "halogen low beam, model"
    std::string meets; ///< which rows its table is held to
    std::vector<BeamPart> parts;
    std::optional<CutOff> cut_off; ///< nullopt: high beam
};

/// "halogen-low", "halogen-high", "xenon-low", "xenon-high".
const std::vector<LampModel>& lamp_models();

/// Intensity in cd. Zero outside |H| < 52, -21 < V < 16 degrees, falling there smoothly.
double model_intensity_cd(const LampModel& model, double h_deg, double v_deg);

/// The model sampled on axes that are fine (0.05 degrees in V, 0.1 in H) round the cut-off and the kink and coarse elsewhere,
/// rounded to 0.1 cd, so that every machine writes the same file.
LampFile lamp_of_model(const LampModel& model);

} // namespace fernlicht
