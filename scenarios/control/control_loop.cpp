#include "scenarios/control/control_loop.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace fernlicht {
namespace {

std::vector<std::string> names_of(const std::vector<ControlledLamp>& lamps) {
    std::vector<std::string> names;
    for (const ControlledLamp& lamp : lamps)
        names.push_back(lamp.name);
    return names;
}

std::size_t lamp_named(const std::vector<ControlledLamp>& lamps, const std::string& name) {
    const auto found = std::ranges::find(lamps, name, &ControlledLamp::name);
    if (found == lamps.end())
        throw std::invalid_argument(fmt::format("no lamp '{}'", name));
    return static_cast<std::size_t>(found - lamps.begin());
}

std::vector<std::string> together(std::vector<std::string> names, const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

} // namespace

ControlLoop::ControlLoop(const ControlParameters& parameters, const std::vector<ControlledLamp>& lamps, const ControlledCar& car,
                         const SolverOptions& options, const std::vector<std::string>& written, const std::vector<std::string>& also)
    : parameters_(parameters), options_(options), table_(names_of(lamps), together(written, also)), controller_(parameters, lamps, car),
      runs_(lamps.size()), levels_(lamps.size(), 1.0), switches_(lamps.size(), 1.0), before_(table_.values()),
      out_of_range_(table_.size(), 0), written_(table_.size(), false) {
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        segments_.emplace_back(lamps[i].windows.size(), 1.0);
        runs_[i].pixels = lamps[i].pixels;
    }
    for (const PluginParameters& plugin : parameters_.plugins)
        plugins_.emplace_back(plugin, lamps, parameters_.period_s);
    if (parameters_.camera)
        camera_.emplace(*parameters_.camera);
    std::set<std::size_t> swivelling, levelled;
    if (parameters_.bend)
        for (const std::string& name : parameters_.bend->lamps)
            swivelling.insert(lamp_named(lamps, name));
    for (std::size_t lamp = 0; parameters_.levelling && lamp < lamps.size(); ++lamp)
        levelled.insert(lamp);
    for (const PluginParameters& plugin : parameters_.plugins)
        for (const std::string& name : plugin.lamps) {
            swivelling.insert(lamp_named(lamps, name));
            levelled.insert(lamp_named(lamps, name));
        }
    for (const std::string& name : written) {
        const std::size_t place = table_.find(name);
        written_[place] = true;
        boxes_written_ = boxes_written_ || (table_.is_listed(place) && table_.kind(place).writer != "laws");
        if (place < signal::count || table_.is_listed(place))
            continue;
        const auto [lamp, which] = SignalTable::lamp_signal_at(place);
        if (which == lamp_signal::swivel_command)
            swivelling.insert(lamp);
        if (which == lamp_signal::pitch_command)
            levelled.insert(lamp);
        if (which == lamp_signal::swivel || which == lamp_signal::pitch)
            measured_.push_back(place);
    }
    for (const std::size_t place : measured_) {
        const auto [lamp, which] = SignalTable::lamp_signal_at(place);
        (which == lamp_signal::swivel ? swivelling : levelled).erase(lamp);
    }
    const ActuatorParameters swivel = parameters_.bend ? parameters_.bend->actuator : SwivelParameters{}.actuator;
    const ActuatorParameters level = parameters_.levelling ? parameters_.levelling->actuator : LevellingParameters{}.actuator;
    for (const std::size_t lamp : swivelling)
        driven_.push_back({lamp, lamp_signal::swivel_command, lamp_signal::swivel, swivel, {}, {}, {}});
    if (parameters_.stuck_swivel)
        for (Driven& driven : driven_)
            driven.diagnosis.emplace(*parameters_.stuck_swivel, driven.parameters);
    for (const std::size_t lamp : levelled)
        driven_.push_back({lamp, lamp_signal::pitch_command, lamp_signal::pitch, level, {}, {}, {}});
    if (parameters_.modes)
        for (const std::string& name : parameters_.modes->lamps)
            mode_lamps_.push_back(lamp_named(lamps, name));
    for (const ScriptedSignal& input : parameters_.inputs)
        scripted_.push_back(table_.find(input.name));
    for (const ControlFailure& failure : parameters_.failures)
        failing_.push_back(failure.kind == ControlFailure::Kind::lost_signal ? table_.find(failure.what) : lamp_named(lamps, failure.what));
}

