#include "scenarios/drives/staged_scene.h"

#include "scenarios/drives/advance.h"
#include "scenarios/drives/control_play.h"
#include "scenarios/drives/motion.h"
#include "scenarios/drives/own_car.h"
#include "scenarios/drives/told_story.h"
#include "scenarios/models/placed_model.h"
#include "scenarios/roads/far_ground.h"
#include "scenarios/roads/road_mesh.h"
#include "scenarios/sky/place_street_lamps.h"
#include "scenarios/traffic/place_traffic.h"
#include "scenarios/traffic/road_user_mesh.h"

namespace fernlicht {

Scene staged_scene(Drive& drive, const RoadNetwork& network, const Route& route) {
    Scene scene = build_scene(network, {.textures = drive.textured, .seed = drive.seed});
    add_scenery(scene, drive.scenery, route);
    find_street_lamps(drive, network);
    add_street_lamp_poles(drive, route, scene);
    if (drive.daylight != Daylight{})
        add_far_ground(scene);
    lay_on_route(drive, route);
    simulate_bus(drive, route);
    fit_to_route(drive, route);
    simulate(drive, route);
    place_traffic(drive, network, route);
    simulate_control(drive, route);
    add_road_users(scene, drive.traffic, drive.opened);
    add_own_car(scene, drive);
    return scene;
}

} // namespace fernlicht
