#include "runner/experiments/accuracy/lamp_discs.h"

#include "renderer/technique.h"

namespace fernlicht {

double lamp_disc_radius_m(const Drive& drive) {
    const Technique& technique = technique_named(drive.technique, drive.file);
    const bool draws_it = technique.kind == TechniqueKind::ours && technique.name != "photometric-naive";
    return draws_it && drive.shadows.method == ShadowMethod::soft_map ? drive.shadows.lamp_radius_m : 0.0;
}

} // namespace fernlicht
