// A reading's value in one moment where that is more than the light at a place or where a line of light ends: by the metric's own
// function, and by the chain rule through it. Places are found once; the light there is the moment's, whatever tables its lamps have.
#pragma once

#include "metrics/folds/homogeneity_fold.h"
#include "metrics/folds/target_squares.h"
#include "metrics/road/extent.h"
#include "scenarios/light/light_gradient.h"

#include <memory>

namespace fernlicht {

class MomentFigure {
  public:
    MomentFigure() = default;
    MomentFigure(const MomentFigure&) = delete;
    MomentFigure& operator=(const MomentFigure&) = delete;
    virtual ~MomentFigure() = default;
    /// Of the moment that it was made for, perhaps with other tables.
    virtual Value value(const Moment& moment) const = 0;
    /// Adds d value() / d cd times `weight`. Where the value is a number.
    virtual void add_gradient(BeamGradient& gradient, const Moment& moment, double weight) const = 0;
};
/// nullptr: the moment has no such figure.
using MomentFigurePointer = std::shared_ptr<const MomentFigure>;

/// Evenness of the own lane: gradient_per_m, gradient_per_deg, foreground, foreground_ratio or uniformity (homogeneity.h). A steepest
/// gradient answers to the two points between which it is, the smallest light of a uniformity to its own.
MomentFigurePointer evenness_figure(const ReadingKey& key, const HomogeneityParameters& asked, const Drive& drive, const Route& route,
                                    const Moment& moment);

/// A point of a grid as an illuminance on it is measured.
LightPlace surface_place(const ExtentGrid& grid, std::size_t point, Surface surface);

/// Lit area of one lane (lit_road.h), over the cells that its isolux line crosses.
MomentFigurePointer area_figure(const ReadingKey& key, const ExtentParameters& asked, const Drive& drive, const Route& route,
                                const Moment& moment);

/// How far ahead a target is detected, or how visible it is at the key's distance (target_squares.h), in clear air on a dry road. A level
/// answers to the light on the clearest square, to the luminance of the road behind it, and to that which the eye is adapted to; the
/// distance to the levels on both sides of where it ends.
MomentFigurePointer sight_figure(const ReadingKey& key, const VisibilityTarget& target, Across across, const VisibilityParameters& asked,
                                 const Drive& drive, const Route& route, const Moment& moment);

/// Of an eye that looks along the place's normal (glare.h), adapted to what it is adapted to now, whatever the lamps: veiling luminance and
/// threshold increment, each lamp's light there times what its angle makes of it, or de Boer's rating of that sum. Not measured without a
/// reason where the moment does not count for it.
MomentFigurePointer glare_figure(Quantity quantity, const LightPlace& eye, const GlareParameters& parameters, const Value& adaptation_cdm2);

/// The share of a limit (> 0) that light at a place leaves, per cent; negative above it.
MomentFigurePointer margin_figure(const LightPlace& place, double limit_lx);

} // namespace fernlicht
