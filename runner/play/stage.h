// Everything in a drive that is the same for all its lamp sets: read and checked before the first frame.
#pragma once

#include "scenarios/drives/play/moment.h"
#include "scenarios/values/scene.h"

namespace fernlicht {

struct Stage {
    Drive drive;
    RoadNetwork network;
    Route route; ///< points into `network`: a stage stays where it was made
    Scene scene;

    /// Aims the drive's lamps. Throws InputError for what its road, route, technique or lamps lack.
    explicit Stage(Drive drive);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
};

/// Of a drive that has no stage, told by EachRead: what its lamps, its route and its readings lack, each by itself. Readings are judged on
/// a straight road where the route cannot be found.
void refuse_each(Drive drive);

/// The side of the road on which the route begins to drive.
bool left_hand_traffic(const Stage& stage);

/// The moments at these ticks, which rise.
std::vector<Moment> moments_at(const std::vector<int>& ticks, const Stage& stage, const LampSet& lamp_set);

/// The drive's lamp set of that name, the first for "". Throws InputError that names --lamp-set.
const LampSet& lamp_set_of(const Drive& drive, const std::string& name);

/// The view at another size, with the same field of view upwards.
View at_size(View view, int width_px, int height_px);

/// Adds what is not there yet, by path.
void add_inputs(FilesRead& all, const FilesRead& more);

} // namespace fernlicht
