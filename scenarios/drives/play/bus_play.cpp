#include "scenarios/drives/play/bus_play.h"

#include "scenarios/can/candump_stream.h"
#include "scenarios/control/control_parameters.h"
#include "scenarios/drives/play/advance.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace fernlicht {

std::size_t BusMotion::point_at(double time_s) const {
    const auto next = std::ranges::upper_bound(points_, time_s, {}, &Point::time_s);
    return next == points_.begin() ? 0 : static_cast<std::size_t>(next - points_.begin()) - 1;
}

void BusMotion::add(double time_s, double speed_mps, std::optional<double> route_distance_m) {
    if (route_distance_m) {
        way_told_ = true;
        points_.push_back({time_s, speed_mps, *route_distance_m});
        return;
    }
    const std::size_t n = points_.size();
    if (n >= 2 && points_[n - 1].speed_mps == speed_mps && points_[n - 2].speed_mps == speed_mps)
        points_.pop_back();
    const double before_m = points_.empty() ? 0.0 : points_.back().route_distance_m;
    const double ridden_m = points_.empty() ? 0.0 : (time_s - points_.back().time_s) * 0.5 * (points_.back().speed_mps + speed_mps);
    points_.push_back({time_s, speed_mps, before_m + ridden_m});
}

double BusMotion::speed_mps(double time_s) const {
    const std::size_t at = point_at(time_s);
    const Point& before = points_[at];
    if (at + 1 == points_.size() || time_s <= before.time_s)
        return before.speed_mps;
    const Point& next = points_[at + 1];
    return std::lerp(before.speed_mps, next.speed_mps, (time_s - before.time_s) / (next.time_s - before.time_s));
}

double BusMotion::route_distance_m(double time_s) const {
    const std::size_t at = point_at(time_s);
    const Point& before = points_[at];
    if (!way_told_)
        return before.route_distance_m + (time_s - before.time_s) * 0.5 * (before.speed_mps + speed_mps(time_s));
    if (at + 1 == points_.size())
        return before.route_distance_m;
    const Point& next = points_[at + 1];
    return std::lerp(before.route_distance_m, next.route_distance_m, (time_s - before.time_s) / (next.time_s - before.time_s));
}

std::vector<SpeedPoint> BusMotion::profile() const {
    std::vector<SpeedPoint> profile;
    for (const Point& point : points_)
        profile.push_back({point.time_s, point.speed_mps});
    return profile;
}

namespace {

constexpr double shortest_gap_s = 0.1; ///< a recording that ends so much before the drive says so

/// "can0 (12 frames), can1 (3 frames)"
std::string channels_text(const std::vector<CanFrame>& frames) {
    constexpr std::size_t max_named = 8;
    std::map<std::string, std::size_t> counts;
    for (const CanFrame& frame : frames)
        ++counts[frame.channel];
    std::string text;
    std::size_t named = 0;
    for (const auto& [channel, count] : counts)
        if (named++ < max_named)
            text += fmt::format("{}{} ({} frame{})", text.empty() ? "" : ", ", printable(channel), count, count == 1 ? "" : "s");
    return counts.size() > max_named ? fmt::format("{} and {} more", text, counts.size() - max_named) : text;
}

/// A recording of another car, or of another bus, would leave every signal to its policy.
void refuse_foreign(const BusMapping& mapping, const std::filesystem::path& log, const std::vector<CanFrame>& frames) {
    if (!mapping.channel.empty() && std::ranges::find(frames, mapping.channel, &CanFrame::channel) == frames.end())
        throw InputError({log, 0, 0, {}},
                         fmt::format("found no frame of channel '{}', but {}", printable(mapping.channel), channels_text(frames)),
                         "a channel of the recording (can.channel or --can-channel)");
    if (mapping.inputs.empty())
        return;
    FilesRead read_twice;
    BusSignals signals(mapping, read_bus_databases(mapping, read_twice));
    for (const CanFrame& frame : frames) {
        const std::uint64_t before = signals.frames_used();
        signals.take(frame);
        if (signals.frames_used() > before &&
            std::ranges::any_of(signals.records(), [](const BusRecordOfInput& record) { return record.frames > 0; }))
            return;
    }
    throw InputError({log, 0, 0, {}},
                     signals.frames_used() == 0
                         ? fmt::format("found no frame with an identifier that can.inputs read, but {}", channels_text(frames))
                         : fmt::format("found {} frames that can.inputs read, all too short for their signals", signals.frames_used()),
                     "a recording of the bus that the drive's databases describe");
}

/// Frames of the recording, stamped from the drive's 0 s.
std::vector<CanFrame> frames_of(Drive& drive, BusPlay& play) {
    const BusMapping& mapping = *drive.can;
    std::vector<CanFrame> frames = read_bus_recording(drive, *mapping.log, play.start_ns);
    play.first_s = in_seconds(frames.front().time_ns);
    play.last_s = in_seconds(frames.back().time_ns);
    if (*play.last_s < 0.0 || *play.first_s > drive.duration_s)
        throw InputError({*mapping.log, 0, 0, {}},
                         fmt::format("found stamps from {:.6f} s to {:.6f} s of the drive", *play.first_s, *play.last_s),
                         fmt::format("frames of its {:g} s (start: a stamp of the recording)", drive.duration_s));
    return frames;
}

} // namespace

