#include "scenarios/drives/play/bus_recording.h"

#include "scenarios/can/candump_log.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/control_play.h"
#include "scenarios/drives/play/motion.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// The first lamp that is not named itself stands for all where a mapping says so.
std::string one_signal(const std::string& name, const LampSet& lamp_set, const BusMapping& mapping) {
    if (name.find('*') == std::string::npos || lamp_set.lamps.empty())
        return name;
    for (const MountedLamp& lamp : lamp_set.lamps)
        if (std::ranges::find(mapping.inputs, of_lamp(name, lamp.name), &BusInput::name) == mapping.inputs.end())
            return of_lamp(name, lamp.name);
    return of_lamp(name, lamp_set.lamps.front().name);
}

/// physical = (value - offset) / factor.
BusOutput turned_round(const BusInput& input, const BusSource& source, const std::string& name, double period_s,
                       const std::vector<CanDatabase>& databases) {
    BusOutput output;
    output.target = source;
    output.name = name;
    output.values = input.values;
    output.opposite = input.opposite;
    output.where = input.where;
    if (input.factor || input.offset) {
        output.factor = 1.0 / input.factor.value_or(1.0);
        output.offset = -input.offset.value_or(0.0) * *output.factor;
    }
    const CanMessage* message = nullptr;
    for (const CanDatabase& database : databases)
        message = message ? message : database.message(source.message);
    if (message && !(message->cycle_s && *message->cycle_s > 0.0))
        output.cycle_s = period_s;
    return output;
}

} // namespace

std::vector<CanFrame> recorded_inputs(const Drive& drive, const Route& route, const LampSet& lamp_set, FilesRead& opened,
                                      std::vector<std::string>& notes) {
    if (!drive.can || drive.can->inputs.empty())
        throw InputError({drive.file, 0, 0, "can.inputs"}, "found a drive without signals from a bus", "some to be recorded");
    const std::vector<CanDatabase> databases = read_bus_databases(*drive.can, opened);
    const ControlWorld world(drive, route, lamp_set.motion ? lamp_set.motion->car.get() : nullptr);
    ControlPlay play(drive, lamp_set, world);
    BusMapping mapping;
    mapping.channel = drive.can->channel;
    for (const BusInput& input : drive.can->inputs) {
        const std::string name = one_signal(input.name, lamp_set, *drive.can);
        mapping.outputs.push_back(turned_round(input, input.source, name, lamp_set.control->period_s, databases));
        if (input.also)
            mapping.outputs.push_back(turned_round(input, *input.also, name, lamp_set.control->period_s, databases));
    }
    BusOutputs outputs(mapping, databases, play.signals());
    std::vector<CanFrame> frames;
    const auto add = [&](std::int64_t until_ns) {
        const std::vector<CanFrame> due = outputs.due(until_ns);
        frames.insert(frames.end(), due.begin(), due.end());
    };
    while (play.next_s() < drive.duration_s) {
        const std::int64_t now_ns = std::llround(1.0e9 * play.next_s());
        add(now_ns - 1);
        play.step();
        outputs.set(play.signals());
        add(now_ns);
    }
    add(std::llround(1.0e9 * drive.duration_s) - 1);
    notes = outputs.notes();
    return frames;
}

std::string output_log(const Drive& drive, const LampSet& lamp_set) {
    std::string text;
    if (!lamp_set.motion)
        return text;
    for (CanFrame frame : lamp_set.motion->sent) {
        frame.time_ns += drive.bus ? drive.bus->start_ns : 0;
        text += candump_line(frame) + '\n';
    }
    return text;
}

} // namespace fernlicht
