#include "scenarios/drives/play/staged_scene.h"

#include "scenarios/drives/play/advance.h"
#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/motion.h"
#include "scenarios/drives/play/own_car.h"
#include "scenarios/drives/play/place_street_lamps.h"
#include "scenarios/drives/play/place_traffic.h"
#include "scenarios/drives/play/told_story.h"
#include "scenarios/models/placed_model.h"
#include "scenarios/roads/mesh/far_ground.h"
#include "scenarios/roads/mesh/road_mesh.h"
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