void ControlLoop::read(const ControlInputs& in) {
    for (const std::size_t scripted_only :
         {std::size_t{signal::ego_indicator}, std::size_t{signal::ego_wipers}, std::size_t{signal::road_motorway}})
        table_[scripted_only] = 0.0;
    using In = ControlInputs;
    static constexpr std::pair<std::size_t, double In::*> told[] = {{signal::time, &In::time_s},
                                                                    {signal::ego_distance, &In::distance_m},
                                                                    {signal::ego_speed, &In::speed_mps},
                                                                    {signal::ego_acceleration, &In::acceleration_mps2},
                                                                    {signal::ego_yaw_rate, &In::yaw_rate_rad_s},
                                                                    {signal::ego_steering, &In::steering_rad},
                                                                    {signal::ego_spring_pitch, &In::spring_pitch_rad},
                                                                    {signal::ego_load_pitch, &In::load_pitch_rad},
                                                                    {signal::road_curvature, &In::curvature_per_m},
                                                                    {signal::road_curvature_25m, &In::curvature_25m_per_m},
                                                                    {signal::road_curvature_50m, &In::curvature_50m_per_m},
                                                                    {signal::road_curvature_100m, &In::curvature_100m_per_m},
                                                                    {signal::road_bearing_ahead, &In::bearing_ahead_rad},
                                                                    {signal::environment_illuminance, &In::illuminance_lx},
                                                                    {signal::environment_wetness, &In::wetness}};
    for (const auto& [place, value] : told)
        table_[place] = in.*value;
    double oncoming_m = std::numeric_limits<double>::infinity(), preceding_m = oncoming_m, count = 0.0;
    for (const OtherUser& other : in.surroundings.others) {
        if (!other.lamps_on || other.ahead_m <= 0.0)
            continue;
        double& nearest_m = other.oncoming() ? oncoming_m : preceding_m;
        nearest_m = std::min(nearest_m, std::hypot(other.ahead_m, other.left_m));
        ++count;
    }
    table_[signal::others_nearest_oncoming] = oncoming_m;
    table_[signal::others_nearest_preceding] = preceding_m;
    table_[signal::others_count] = count;
    if (!boxes_written_)
        tell_boxes(in.surroundings.others);
    for (std::size_t i = 0; i < scripted_.size(); ++i)
        for (const auto& [from_s, value] : parameters_.inputs[i].values)
            if (from_s <= in.time_s)
                table_[scripted_[i]] = value;
    write_over(in, false);
}

/// Boxes of the drive's own road users, for those whom they are sent to.
void ControlLoop::tell_boxes(const std::vector<OtherUser>& others) {
    for (const SignalTable::Listed& listed : table_.boxes()) {
        std::size_t number = 0;
        std::optional<SeenBox> box;
        for (const OtherUser& other : others)
            if (other.lamps_on && other.ahead_m > camera_x_m && ++number == listed.number)
                box = box_from_camera(other);
        table_[listed.place + listed_signal::valid] = box ? 1.0 : 0.0;
        if (!box)
            continue; // as they were
        for (const auto& [which, value] : {std::pair(listed_signal::left, box->left_rad), std::pair(listed_signal::right, box->right_rad),
                                           std::pair(listed_signal::bottom, box->bottom_rad), std::pair(listed_signal::top, box->top_rad),
                                           std::pair(listed_signal::distance, box->distance_m)})
            table_[listed.place + which] = value;
    }
}

/// Road users by the boxes that were written. One of whom something is lost, or whose edges lie the wrong way round, may be anywhere.
std::vector<OtherUser> ControlLoop::told_boxes() {
    std::vector<OtherUser> users;
    for (const SignalTable::Listed& listed : table_.boxes()) {
        const auto value = [&](std::size_t which) { return table_[listed.place + which]; };
        bool written = false;
        for (std::size_t which = 0; which < listed_signal::box_count; ++which)
            written = written || written_[listed.place + which];
        if (!written || value(listed_signal::valid) <= 0.5)
            continue;
        SeenBox box{value(listed_signal::left), value(listed_signal::right), value(listed_signal::bottom), value(listed_signal::top)};
        if (!std::isfinite(value(listed_signal::valid) + box.left_rad + box.right_rad + box.bottom_rad + box.top_rad))
            box = {};
        else if (box.left_rad < box.right_rad || box.top_rad < box.bottom_rad) {
            box = {};
            ++impossible_[listed.number];
        } else if (!std::isnan(value(listed_signal::distance)))
            box.distance_m = value(listed_signal::distance);
        users.push_back(user_in_box(box));
    }
    return users;
}

