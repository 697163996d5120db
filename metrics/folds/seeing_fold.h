// All that a drive measures of seeing, glare and lamp control, folded over its moments. By the twin alone: nothing is drawn for it.
#pragma once

#include "metrics/folds/control_fold.h"
#include "metrics/folds/glare_fold.h"
#include "metrics/folds/homogeneity_fold.h"
#include "metrics/folds/place_fold.h"
#include "metrics/folds/visibility_fold.h"
#include "metrics/readings/readings.h"
#include "scenarios/drives/play/nudge.h"

namespace fernlicht {

/// Some of it needs every moment, for what is largest or smallest; visibility and evenness, which take the most time, are medians.
enum class SeeingPart { all, of_every_moment, medians };

class SeeingFold {
  public:
    /// Drive and route must outlive the fold. Every moment's lamps are nudged. Throws InputError for places beyond the route's end.
    SeeingFold(const Drive& drive, const Route& route, const Nudge& nudge = {}, SeeingPart part = SeeingPart::all);

    /// `lamp_set`: the one that the moment is of; lamp control asks for it, and what dazzled drivers are adapted to. The same in every
    /// call.
    void add(const Moment& moment, const LampSet& lamp_set);
    /// Nothing where the drive asks for nothing. Names do not depend on what was added.
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    Nudge nudge_;
    std::optional<SensorFold> sensors_;
    std::optional<OncomingFold> oncoming_;
    std::optional<MirrorFold> mirrors_;
    std::optional<TrafficFold> traffic_;
    std::optional<VisibilityFold> visibility_;
    std::optional<HomogeneityFold> homogeneity_;
    std::optional<PlaceFold> places_;
    std::optional<ControlFold> control_; ///< where some lamp set has lamp control
};

} // namespace fernlicht
