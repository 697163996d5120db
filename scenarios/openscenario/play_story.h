// Plays a storyboard by fixed steps: the same file on the same road gives the same bytes.
#pragma once

#include "scenarios/openscenario/played_story.h"
#include "scenarios/roads/road_network.h"

namespace fernlicht::osc {

struct PlayStoryOptions {
    double step_s = 0.01;
    double most_s = 60.0;  ///< longest time played
    double day_rate = 1.0; ///< seconds of an animated time of day for one of the story; conditions of the time of day go by it
};

/// From init to the stop trigger, to where all stories are over (in a storyboard that has some), or for `most_s`. Without a controller
/// entities move by their actions, else along their lane at their speed. Throws InputError with file and line for positions that are not
/// on the road. The network may be empty: then only positions of the world can be placed.
PlayedStory play_story(const Storyboard& storyboard, const RoadNetwork& network, const PlayStoryOptions& options = {});

} // namespace fernlicht::osc