/// Levels of windows that were written take the place of the laws' own; of others the table has the laws'.
void ControlLoop::take_segments() {
    for (const SignalTable::Listed& listed : table_.segments()) {
        double& level = segments_[listed.lamp].at(listed.number - 1);
        double& told = table_[listed.place];
        if (!written_[listed.place])
            told = level;
        else
            level = told = std::isfinite(told) ? told : before_[listed.place]; // lost: as it was
    }
}

/// Signals that laws write are written over after them, all others before. A measured angle that is lost stays as it was.
void ControlLoop::write_over(const ControlInputs& inputs, bool of_laws) {
    for (const WrittenSignal& written : inputs.written) {
        if ((table_.kind(written.place).writer == "laws") != of_laws)
            continue;
        const bool holds = std::ranges::find(measured_, written.place) != measured_.end() || (of_laws && table_.is_listed(written.place));
        if (std::isnan(written.value) && holds)
            continue;
        table_[written.place] = written.value;
    }
}

/// When what changed.
void ControlLoop::stamp(const ControlInputs& inputs) {
    for (std::size_t place = 0; place < table_.size(); ++place) {
        const double now = table_[place], then = before_[place];
        if (started_ && now != then && !(std::isnan(now) && std::isnan(then)))
            table_.stamp(place, inputs.time_s, 0.0);
        before_[place] = now;
    }
    for (const WrittenSignal& written : inputs.written)
        table_.stamp(written.place, table_.changed_s(written.place), written.age_s);
}

void ControlLoop::fail(double time_s) {
    const auto holds = [&](const ControlFailure& failure) { return time_s >= failure.at_s && time_s < failure.until_s; };
    for (std::size_t i = 0; i < failing_.size(); ++i)
        if (const ControlFailure& failure = parameters_.failures[i]; failure.kind == ControlFailure::Kind::lost_signal && holds(failure))
            table_[failing_[i]] = not_a_number;
    for (Driven& driven : driven_) {
        const auto kind = driven.actual == lamp_signal::swivel ? ControlFailure::Kind::stuck_swivel : ControlFailure::Kind::stuck_levelling;
        bool stuck = false;
        for (std::size_t i = 0; i < failing_.size(); ++i)
            stuck = stuck || (parameters_.failures[i].kind == kind && failing_[i] == driven.lamp && holds(parameters_.failures[i]));
        if (driven.actuator)
            driven.actuator->jam(stuck);
    }
}

/// A value that no car or road has is a lost signal.
void ControlLoop::check() {
    for (std::size_t place = 1; place < table_.size(); ++place) {
        const SignalKind& kind = table_.kind(place);
        if (table_[place] >= kind.least && table_[place] <= kind.greatest)
            continue;
        out_of_range_[place] += std::isnan(table_[place]) ? 0U : 1U;
        table_[place] = not_a_number;
    }
}

void ControlLoop::advance(Driven& driven, double until_s) {
    while (!driven.commands.empty() && driven.commands.front().first <= until_s) {
        driven.actuator->advance(driven.commands.front().first);
        driven.actuator->command(driven.commands.front().second);
        driven.asked_rad = driven.commands.front().second;
        driven.commands.pop_front();
    }
    driven.actuator->advance(until_s);
}

/// Which swivels are stuck, by what they were asked for and where they are.
void ControlLoop::diagnose(double time_s) {
    for (Driven& driven : driven_)
        if (driven.diagnosis && driven.actuator && started_) {
            const bool stuck = driven.diagnosis->step(driven.asked_rad, driven.actuator->angle_rad(), time_s - last_s_);
            table_.of(driven.lamp, lamp_signal::swivel_stuck) = stuck ? 1.0 : 0.0;
        }
}