void end_with_route(Drive& drive, const Route& route, int& tick, double until_s) {
    const double room_m = route.length_m() - drive.bumper_m;
    for (; tick * drive.step_s <= until_s && tick < tick_count(drive); ++tick) {
        if (route_distance_m(drive, tick * drive.step_s) <= room_m)
            continue;
        drive.notes.push_back(fmt::format("can: the car comes to the end of the route, {:.1f} m: the drive ends after {:.3g} s instead of "
                                          "{:.3g} s",
                                          route.length_m(), tick * drive.step_s, drive.duration_s));
        drive.duration_s = tick * drive.step_s;
    }
}

namespace {

void note_signals(Drive& drive, const BusPlay& play) {
    for (std::size_t i = 0; i < play.records.size(); ++i) {
        const BusRecordOfInput& record = play.records[i];
        std::string states;
        for (std::size_t state = 1; state < bus_states; ++state)
            if (record.ticks[state] > 0)
                states +=
                    fmt::format("{}{} at {} ticks", states.empty() ? "" : ", ", name_of(static_cast<BusState>(state)), record.ticks[state]);
        if (!states.empty())
            drive.notes.push_back(fmt::format("can: {} of {} was {} of {}", drive.can->inputs[i].name, drive.can->inputs[i].source.text(),
                                              states, play.ticks.size()));
    }
    std::string never; // without a time after which they are stale
    for (std::size_t i = 0; i < play.records.size(); ++i)
        if (std::isinf(play.records[i].stale_after_s))
            never += (never.empty() ? "" : ", ") + drive.can->inputs[i].name;
    if (*play.last_s + shortest_gap_s < drive.duration_s)
        drive.notes.push_back(fmt::format("can: the recording ends at {:.3f} s of the drive's {:.3f} s; from then on the policies of stale "
                                          "signals hold{}",
                                          *play.last_s, drive.duration_s,
                                          never.empty() ? "" : "; these never go stale and keep their last value: " + never));
}

} // namespace

std::vector<CanFrame> read_bus_recording(Drive& drive, const std::filesystem::path& log, std::int64_t& start_ns) {
    const BusMapping& mapping = *drive.can;
    const std::string text = read_file(log, drive.opened);
    CandumpStream stream(log, text);
    std::vector<CanFrame> frames;
    for (CandumpStream::What what; (what = stream.next()) != CandumpStream::What::end;) {
        if (what != CandumpStream::What::frame)
            continue;
        if (stream.line().style.stamp_digits == 0)
            throw InputError({log, stream.line_number(), 0, {}}, "found a frame without a stamp", "stamps to play by");
        frames.push_back(stream.line().frame);
    }
    if (frames.empty())
        throw InputError({log, 0, 0, {}}, "found a recording without frames", "what a bus said");
    refuse_foreign(mapping, log, frames);
    start_ns = mapping.start_ns.value_or(frames.front().time_ns);
    for (CanFrame& frame : frames)
        frame.time_ns -= start_ns;
    std::ranges::stable_sort(frames, {}, &CanFrame::time_ns); // several channels may have been written one after the other
    return frames;
}

