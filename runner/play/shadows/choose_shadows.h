// `shadows: auto`: the cheapest method that is accurate enough, found on the drive itself.
#pragma once

#include "renderer/device.h"
#include "renderer/renderer.h"
#include "runner/play/play.h"
#include "runner/play/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// What trying one method came to.
struct TriedShadows {
    ShadowMethod method = ShadowMethod::none;
    std::optional<double> error; ///< worst picture: share of what is lit without shadows, by 0.05 lx or more, that is wrongly lit or dark
    double worst_s = 0.0;        ///< at this time
    std::string worst_set;       ///< with this lamp set
    std::string worst_view;      ///< in this view
    int pictures = 0;            ///< held against rays, until the first that was too wrong
    std::string refused;         ///< why it draws nothing of this drive; "" where it does
};

struct ShadowChoice {
    ShadowMethod chosen = ShadowMethod::none;
    double bound = 0.0;                ///< what the drive asks for
    std::vector<TriedShadows> tried;   ///< cheapest first, up to the one chosen; all where none is right enough
    int ticks = 0, ticks_shadowed = 0; ///< moments of all lamp sets, and those in which something stands in a beam
    int compared = 0;                  ///< of the latter, those that a method must pass
    std::string why;                   ///< a clause: "the cheapest whose error stays within 1 %: 0.31 % in the worst of 256 pictures"
};

/// The order in which methods are tried: by what they cost a frame (docs/shadows.md has the figures). All but `automatic`.
std::vector<ShadowMethod> shadow_methods_by_cost();

/// Decides a drive's `shadows: auto`, in this order:
/// 1. In which moments does anything stand in a beam of the own or of others' lamps, or in the light of sun or moon? In none: `none`.
/// 2. Of these moments up to 64 a lamp set, evenly spread (fewer where there are many lamp sets and views: 256 pictures in all), are
///    drawn in every view of the drive, about 160 x 120 pixels large, by one method after the other, cheapest first, and held against a
///    ray from each pixel to each lamp (shadow_truth.h), where there would be 0.05 lx or more without shadows: first eight of each lamp set
///    and view and those that ruled out another method, then the others, until one is wrong by more than the bound.
/// 3. The first method that stays within the bound in all of them is taken. Where none does, the one that errs least in those of the first
///    sort is, and a note says so. Between these moments a method may err by more.
/// No clock decides: the same drive gives the same choice. Sets stage.drive.shadows.method, adds a note, and returns what was found;
/// nullopt where the drive names its method.
std::optional<ShadowChoice> choose_shadows(Stage& stage, Device& device, const RendererSettings& settings);

/// For programs that do not know the drive beforehand. Throws InputError for `auto`.
void refuse_auto_shadows(const Drive& drive);

/// Throws InputError, at the line of the drive's file that asks for it, where ground in the lamps' light is not one plane in one of these
/// moments with any of the drive's lamp sets. Drives that do not draw by `planar` cost nothing.
void check_planar_shadows(const Stage& stage, Device& device, TickRange ticks = {});
/// The same of these moments alone.
void check_planar_shadows(const Stage& stage, Device& device, const std::vector<Moment>& moments);

} // namespace fernlicht