/// With a swivel that is stuck: all look straight ahead, and the stuck lamp is lowered or dimmed where it is stuck aside.
void ControlLoop::make_safe() {
    const auto stuck = [](const Driven& driven) { return driven.diagnosis && driven.diagnosis->found(); };
    if (std::ranges::none_of(driven_, stuck))
        return;
    for (const Driven& driven : driven_)
        if (driven.actual == lamp_signal::swivel)
            table_.of(driven.lamp, driven.command) = 0.0;
    for (const Driven& driven : driven_) {
        if (!driven.diagnosis || !driven.diagnosis->aside())
            continue;
        const auto levelling = std::ranges::find_if(
            driven_, [&](const Driven& other) { return other.lamp == driven.lamp && other.actual == lamp_signal::pitch; });
        if (levelling == driven_.end()) {
            table_.of(driven.lamp, lamp_signal::level) *= parameters_.stuck_swivel->level;
            continue;
        }
        double& pitch_rad = table_.of(driven.lamp, lamp_signal::pitch_command);
        pitch_rad =
            std::isfinite(pitch_rad) ? std::min(pitch_rad, parameters_.stuck_swivel->pitch_rad) : parameters_.stuck_swivel->pitch_rad;
    }
}

/// Commands go out, to arrive after the dead time. A command that is no number keeps the last one.
void ControlLoop::order(double time_s) {
    for (Driven& driven : driven_) {
        const double command_rad = table_.of(driven.lamp, driven.command);
        if (!std::isfinite(command_rad)) {
            if (!driven.actuator) // not told yet: as it was aimed
                driven.actuator.emplace(driven.parameters, 0.0, options_);
            continue;
        }
        if (driven.actuator && driven.parameters.dead_time_s > 0.0) {
            driven.commands.emplace_back(time_s + driven.parameters.dead_time_s, command_rad);
            continue;
        }
        driven.asked_rad = command_rad;
        if (driven.actuator)
            driven.actuator->command(command_rad);
        else
            driven.actuator.emplace(driven.parameters, command_rad, options_);
    }
}

/// What follows at once is kept where it changes.
void ControlLoop::keep(double time_s) {
    const auto changed = [&](auto& kept, const auto& now, const auto& at_first) {
        if (kept.empty() ? now != at_first : kept.back().second != now)
            kept.emplace_back(time_s, now);
    };
    for (std::size_t lamp = 0; lamp < runs_.size(); ++lamp) {
        double& level = table_.of(lamp, lamp_signal::level);
        const double by_switch = table_.of(lamp, lamp_signal::driver_switch);
        level = levels_[lamp] = std::isfinite(level) ? level : levels_[lamp]; // lost: as it was
        switches_[lamp] = std::isfinite(by_switch) ? by_switch : switches_[lamp];
        level *= switches_[lamp];
        double lit = 0.0;
        for (const double segment : segments_[lamp])
            lit += segment;
        table_.of(lamp, lamp_signal::segments_lit) = lit;
        if (const auto& pixels = runs_[lamp].pixels)
            pixels->ask(time_s, std::vector<float>(segments_[lamp].begin(), segments_[lamp].end()));
        else if (segments_[lamp].size() == 1)
            level *= segments_[lamp].front();
        else
            changed(runs_[lamp].segments, segments_[lamp], std::vector<double>(segments_[lamp].size(), 1.0));
        changed(runs_[lamp].levels, level, 1.0);
    }
    for (const std::size_t place : measured_) {
        const auto [lamp, which] = SignalTable::lamp_signal_at(place);
        changed(which == lamp_signal::swivel ? runs_[lamp].measured_swivel : runs_[lamp].measured_pitch, table_[place], 0.0);
    }
    const auto mode = static_cast<BeamMode>(static_cast<int>(table_[signal::control_mode]));
    for (const std::size_t lamp : mode_lamps_)
        changed(runs_[lamp].modes, mode, BeamMode::c);
}

