// The straight and level road with one lamp of the same intensity in every direction, where every place is known by hand.
#pragma once

#include "metrics/folds/seeing_fold.h"
#include "scenarios/drives/play/advance.h"
#include "tests/lamps.h"

#include <filesystem>
#include <stdexcept>

namespace fernlicht {

/// The lamp of `cd` is 0.65 m up, on the bumper; rear axle 20 m along the road at first, 10 m/s, ten moments a second; the driver's eye 1.3
/// m before the rear axle, 0.35 m left, 1.2 m up.
struct OneLampStraight {
    Drive drive = read_drive(std::filesystem::path(FERNLICHT_SOURCE_DIR) / "scenarios/library/drives/straight.yaml");
    RoadNetwork network = read_opendrive(drive.road_file);
    Route route{network, drive.start, drive.via};

    explicit OneLampStraight(double cd = 1000.0, double duration_s = 12.0) {
        drive.speed = {{0.0, 10.0}};
        drive.step_s = 0.1;
        drive.duration_s = duration_s;
        MountedLamp lamp;
        lamp.name = "only";
        lamp.file = tests::file_of(tests::even_table(cd));
        lamp.position_m = {drive.bumper_m, 0.0, 0.65};
        lamp.colour.sp_ratio = 1.5;
        drive.lamp_sets.front().lamps = {lamp};
        drive.lamp_sets.front().changes.clear();
    }
    SeeingFold played() const {
        SeeingFold fold(drive, route);
        State state = start(drive);
        for (int tick = 0; tick < tick_count(drive); ++tick, state = advance(state, drive))
            fold.add(moment_at(state, drive, route, drive.lamp_sets.front()), drive.lamp_sets.front());
        return fold;
    }
};

inline Reading named(const Readings& readings, const std::string& name) {
    for (const Reading& reading : readings)
        if (reading.name() == name)
            return reading;
    throw std::runtime_error("no reading " + name);
}

/// Throws where it is not measured.
inline double value(const Readings& readings, const std::string& name) {
    const Reading reading = named(readings, name);
    if (!reading.value.number())
        throw std::runtime_error(name + ": " + reading.value.reason());
    return *reading.value.number();
}

} // namespace fernlicht
