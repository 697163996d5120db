// An adaptive driving beam in the laboratory, modelled on FMVSS 108 S9.4.1.6.4.3 to 5: where it is dimmed for others the points of the
// lower beam's table hold (XIX), elsewhere those of the upper beam's (XVIII), and between both a transition zone is exempt but for the
// greatest intensity that XVIII allows at H-V, which holds in it alone.
#pragma once

#include "metrics/regulation/regulation.h"
#include "scenarios/control/laws.h"
#include "scenarios/lamps/pixel_lamp.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// Widest transition zone, degrees: S9.4.1.6.4.5.
inline constexpr double transition_zone_deg = 1.0;

/// The table for a beam in one state, with the rows of `lower` and `upper`, ids of tables of FMVSS 108, that its two areas meet. Points
/// count on the border of `dimmed`, which is in the aimed lamp's angles; segments and rectangles are cut to it. Throws InputError for an id
/// of another family, std::logic_error for an area that is none.
Regulation fmvss108_adaptive(const AngleBox& dimmed, const std::string& lower, const std::string& upper);

/// What a list of tables says of it: its rows follow from where the beam is dimmed.
Regulation fmvss108_adaptive_without_rows();

/// How a lamp of pixels spares one other road user, by the law that drives have (LampWindows, without delay). nullopt: no pixel meets it.
struct SparingState {
    std::vector<float> levels; ///< by pixel: dark where it meets the other, with the margin to each side
    AngleBox spared;           ///< the other itself, which is what is to be dimmed: the margin is part of the transition
};
std::optional<SparingState> sparing_state(const PixelLamp& lamp, const OtherUser& other, const LampPlace& from, double margin_deg);

} // namespace fernlicht
