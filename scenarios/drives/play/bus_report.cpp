#include "scenarios/drives/play/bus_report.h"

#include "scenarios/control/signals.h"
#include "scenarios/drives/play/bus_play.h"
#include "scenarios/drives/play/motion.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

struct ShownUnit {
    std::string name;
    double factor = 1.0;
};

ShownUnit shown_unit(std::string_view unit) {
    if (unit == "rad")
        return {"deg", 180.0 / pi};
    if (unit == "rad/s")
        return {"deg/s", 180.0 / pi};
    if (unit == "m/s")
        return {"km/h", 3.6};
    return {unit == "1" ? "" : std::string(unit)};
}

std::optional<double> number_of(double value, double factor) { return std::isfinite(value) ? std::optional(value * factor) : std::nullopt; }

BusSignalReport signal_report(const BusInput& input, const BusRecordOfInput& record) {
    BusSignalReport report;
    const SignalKind* const kind = known_signal(input.name);
    const ShownUnit unit = shown_unit(kind->unit);
    report.name = input.name;
    report.source = input.source.text();
    report.unit = unit.name;
    if (input.also)
        report.also = input.also->text();
    report.tolerance = input.tolerance * unit.factor;
    report.frames = record.frames;
    report.changes = record.changes;
    report.oldest_s = record.oldest_s;
    if (std::isfinite(record.stale_after_s))
        report.stale_after_s = record.stale_after_s;
    report.ticks = record.ticks;
    report.acted = record.acted;
    report.unchecked = record.unchecked;
    for (std::size_t state = 1; state < bus_states; ++state)
        if (static_cast<BusState>(state) != BusState::contradictory || input.also)
            report.policies[state] = name_of(input.policies[state]);
    for (const auto& [from_s, state] : record.states)
        report.states.emplace_back(from_s, static_cast<std::size_t>(state));
    return report;
}

} // namespace

BusReport bus_report(const Drive& drive, const LampSet& lamp_set, int first, int last) {
    BusReport report;
    if (!drive.can || !lamp_set.motion || !lamp_set.motion->control)
        return report;
    const ControlRun& run = *lamp_set.motion->control;
    report.sent = lamp_set.motion->sent.size();
    report.end_s = drive.duration_s;
    if (drive.can->log)
        report.log = drive.can->log->filename().string();
    for (std::size_t place = 0; place < run.signals.size() && place < run.changed_s.size(); ++place) {
        const SignalKind* const kind = known_signal(run.signals[place]);
        report.all.push_back({run.signals[place], std::string(kind->unit), run.changed_s[place], number_of(run.age_s[place], 1.0)});
    }
    if (!drive.bus)
        return report;
    const BusPlay& play = *drive.bus;
    report.start_s = in_seconds(play.start_ns);
    report.frames = play.frames;
    report.read = play.read;
    for (int tick = std::max(first, 0); tick <= last; ++tick) {
        report.frame.push_back(tick);
        report.time_s.push_back(tick * drive.step_s);
    }
    for (std::size_t i = 0; i < drive.can->inputs.size(); ++i) {
        BusSignalReport signal = signal_report(drive.can->inputs[i], play.records[i]);
        const double factor = shown_unit(known_signal(signal.name)->unit).factor;
        for (const double time_s : report.time_s) {
            const BusValue& value = play.at(time_s)[i];
            signal.value.push_back(number_of(value.value, factor));
            signal.received.push_back(number_of(value.received, factor));
        }
        if (const double changed_s = play.ticks.back()[i].changed_s; std::isfinite(changed_s))
            signal.changed_s = changed_s;
        report.signals.push_back(std::move(signal));
    }
    return report;
}

std::vector<std::string> bus_warnings(const Drive& drive) {
    constexpr double noticeable_share = 0.05;
    std::vector<std::string> warnings;
    if (!drive.can || !drive.bus || drive.bus->ticks.empty())
        return warnings;
    const auto all = static_cast<double>(drive.bus->ticks.size());
    for (std::size_t i = 0; i < drive.can->inputs.size() && i < drive.bus->records.size(); ++i) {
        const BusInput& input = drive.can->inputs[i];
        const BusRecordOfInput& record = drive.bus->records[i];
        if (const BusPolicy stale = input.policy(BusState::stale); stale != BusPolicy::lost && std::isinf(record.stale_after_s))
            warnings.push_back(fmt::format("{}: `stale: {}` of {} never acts, its last value holds for ever: nothing says when {} is stale "
                                           "(stale_after_s, or a cycle time in the database)",
                                           drive.name, name_of(stale), input.name, input.source.text()));
        std::string states;
        double share = 0.0;
        for (std::size_t state = 1; state < bus_states; ++state) {
            if (record.ticks[state] == 0)
                continue;
            const double of_state = static_cast<double>(record.ticks[state]) / all;
            share += of_state;
            const auto kind = static_cast<BusState>(state);
            states += fmt::format("{}{} {:.3g} % (policy: {})", states.empty() ? "" : ", ",
                                  kind == BusState::out_of_range ? "out of range" : std::string(name_of(kind)), 100.0 * of_state,
                                  name_of(input.policy(kind)));
        }
        if (record.frames == 0)
            warnings.push_back(fmt::format("{}: no frame held {}, which {} comes from, at any tick; policy: {}", drive.name,
                                           input.source.text(), input.name, name_of(input.policy(BusState::missing))));
        else if (share > noticeable_share)
            warnings.push_back(fmt::format("{}: {} of {} was not fresh at {:.3g} % of the ticks: {}", drive.name, input.name,
                                           input.source.text(), 100.0 * share, states));
    }
    return warnings;
}

} // namespace fernlicht