const std::vector<BusValue>& BusPlay::at(double time_s) const {
    // A moment at a tick but for a rounding has this tick's (control_run.h).
    const auto tick = static_cast<std::size_t>(std::max((time_s + 1.0e-9) / period_s, 0.0));
    return ticks[std::min(tick, ticks.size() - 1)];
}

double bus_period_s(const Drive& drive) {
    double period_s = ControlParameters{}.period_s;
    bool known = false;
    for (const LampSet& lamp_set : drive.lamp_sets) {
        if (!lamp_set.control)
            continue;
        if (known && lamp_set.control->period_s != period_s)
            throw InputError({drive.file, 0, 0, "control.period_s"},
                             fmt::format("found {:g} s and {:g} s", period_s, lamp_set.control->period_s),
                             "the same for all lamp sets of a drive with `can`");
        period_s = lamp_set.control->period_s;
        known = true;
    }
    return period_s;
}

std::int64_t tick_ns(std::uint64_t tick, double period_s) { return std::llround(1.0e9 * static_cast<double>(tick) * period_s); }

BusMover::BusMover(const Drive& drive) : drive_(drive) {
    for (std::size_t i = 0; drive.can && i < drive.can->inputs.size(); ++i) {
        const BusInput& input = drive.can->inputs[i];
        const bool is_speed = input.name == "ego.speed_mps", is_way = input.name == "ego.distance_m";
        if (!is_speed && !is_way)
            continue;
        if (drive.storyboard || drive.ego_track)
            throw InputError(input.where, fmt::format("{} in a drive whose storyboard moves the own car", input.name),
                             "one of both: no storyboard, or no such input");
        if (is_way && drive.vehicle)
            throw InputError(input.where, "ego.distance_m in a drive with a vehicle, whose equations say where it is",
                             "ego.speed_mps, which the vehicle follows");
        (is_speed ? speed_ : way_) = i;
    }
    if (way_ && !speed_)
        throw InputError(drive.can->inputs[*way_].where, "ego.distance_m without ego.speed_mps",
                         "both: differences of places are too coarse for a speed");
}

void BusMover::add(double time_s, const std::vector<BusValue>& values, BusMotion& motion) {
    if (!speed_)
        return;
    double mps = values[*speed_].value;
    if (std::isnan(mps)) {
        mps = last_mps_ ? *last_mps_ : fernlicht::speed_mps(drive_.speed, time_s);
        ++lost_;
    } else if (mps < 0.0) {
        mps = last_mps_.emplace(0.0);
        ++backwards_;
    } else {
        last_mps_ = mps;
    }
    if (!way_) {
        motion.add(time_s, mps);
        return;
    }
    const double route_distance_m = values[*way_].value;
    if (!std::isnan(route_distance_m))
        last_m_ = std::max(route_distance_m, 0.0);
    else // goes on with its speed
        last_m_ = last_m_ ? *last_m_ + mps * bus_period_s(drive_) : distance_m(drive_.speed, time_s);
    motion.add(time_s, mps, *last_m_);
}

std::vector<std::string> BusMover::notes() const {
    std::vector<std::string> notes;
    if (lost_ > 0)
        notes.push_back(
            fmt::format("can: the own car's speed was lost at {} ticks: it goes on with the last one, at first with the drive's", lost_));
    if (backwards_ > 0)
        notes.push_back(fmt::format(
            "can: the own car's speed was below 0 at {} ticks: it stands there, because it follows its route forwards", backwards_));
    return notes;
}

