#include "runner/experiments/improve/improve_run.h"

#include "runner/experiments/improve/solve_quadratic.h"
#include "runner/experiments/regulation/regulation_result.h"
#include "runner/files/output_folder.h"
#include "runner/findings/run_context.h"
#include "runner/play/stage.h"
#include "scenarios/drives/play/advance.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numeric>
#include <regex>

namespace fernlicht {
namespace {

ImproveDemand demand_of(const char* flag, const std::string& text, const char* expected) {
    static const std::regex form(
        R"(\s*(?:([^:]+):\s*)?([^\s:]+)(?:\s+(by|within|at\s+least|at\s+most)\s+([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*(\S*))?\s*)");
    std::smatch part;
    if (!std::regex_match(text, part, form))
        throw InputError({{}, 0, 0, flag}, "found '" + printable(text) + "'", expected);
    const std::optional<ReadingKey> key = key_of(part[2].str());
    if (!key)
        throw InputError({{}, 0, 0, flag}, "found '" + printable(part[2].str()) + "'", "a reading's name; `fernlicht readings` lists them");
    ImproveDemand demand{.text = text, .drive = part[1], .reading = *key};
    using enum ImproveDemand::Kind;
    const std::string how = part[3];
    demand.kind = how == "by" ? gain : how.ends_with("least") ? at_least : how.ends_with("most") ? at_most : within;
    const std::string unit = part[5];
    demand.in_percent = unit == "%";
    if ((demand.kind == gain) != (std::string_view(flag) == "--gain") ||
        (demand.in_percent && (demand.kind == at_least || demand.kind == at_most)))
        throw InputError({{}, 0, 0, flag}, "found '" + printable(text) + "'", expected);
    if (!unit.empty() && !demand.in_percent && unit != unit_of(*key))
        throw InputError({{}, 0, 0, flag}, "found '" + printable(text) + "'", fmt::format("{} in {}", name_of(*key), unit_of(*key)));
    if (part[4].matched) {
        std::size_t read = 0;
        demand.amount = std::stod(part[4].str(), &read);
        if (read != part[4].str().size() || !(demand.amount > 0.0 || demand.kind != gain))
            throw InputError({{}, 0, 0, flag}, "found '" + printable(text) + "'", expected);
    }
    if ((demand.kind == gain || demand.kind == within) && row_of(key->quantity).better == Better::neither)
        throw InputError({{}, 0, 0, flag}, "found '" + printable(name_of(*key)) + "', of which neither more nor less is better",
                         "--keep with `at least` or `at most`");
    return demand;
}

/// A drive on its stage.
struct StagedDrive {
    std::string name;
    Stage stage;
    const LampSet* lamp_set;
    std::vector<Moment> moments;

