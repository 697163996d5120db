#include "scenarios/drives/play/control_play.h"

#include "scenarios/control/laws.h"
#include "scenarios/values/errors.h"
#include "scenarios/vehicle/car_model.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double mask_steps = 16.0; ///< levels of a file's windows are rounded to this part: each is a beam of its own
constexpr double max_mask_bytes = 2.0 * 1024.0 * 1024.0 * 1024.0; ///< of the beams that are drawn with, in all

/// What a beam takes when it is drawn with, here and on the GPU: a float each 0.05 degrees, or as `beams` of the drive says.
double beam_bytes(const CandelaTable& table, const std::optional<BeamTexels>& texels) {
    if (texels)
        return static_cast<double>(texels->width) * texels->height * (4.0 + texels->bits / 8.0);
    const auto steps = [](const std::vector<double>& axis) { return (std::min(axis.back(), 90.0) - std::max(axis.front(), -90.0)) / 0.05; };
    return 8.0 * std::clamp(steps(table.h_deg) * steps(table.v_deg), 4.0, 4.0 * 1024.0 * 1024.0);
}

ControlledCar controlled_car(const Drive& drive) {
    ControlledCar car{drive.wheelbase_m, 0.0};
    if (drive.vehicle) {
        CarModel model;
        model.car = *drive.vehicle;
        model.wheelbase_m = drive.wheelbase_m;
        car.self_steering_s2_per_m = model.self_steering_gradient();
    }
    return car;
}

SolverOptions actuator_options(const Drive& drive) {
    return drive.vehicle ? SolverOptions{.solver = drive.vehicle->solver, .tolerance = drive.vehicle->tolerance} : SolverOptions{};
}

std::vector<ControlledLamp> controlled_lamps(const LampSet& lamp_set) {
    std::vector<ControlledLamp> lamps;
    for (const MountedLamp& lamp : lamp_set.lamps) {
        ControlledLamp& controlled =
            lamps.emplace_back(ControlledLamp{lamp.name, lamp.position_m, lamp.mount.yaw_rad + lamp.yaw_rad + lamp.aligned.yaw_rad});
        controlled.roll_rad = lamp.mount.roll_rad + lamp.roll_rad + lamp.aligned.roll_rad;
        controlled.pitch_rad = lamp.mount.pitch_rad + lamp.pitch_rad + lamp.aligned.pitch_rad;
        if (lamp.file->pixels && !lamp.levels) {
            controlled.pixels = std::make_shared<LevelTrack>(lamp.file);
            for (std::size_t pixel = 0; pixel < lamp.file->pixels->count(); ++pixel)
                controlled.windows.push_back(lamp.file->pixels->lights(pixel));
        } else if (lamp_set.control->glare_free)
            for (const SegmentedLamp& segmented : lamp_set.control->glare_free->lamps)
                if (segmented.name == lamp.name)
                    for (const auto& [from, to] : segmented.windows_deg)
                        controlled.windows.push_back({from, to, -90.0, 90.0});
    }
    return lamps;
}

std::optional<BusWriter> bus_writer(const Drive& drive, const LampSet& lamp_set) {
    if (!drive.can || drive.can->scripted)
        return std::nullopt;
    std::vector<std::string> lamps;
    for (const MountedLamp& lamp : lamp_set.lamps)
        lamps.push_back(lamp.name);
    return BusWriter(*drive.can, lamps);
}

} // namespace

BeamMasks::BeamMasks(const Drive& drive, const LampSet& lamp_set) : drive_(drive), lamp_set_(lamp_set) {}

void BeamMasks::add(ControlRun& run) {
    if (!lamp_set_.control || !lamp_set_.control->glare_free)
        return;
    run.masks.resize(run.lamps.size());
    for (const SegmentedLamp& segmented : lamp_set_.control->glare_free->lamps) {
        if (segmented.pixels)
            continue;
        const std::size_t lamp = run.lamp(segmented.name);
        for (const auto& [from_s, exact] : run.runs[lamp].segments) {
            std::vector<double> levels;
            for (const double level : exact)
                levels.push_back(std::round(level * mask_steps) / mask_steps);
            std::shared_ptr<const LampFile>& file = known_[{lamp, levels}];
            if (!file && std::ranges::any_of(levels, [](double level) { return level != 1.0; })) {
                LampFile dark = *lamp_set_.lamps[lamp].file;
                dark.table = masked(dark.table, segmented.windows_deg, levels);
                bytes_ += beam_bytes(dark.table, drive_.beams);
                ++states_;
                if (bytes_ > max_mask_bytes)
                    throw InputError(
                        {},
                        fmt::format("more than {} states of the glare-free beam's windows, {:.0f} MiB each", states_ - 1,
                                    beam_bytes(dark.table, drive_.beams) / 1048576.0),
                        fmt::format("at most {:.0f} MiB of them in all: fewer windows, or coarser beams (beams: {{width, height, "
                                    "bits}} of the drive)",
                                    max_mask_bytes / 1048576.0));
                file = std::make_shared<const LampFile>(std::move(dark));
            }
            run.masks[lamp].emplace_back(from_s, file);
        }
    }
}

