#include "scenarios/lamps/lamp_change.h"

namespace fernlicht {

void apply(const LampChange& change, MountedLamp& lamp) {
    lamp.level = change.level.value_or(lamp.level);
    lamp.pitch_rad = change.pitch_rad.value_or(lamp.pitch_rad);
    lamp.yaw_rad = change.yaw_rad.value_or(lamp.yaw_rad);
    lamp.roll_rad = change.roll_rad.value_or(lamp.roll_rad);
    lamp.file = change.file ? change.file : lamp.file;
    lamp.colour = change.colour.value_or(lamp.colour);
    lamp.source = change.source.value_or(lamp.source);
}

} // namespace fernlicht
