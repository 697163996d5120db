#include "scenarios/drives/play/bus_drive.h"

#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <stdexcept>

namespace fernlicht {
namespace {

/// Databases of the drive's bus, and the period at which it is looked at.
BusPlay live_play(Drive& drive) {
    if (!drive.can || !drive.live)
        throw std::logic_error("BusDrive: a drive that is not live");
    BusPlay play;
    play.period_s = bus_period_s(drive);
    play.databases = read_bus_databases(*drive.can, drive.opened);
    return play;
}

std::shared_ptr<BusMotion> live_motion(Drive& drive, const BusMover& mover) {
    if (!mover.moves())
        return nullptr;
    auto motion = std::make_shared<BusMotion>();
    drive.bus_motion = motion;
    return motion;
}

} // namespace

BusDrive::BusDrive(Drive& drive, const Route& route, std::size_t lamp_set)
    : drive_(drive), route_(route), lamp_set_(lamp_set), play_(live_play(drive)), bus_(*drive.can, play_.databases), mover_(drive),
      motion_(live_motion(drive, mover_)), world_(drive, route, drive.vehicle ? drive.lamp_sets.at(lamp_set).motion->car.get() : nullptr),
      control_(drive, drive.lamp_sets.at(lamp_set), world_, play_.databases) {}

void BusDrive::take(const CanFrame& frame) {
    ++play_.frames;
    bus_.take(frame);
    const double time_s = in_seconds(frame.time_ns);
    play_.first_s = play_.first_s.value_or(time_s);
    play_.last_s = time_s;
}

std::vector<CanFrame> BusDrive::fresh_frames() {
    const std::vector<CanFrame>& all = control_.sent();
    std::vector<CanFrame> fresh(all.begin() + static_cast<std::ptrdiff_t>(sent_), all.end());
    sent_ = all.size();
    return fresh;
}

std::vector<CanFrame> BusDrive::step() {
    if (done_)
        throw std::logic_error("BusDrive: a step behind the drive's end");
    const double now_s = control_.next_s();
    const std::vector<BusValue>& values = bus_.at(next_tick_ns());
    if (motion_) {
        mover_.add(now_s, values, *motion_);
        end_with_route(drive_, route_, on_route_, now_s);
    }
    play_.ticks.push_back(values);
    if (now_s < drive_.duration_s)
        control_.step(values);
    done_ = control_.next_s() >= drive_.duration_s;
    return fresh_frames();
}

std::vector<CanFrame> BusDrive::send_until(std::int64_t time_ns) {
    control_.send_until(time_ns);
    return fresh_frames();
}

int BusDrive::moments() const {
    const int all = tick_count(drive_);
    if (finished_)
        return all;
    const double settled_s = control_.next_s() - play_.period_s;
    int count = std::clamp(static_cast<int>(settled_s / drive_.step_s) + 1, 0, all);
    while (count > 0 && (count - 1) * drive_.step_s >= settled_s)
        --count;
    return count;
}

Moment BusDrive::moment(int tick) {
    if (finished_)
        return moment_at(state_at(tick, drive_), drive_, route_, drive_.lamp_sets[lamp_set_]);
    LampSet now = drive_.lamp_sets[lamp_set_];
    now.motion = std::make_shared<const Motion>(control_.at(tick * drive_.step_s));
    return moment_at(state_at(tick, drive_), drive_, route_, now);
}

void BusDrive::finish() {
    if (finished_)
        return;
    drive_.duration_s = std::min(drive_.duration_s, std::max(control_.next_s(), drive_.step_s));
    play_.read = bus_.frames_used();
    play_.records = bus_.records();
    const std::vector<std::string> notes = mover_.notes();
    drive_.notes.insert(drive_.notes.end(), notes.begin(), notes.end());
    drive_.lamp_sets[lamp_set_].motion = std::make_shared<const Motion>(control_.finish());
    drive_.bus = std::make_shared<const BusPlay>(play_);
    finished_ = done_ = true;
}

} // namespace fernlicht