std::vector<std::string> BeamMasks::notes() const {
    if (!lamp_set_.control || !lamp_set_.control->glare_free)
        return {};
    return {fmt::format("glare-free high beam: {} states of windows, {:.0f} MiB of beams", states_, bytes_ / 1048576.0)};
}

ControlPlay::ControlPlay(const Drive& drive, const LampSet& lamp_set, const ControlWorld& world, const std::vector<CanDatabase>& databases)
    : drive_(drive), lamp_set_(lamp_set), world_(world), resting_(world.load_on_springs(lamp_set.control->load)),
      writer_(bus_writer(drive, lamp_set)),
      runner_(*lamp_set.control, controlled_lamps(lamp_set), controlled_car(drive), drive.step_s, actuator_options(drive),
              writer_ ? writer_->names() : std::vector<std::string>{}, drive.can ? listed_names(*drive.can) : std::vector<std::string>{}),
      masks_(drive, lamp_set), motion_(lamp_set.motion ? *lamp_set.motion : Motion{}) {
    if (drive.can && !drive.can->outputs.empty() && !databases.empty())
        outputs_.emplace(*drive.can, databases, runner_.signals());
}

void ControlPlay::step(const std::vector<BusValue>& values) {
    ControlInputs inputs = world_.at(runner_.next_s(), *lamp_set_.control);
    if (writer_ && !values.empty())
        inputs.written = writer_->at(values);
    const std::int64_t now_ns = std::llround(1.0e9 * inputs.time_s);
    send_until(now_ns - 1);
    runner_.step(inputs);
    if (outputs_)
        outputs_->set(runner_.signals());
    send_until(now_ns);
}

void ControlPlay::send_until(std::int64_t time_ns) {
    if (!outputs_)
        return;
    const std::vector<CanFrame> frames = outputs_->due(time_ns);
    motion_.sent.insert(motion_.sent.end(), frames.begin(), frames.end());
}

std::int64_t ControlPlay::next_output_ns() const { return outputs_ ? outputs_->next_ns() : std::numeric_limits<std::int64_t>::max(); }

Motion ControlPlay::at(double time_s) {
    Motion now{motion_.car, motion_.levelling, motion_.swivel, runner_.at(time_s), {}, {}};
    now.control->body_pitch_rad = resting_.body_pitch_rad;
    now.control->rear_lift_m = resting_.rear_lift_m;
    masks_.add(*now.control);
    return now;
}

Motion ControlPlay::finish() {
    // Frames of the last period: the drive's end itself is no part of it.
    send_until(std::llround(1.0e9 * drive_.duration_s) - 1);
    motion_.control = runner_.finish(drive_.duration_s);
    ControlRun& run = *motion_.control;
    run.body_pitch_rad = resting_.body_pitch_rad;
    run.rear_lift_m = resting_.rear_lift_m;
    masks_.add(run);
    motion_.notes.push_back(fmt::format("lamp control: {} ticks of {:g} ms", run.ticks, 1e3 * run.period_s));
    motion_.notes.insert(motion_.notes.end(), run.notes.begin(), run.notes.end());
    for (const std::vector<std::string>& notes : {masks_.notes(), outputs_ ? outputs_->notes() : std::vector<std::string>{}})
        motion_.notes.insert(motion_.notes.end(), notes.begin(), notes.end());
    return std::move(motion_);
}

void simulate_control(Drive& drive, const Route& route) {
    if (drive.live || std::ranges::none_of(drive.lamp_sets, [](const LampSet& lamp_set) { return lamp_set.control != nullptr; }))
        return;
    const std::shared_ptr<const CarRun> car = drive.vehicle ? drive.lamp_sets.front().motion->car : nullptr;
    const ControlWorld world(drive, route, car.get());
    const std::vector<CanDatabase> databases = drive.bus                                  ? drive.bus->databases
                                               : drive.can && !drive.can->outputs.empty() ? read_bus_databases(*drive.can, drive.opened)
                                                                                          : std::vector<CanDatabase>{};
    for (LampSet& lamp_set : drive.lamp_sets) {
        if (!lamp_set.control)
            continue;
        try {
            ControlPlay play(drive, lamp_set, world, databases);
            for (std::size_t tick = 0; play.next_s() < drive.duration_s; ++tick)
                play.step(drive.bus ? drive.bus->ticks[tick] : std::vector<BusValue>{});
            lamp_set.motion = std::make_shared<const Motion>(play.finish());
            if (const std::optional<InputError>& unusable = lamp_set.motion->control->unusable)
                throw InputError(*unusable);
        } catch (const InputError& error) {
            if (!error.where().file.empty())
                throw;
            throw InputError({drive.file, 0, 0, fmt::format("control of '{}'", lamp_set.name)}, error.what());
        }
    }
}

} // namespace fernlicht
