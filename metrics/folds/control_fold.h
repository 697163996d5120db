// What lamp control does over a drive: where the lamps look, the light inside bends, reach and glare, beside the same lamps held still.
// From the lamps' tables in double, without shadows.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/readings/readings.h"
#include "scenarios/drives/play/nudge.h"

namespace fernlicht {

/// The lamp set with its lamps held still: no swivel, no levelling, no dark windows, no cornering light. Classes of the beam, levels of the
/// high beam and the load stay.
LampSet without_control(const LampSet& lamp_set);

class ControlFold {
  public:
    /// Some lamp set of the drive must have control; those without are measured too, for comparison. Drive and route must outlive the fold.
    /// `nudge`: of the lamps of the moments to come, and so of those held still.
    ControlFold(const Drive& drive, const Route& route, const Nudge& nudge = {});

    void add(const Moment& moment, const LampSet& lamp_set);
    /// control_swivel_max_deg; medians over the moments in bends (radius below 1500 m) to each side: control_left_bends_inside_at_50m_lx
    /// and its gain over lamps held still, ..._reach_5lx_m and its gain, ..._glare_at_50m_lx and its cost; shares of the time with high
    /// beam and in each class of the passing beam.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    struct Light {
        std::optional<double> inside_lx, reach_m, glare_lx, others_lx;
    };
    struct Row {
        int tick = 0;
        double along_m = 0.0;
        int bend = 0; ///< 1: to the left, -1: to the right
        Light moved, still;
        std::vector<std::optional<double>> swivel_deg, pitch_deg, level; ///< by lamp of lamps_
        std::optional<double> mode, high_beam;
    };
    Light light(const Moment& moment, double curvature_per_m) const;
    static auto change(std::optional<double> Light::*figure); ///< of a row, by control

    const Drive& drive_;
    const Route& route_;
    Nudge nudge_;
    std::vector<std::string> lamps_; ///< of all lamp sets
    std::vector<Row> rows_;
    std::shared_ptr<const LampSet> still_;
};

} // namespace fernlicht