void ControlLoop::step(ControlInputs inputs) {
    if (camera_)
        inputs.surroundings.others = camera_->step(inputs.time_s, inputs.surroundings.others);
    for (Driven& driven : driven_)
        if (driven.actuator) {
            advance(driven, inputs.time_s);
            table_.of(driven.lamp, driven.actual) = driven.actuator->angle_rad();
        }
    read(inputs);
    check();
    fail(inputs.time_s);
    diagnose(inputs.time_s);
    if (boxes_written_)
        inputs.surroundings.others = told_boxes();
    controller_.step(table_, segments_, inputs.surroundings, started_ ? inputs.time_s - last_s_ : 0.0);
    for (ControlPlugin& plugin : plugins_)
        plugin.step(table_, segments_, inputs.surroundings);
    write_over(inputs, true);
    take_segments();
    make_safe();
    check();
    order(inputs.time_s);
    keep(inputs.time_s);
    if (!started_)
        for (const Driven& driven : driven_)
            table_.of(driven.lamp, driven.actual) = driven.actuator ? driven.actuator->angle_rad() : 0.0;
    stamp(inputs);
    last_s_ = inputs.time_s;
    started_ = true;
}

LampRun ControlLoop::lamp_at(std::size_t lamp, double time_s) const {
    const auto held = [&](const auto& changes) {
        const auto next = std::ranges::upper_bound(changes, time_s, {}, [](const auto& change) { return change.first; });
        return std::remove_cvref_t<decltype(changes)>(next == changes.begin() ? next : next - 1, next);
    };
    const LampRun& run = runs_[lamp];
    LampRun now;
    now.levels = held(run.levels);
    now.modes = held(run.modes);
    now.segments = held(run.segments);
    now.pixels = run.pixels;
    now.measured_swivel = held(run.measured_swivel);
    now.measured_pitch = held(run.measured_pitch);
    for (const Driven& driven : driven_)
        if (driven.lamp == lamp && driven.actuator)
            (driven.actual == lamp_signal::swivel ? now.measured_swivel : now.measured_pitch)
                .assign(1, {0.0, driven.actuator->so_far().angle_rad(time_s)});
    return now;
}

std::vector<LampRun> ControlLoop::finish(double end_s) {
    for (Driven& driven : driven_) {
        if (!driven.actuator)
            continue;
        advance(driven, end_s);
        (driven.actual == lamp_signal::swivel ? runs_[driven.lamp].swivel : runs_[driven.lamp].pitch) = driven.actuator->take();
    }
    return std::move(runs_);
}

std::vector<std::string> ControlLoop::notes() const {
    std::vector<std::string> notes;
    for (std::size_t place = 0; place < out_of_range_.size(); ++place)
        if (out_of_range_[place] > 0)
            notes.push_back(fmt::format("signal {} was outside {:g} to {:g} {} at {} ticks, and taken for lost there", table_.name(place),
                                        table_.kind(place).least, table_.kind(place).greatest, table_.kind(place).unit,
                                        out_of_range_[place]));
    for (const auto& [number, ticks] : impossible_)
        notes.push_back(fmt::format("others[{}] had its left edge to the right of its right one, or its top below its bottom, at {} ticks: "
                                    "it counts as lost there, so that all windows are dark (a bus whose angles are positive to the right "
                                    "needs `opposite: true`)",
                                    number, ticks));
    for (const ControlPlugin& plugin : plugins_)
        std::ranges::copy(plugin.notes(), std::back_inserter(notes));
    return notes;
}

std::optional<InputError> ControlLoop::unusable() const {
    for (const ControlPlugin& plugin : plugins_)
        if (std::optional<InputError> error = plugin.unusable())
            return error;
    return std::nullopt;
}

bool StuckSwivel::step(double asked_rad, double actual_rad, double dt_s) {
    constexpr double still_rad_s = 0.5 * 3.14159265358979323846 / 180.0, rounding_s = 1.0e-9;
    const bool off = std::abs(std::clamp(asked_rad, min_rad_, max_rad_) - actual_rad) > parameters_.off_rad;
    const bool still = std::abs(actual_rad - last_rad_) <= still_rad_s * dt_s;
    still_s_ = off && still ? still_s_ + dt_s : 0.0;
    last_rad_ = actual_rad;
    found_ = found_ || (still_s_ > 0.0 && still_s_ >= parameters_.after_s - rounding_s);
    return found_;
}

} // namespace fernlicht
