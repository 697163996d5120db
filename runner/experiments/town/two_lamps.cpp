#include "runner/experiments/town/two_lamps.h"

#include "scenarios/display/white_adaptation.h"
#include "scenarios/drives/edits/adapting_white.h"
#include "scenarios/lamps/lamp_model.h"
#include "scenarios/values/errors.h"

#include <algorithm>

namespace fernlicht {
namespace {

std::shared_ptr<const LampFile> lamp_named(const std::string& name) {
    const auto& models = lamp_models();
    if (const auto known = std::ranges::find(models, name, &LampModel::name); known != models.end())
        return std::make_shared<const LampFile>(lamp_of_model(*known));
    std::error_code ignored;
    if (!std::filesystem::exists(name, ignored))
        throw InputError({{}, 0, 0, "--low-beams"}, "found '" + printable(name) + "'",
                         "a lamp's file, or halogen-low, halogen-high, xenon-low or xenon-high");
    return std::make_shared<const LampFile>(read_lamp(name));
}

} // namespace

Moment in_two_lamps(const std::string& name, const Pose& car) {
    const std::shared_ptr<const LampFile> file = lamp_named(name);
    Moment moment;
    moment.ego = moment.wheels = car;
    for (const double y : {two_lamps_y_m, -two_lamps_y_m}) {
        MountedLamp lamp;
        lamp.name = y > 0.0 ? "left" : "right";
        lamp.position_m = {two_lamps_x_m, y, two_lamps_z_m};
        lamp.file = file;
        LitLamp lit;
        lit.name = lamp.name;
        lit.file = file;
        lit.pose = compose(car, lamp.pose());
        lit.intensity_factor = lamp.intensity_factor();
        lit.colour = colour_of_temperature(name.starts_with("xenon") ? 4300.0 : 3200.0);
        moment.lamps.push_back(std::move(lit));
    }
    return moment;
}

std::optional<glm::dmat3> white_of(const Moment& in_two_lamps) {
    Drive drive;
    LampSet& lamp_set = drive.lamp_sets.emplace_back();
    for (const LitLamp& lit : in_two_lamps.lamps) {
        MountedLamp& lamp = lamp_set.lamps.emplace_back();
        lamp.colour = lit.colour;
        lamp.file = lit.file;
    }
    close_white(drive, white_of_lamps(drive));
    return light_adaptation(drive.display.white);
}

} // namespace fernlicht