std::vector<std::string> listed_names(const BusMapping& mapping) {
    std::vector<std::string> names;
    for (const BusInput& input : mapping.inputs)
        if (listed_name(input.name).second > 0)
            names.push_back(input.name);
    for (const BusOutput& output : mapping.outputs)
        if (listed_name(output.name).second > 0)
            names.push_back(output.name);
    return names;
}

BusWriter::BusWriter(const BusMapping& mapping, const std::vector<std::string>& lamps) {
    const SignalTable table(lamps, listed_names(mapping));
    for (std::size_t i = 0; i < mapping.inputs.size(); ++i) {
        const BusInput& input = mapping.inputs[i];
        std::vector<std::string> names;
        if (input.name.find('*') == std::string::npos)
            names.push_back(input.name);
        else
            for (const std::string& lamp : lamps) // one that is named itself comes from there alone
                if (const std::string name = of_lamp(input.name, lamp);
                    std::ranges::find(mapping.inputs, name, &BusInput::name) == mapping.inputs.end())
                    names.push_back(name);
        for (const std::string& name : names) {
            try {
                places_.emplace_back(i, table.find(name));
            } catch (const std::invalid_argument& error) {
                throw InputError(input.where, fmt::format("no signal '{}'", printable(name)), error.what());
            }
            names_.push_back(name);
        }
    }
}

std::vector<WrittenSignal> BusWriter::at(const std::vector<BusValue>& values) const {
    std::vector<WrittenSignal> written;
    for (const auto& [input, place] : places_)
        written.push_back({place, values[input].value, values[input].age_s});
    return written;
}

void simulate_bus(Drive& drive, const Route& route) {
    if (!drive.can)
        return;
    if (drive.live) { // moves only when its bus says so (bus_drive.h)
        const BusMover mover(drive);
        if (mover.moves() && drive.vehicle)
            throw InputError(drive.can->where, "a vehicle whose speed comes from a bus that is listened to",
                             "a drive without `vehicle`, or a recording: its equations are solved before the first frame");
        BusMotion standing;
        standing.add(0.0, 0.0);
        if (mover.moves())
            drive.bus_motion = std::make_shared<const BusMotion>(std::move(standing));
        return;
    }
    if (drive.can->scripted) {
        drive.notes.emplace_back("can: played without a recording, by the drive's own speed and signals");
        return;
    }
    if (!drive.can->log)
        throw InputError(drive.can->where, "no recording of the bus",
                         "log: FILE or --can-log FILE (--can-log none plays the drive by its own speed and signals)");
    BusPlay play;
    play.period_s = bus_period_s(drive);
    play.databases = read_bus_databases(*drive.can, drive.opened);
    BusMover mover(drive);
    BusSignals signals(*drive.can, play.databases);
    const std::vector<CanFrame> frames = frames_of(drive, play);
    BusMotion motion;
    std::size_t next = 0;
    for (std::uint64_t tick = 0; static_cast<double>(tick) * play.period_s < drive.duration_s; ++tick) {
        const std::int64_t now_ns = tick_ns(tick, play.period_s);
        for (; next < frames.size() && frames[next].time_ns <= now_ns; ++next)
            signals.take(frames[next]);
        play.ticks.push_back(signals.at(now_ns));
        mover.add(static_cast<double>(tick) * play.period_s, play.ticks.back(), motion);
    }
    play.frames = next;
    play.read = signals.frames_used();
    play.records = signals.records();
    if (mover.moves()) {
        drive.bus_motion = std::make_shared<const BusMotion>(std::move(motion));
        int tick = 1;
        end_with_route(drive, route, tick, drive.duration_s);
    }
    const std::vector<std::string> notes = mover.notes();
    drive.notes.push_back(fmt::format("can: {} frames of the recording, of which inputs read {}", play.frames, play.read));
    drive.notes.insert(drive.notes.end(), notes.begin(), notes.end());
    note_signals(drive, play);
    drive.bus = std::make_shared<const BusPlay>(std::move(play));
}

} // namespace fernlicht
