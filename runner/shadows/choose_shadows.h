// `shadows: auto`: the cheapest method that is right enough, found out on the drive itself.
#pragma once

#include "renderer/renderer.h"
#include "runner/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// What trying one method came to.
struct TriedShadows {
    ShadowMethod method = ShadowMethod::none;
    std::optional<double> error; ///< worst moment: share of what is lit without shadows that is wrongly lit or wrongly dark
    double worst_s = 0.0;        ///< at this time
    std::string worst_set;       ///< with this lamp set
    std::string refused;         ///< why it draws nothing of this drive; "" where it does
};

struct ShadowChoice {
    ShadowMethod chosen = ShadowMethod::none;
    double bound = 0.0;                ///< what the drive asks for
    std::vector<TriedShadows> tried;   ///< cheapest first, up to the one chosen; all where none is right enough
    int ticks = 0, ticks_shadowed = 0; ///< moments of all lamp sets, and those in which something stands in a beam
    int compared = 0;                  ///< of the latter, drawn and held against rays
    std::string why;                   ///< a clause: "the cheapest whose error stays below 1 %: 0.31 %"
};

/// The order in which methods are tried: by what they cost a frame (docs/shadows.md has the figures). All but `automatic`.
std::vector<ShadowMethod> shadow_methods_by_cost();

/// Decides a drive's `shadows: auto`, in this order:
/// 1. In which moments does anything stand in a beam of the own or of others' lamps, or in the light of sun or moon? In none: `none`.
/// 2. Up to 8 of these moments a lamp set, evenly spread, are drawn in the driver's view 160 pixels wide by one method after the other,
///    cheapest first, and held against a ray from each pixel to each lamp (shadow_truth.h).
/// 3. The first method whose worst moment stays within the bound is taken. Where none does, the one with the least error is, and a note
///    says so.
/// No clock decides: the same drive gives the same choice. Sets stage.drive.shadows.method, adds a note, and returns what was found;
/// nullopt where the drive names its method. Throws InputError where there is no driver's view.
std::optional<ShadowChoice> choose_shadows(Stage& stage, Device& device, const RendererSettings& settings);

/// For programs that do not know the drive beforehand. Throws InputError for `auto`.
void refuse_open_shadows(const Drive& drive);

} // namespace fernlicht