    StagedDrive(NamedDrive named, const TickRange& range)
        : name(std::move(named.name)), stage(std::move(named.drive)), lamp_set(&stage.drive.lamp_sets.front()) {
        const int count = ticks_to_play(stage.drive, range);
        if (count < 1)
            throw InputError({{}, 0, 0, "--frames"}, fmt::format("found no moment of {}", name),
                             fmt::format("some of 0 to {}", tick_count(stage.drive) - 1));
        std::vector<int> ticks(static_cast<std::size_t>(count));
        std::iota(ticks.begin(), ticks.end(), std::max(0, range.first));
        moments = moments_at(ticks, stage, *lamp_set);
    }
};

using StagedDrives = std::vector<std::unique_ptr<StagedDrive>>;

StagedDrives staged(std::vector<NamedDrive> drives, const TickRange& ticks) {
    StagedDrives all;
    for (NamedDrive& drive : drives)
        all.push_back(std::make_unique<StagedDrive>(std::move(drive), ticks));
    return all;
}

/// The sign of a reading's better side.
bool more_is_better(const ReadingKey& key) { return row_of(key.quantity).better == Better::higher; }

struct Sought {
    std::vector<std::unique_ptr<ReadingOfLight>> readings;
    std::vector<SoughtReading> sought;
};

/// What is sought of one demand in one drive, and the line of the result.
void add_sought(Sought& sought, ImproveResult& result, const ImproveDemand& demand, const StagedDrives& drives, std::size_t k) {
    const char* const flag = demand.kind == ImproveDemand::Kind::gain ? "--gain" : "--keep";
    const ReadingOfLight& reading = *sought.readings.emplace_back(std::make_unique<ReadingOfLight>(
        demand.reading, drives[k]->stage.drive, drives[k]->stage.route, drives[k]->moments, fmt::format("{}, {}", flag, drives[k]->name)));
    const Value before = reading.value(drives[k]->moments);
    const std::string name = fmt::format("{} of {}", name_of(demand.reading), drives[k]->name);
    if (!before.number())
        throw InputError({{}, 0, 0, flag},
                         fmt::format("found {}, which is {}", name,
                                     before.measured() ? "only known to be beyond a bound" : "not measured: " + before.reason()),
                         "a reading that is a number");
    using enum ImproveDemand::Kind;
    ImprovedReading line;
    line.drive = drives[k]->name;
    line.asked = demand.text;
    line.reading = demand.reading;
    line.is_gain = demand.kind == gain;
    const double now = *before.number(), amount = demand.in_percent ? 0.01 * demand.amount * std::abs(now) : demand.amount;
    line.at_least = demand.kind == at_least || (demand.kind != at_most && more_is_better(demand.reading));
    const double better = line.at_least ? 1.0 : -1.0;
    line.bound = demand.kind == gain ? now + better * amount : demand.kind == within ? now - better * amount : demand.amount;
    line.before = before;
    const double scale = line.is_gain ? amount : std::max(0.01 * std::abs(line.bound), 1e-6);
    sought.sought.push_back({name, &reading, k, line.at_least, line.bound, scale, line.is_gain});
    result.readings.push_back(std::move(line));
}

/// What all demands seek; throws for a drive that is named and not there.
Sought sought_of(const std::vector<ImproveDemand>& demands, const StagedDrives& drives, ImproveResult& result) {
    Sought sought;
    for (const ImproveDemand& demand : demands) {
        bool there = false;
        for (std::size_t k = 0; k < drives.size(); ++k)
            if (demand.drive.empty() || demand.drive == drives[k]->name) {
                add_sought(sought, result, demand, drives, k);
                there = true;
            }
        if (!there) {
            std::vector<std::string> names;
            for (const auto& drive : drives)
                names.push_back(drive->name);
            throw InputError({{}, 0, 0, demand.kind == ImproveDemand::Kind::gain ? "--gain" : "--keep"},
                             "found '" + printable(demand.text) + "'", fmt::format("a drive among {}", fmt::join(names, ", ")));
        }
    }
    return sought;
}

/// To a tenth of a candela, so that a solver's last digits do not matter; what did not change stays to the bit.
CandelaTable rounded(const CandelaTable& before, CandelaTable after) {
    for (std::size_t i = 0; i < after.cd.size(); ++i)
        after.cd[i] = std::abs(after.cd[i] - before.cd[i]) < 0.05 ? before.cd[i] : std::round(10.0 * after.cd[i]) / 10.0;
    return after;
}

void tell_tables(ImproveResult& result, CandelaTable before, CandelaTable after) {
    const auto steepest = [](const CandelaTable& table) {
        double most = 0.0;
        const std::size_t columns = table.h_deg.size();
        for (std::size_t i = 0; i < table.cd.size(); ++i) {
            if (i % columns + 1 < columns)
                most = std::max(most, std::abs(table.cd[i + 1] - table.cd[i]) / (table.h_deg[i % columns + 1] - table.h_deg[i % columns]));
            if (i + columns < table.cd.size())
                most = std::max(most,
                                std::abs(table.cd[i + columns] - table.cd[i]) / (table.v_deg[i / columns + 1] - table.v_deg[i / columns]));
        }
        return most;
    };
    result.flux_before_lm = flux_lm(before);
    result.flux_after_lm = flux_lm(after);
    result.steepest_before = steepest(before);
    result.steepest_after = steepest(after);
    const auto extreme = [&](std::size_t i) {
        return ImproveExtreme{before.h_deg[i % before.h_deg.size()], before.v_deg[i / before.h_deg.size()], before.cd[i], after.cd[i]};
    };
    std::size_t most = 0, least = 0, brightest = 0;
    const auto change = [&](std::size_t i) { return after.cd[i] - before.cd[i]; };
    for (std::size_t i = 0; i < before.cd.size(); ++i) {
        result.samples_changed += change(i) != 0.0 ? 1 : 0;
        most = change(i) > change(most) ? i : most;
        least = change(i) < change(least) ? i : least;
        brightest = after.cd[i] > after.cd[brightest] ? i : brightest;
    }
    result.most = extreme(most);
    result.least = extreme(least);
    result.brightest = extreme(brightest);
    result.before = std::move(before);
    result.after = std::move(after);
}

void tell_regulation(ImproveResult& result, const Regulation& regulation, const RegulationCheck& before, const RegulationCheck& after) {
    result.regulation = regulation.id;
    result.regulation_title = regulation.title;
    result.verdict_before = name_of(before.verdict);
    result.verdict_after = name_of(after.verdict);
    for (const RowResult& then : before.rows) {
        ImprovedRow row{.id = then.id,
                        .unit = then.unit,
                        .before_verdict = name_of(then.verdict),
                        .after_verdict = name_of(RowVerdict::not_measured),
                        .before = then.found,
                        .before_margin = then.margin,
                        .limits = limits_of(then)};
        const auto now = std::ranges::find(after.rows, then.id, &RowResult::id); // a cut-off that is none any more has no rows
        if (now != after.rows.end()) {
            row.after_verdict = name_of(now->verdict);
            row.after = now->found;
            row.after_margin = now->margin;
            row.limits = limits_of(*now);
        }
        result.rows.push_back(std::move(row));
    }
}

} // namespace

ImproveDemand gain_of(const std::string& text) {
    return demand_of("--gain", text, "'[DRIVE:]READING by AMOUNT', such as 'reach_5lx_target_own_m by 5 m' or 'by 10 %'");
}

ImproveDemand kept_of(const std::string& text) {
    return demand_of("--keep", text, "'[DRIVE:]READING', 'READING within AMOUNT', 'READING at least FIGURE' or 'READING at most FIGURE'");
}

bool improved(const ImproveResult& result) {
    return std::ranges::all_of(result.readings, &ImprovedReading::met) && std::ranges::none_of(result.rows, [](const ImprovedRow& row) {
               return row.before_verdict == "pass" && row.after_verdict != "pass";
           });
}

ImproveResult run_improve(const ImproveRequest& request) {
    ImproveResult result;
    const LampFile lamp = read_lamp(request.lamp, request.lamp_options);
    const Regulation* const asked = request.regulation.empty() ? nullptr : &regulation(request.regulation);
    const StagedDrives drives = staged(request.drives(request.lamp), request.ticks);
    for (const auto& drive : drives) {
        result.drives.push_back({drive->name, drive->stage.drive.title, drive->lamp_set->name, static_cast<int>(drive->moments.size())});
        if (std::ranges::none_of(drive->moments.front().lamps, [&](const LitLamp& one) { return one.file->table == lamp.table; }))
            throw InputError({{}, 0, 0, "LAMP"}, fmt::format("{}: no lamp of {} has this beam", request.lamp.string(), drive->name),
                             "a drive that takes the lamp as it is, not mirrored");
    }
    const Sought sought = sought_of(request.demands, drives, result);
    std::optional<RegulationRows> rows;
    if (asked)
        try {
            rows.emplace(*asked, request.left_hand_traffic, lamp.table, request.kept_rows);
        } catch (const std::invalid_argument& row) {
            throw InputError({{}, 0, 0, "--keep-row"}, "found '" + printable(row.what()) + "'",
                             fmt::format("a row that `fernlicht lamp {} --regulation {}` prints", request.lamp.string(), asked->id));
        }
    OutputFolder folder(request.folder);
    result.context = make_context({}, request.command, 1);
    add_inputs(result.context.inputs, lamp.opened);
    for (const auto& drive : drives)
        for (const FilesRead* files : {&drive->stage.drive.opened, &drive->stage.network.opened})
            add_inputs(result.context.inputs, *files);

    ImproveProblem problem;
    problem.table = lamp.table;
    problem.readings = sought.sought;
    problem.limits = request.limits;
    problem.regulation = rows ? &*rows : nullptr;
    for (const auto& drive : drives)
        problem.drives.push_back(drive->moments);
    result.floor_cd = problem.floor_cd = request.floor_cd.value_or(0.001 * peak_of(lamp.table).cd);
    result.narrowest_deg = problem.narrowest_deg = request.narrowest_deg;
    const ImprovedBeam found = improve_beam(problem, [&](const QuadraticProgramme& programme) {
        QuadraticSolution solution = solved_by_ipopt(programme);
        result.solver = solution.by;
        return solution;
    });
    result.steps = found.steps;
    result.binding = found.binding;
    result.gain_missed = found.gain_missed;
    result.settled = found.settled;
    result.variables = static_cast<int>(found.variables);

    result.lamp = lamp.name;
    result.written = request.lamp.stem().string() + "-improved" + request.extension;
    LampFile changed = lamp;
    changed.table = rounded(lamp.table, found.table);
    changed.measured.reset();
    changed.declared_flux_lm.reset();
    changed.labels.emplace_back("OTHER", fmt::format("changed by fernlicht improve, from {}", request.lamp.filename().string()));
    write_lamp(changed, request.folder / result.written);

    // The written file, read as any other.
    const LampFile again = read_lamp(request.folder / result.written);
    const StagedDrives proof = staged(request.drives(request.folder / result.written), request.ticks);
    for (std::size_t i = 0; i < result.readings.size(); ++i) {
        ImprovedReading& line = result.readings[i];
        const std::size_t k = sought.sought[i].drive;
        line.foretold = found.foretold[i];
        line.stepped = found.found[i];
        line.found = ReadingOfLight(line.reading, proof[k]->stage.drive, proof[k]->stage.route, proof[k]->moments).value(proof[k]->moments);
        line.met = holds(line.found, line.at_least ? std::optional(line.bound) : std::nullopt,
                         line.at_least ? std::nullopt : std::optional(line.bound))
                       .value_or(false);
    }
    tell_tables(result, lamp.table, again.table);
    if (rows)
        tell_regulation(result, *asked, rows->before(), rows->check(again.table));
    request.write(result);
    folder.finish();
    return result;
}

} // namespace fernlicht
