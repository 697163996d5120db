#include "runner/commands/lamp_command.h"

#include "metrics/regulation/fmvss108_adaptive.h"
#include "scenarios/values/errors.h"
#include "scenarios/values/pose.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fernlicht {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& found, const std::string& expected) {
    throw InputError({{}, 0, 0, option}, found, expected);
}

AngleBox dimmed_of(const std::vector<double>& edges) {
    const AngleBox box{edges[0], edges[1], edges[2], edges[3]};
    if (!(box.left_deg >= -90.0 && box.left_deg < box.right_deg && box.right_deg <= 90.0 && box.bottom_deg >= -90.0 &&
          box.bottom_deg < box.top_deg && box.top_deg <= 90.0))
        refuse("--dimmed", fmt::format("found {}", fmt::join(edges, " ")), "degrees of the left, right, bottom and top edge");
    return box;
}

} // namespace

void AdaptiveRequest::check() const {
    const auto need = [](const char* option, const std::vector<double>& numbers, bool good, const char* expected) {
        if (!good)
            refuse(option, fmt::format("found {}", fmt::join(numbers, " ")), expected);
    };
    const auto within = [](double value, double least, double most) { return value >= least && value <= most; };
    if (!dimmed_deg.empty())
        dimmed_of(dimmed_deg);
    need("--other-size", other_size_m, within(other_size_m[0], 0.01, 100.0) && within(other_size_m[1], 0.01, 100.0),
         "a width and a height from 0.01 to 100 m");
    need("--lamp-at", lamp_at_m, within(lamp_at_m[0], -5.0, 5.0) && within(lamp_at_m[1], 0.0, 5.0),
         "metres left of the car's middle, from -5 to 5, and above the road, up to 5");
    need("--margin", {margin_deg}, within(margin_deg, 0.0, 10.0), "degrees from 0 to 10");
    if (!other_m.empty()) {
        need("--other", other_m, within(other_m[0], 0.1, 10'000.0) && within(other_m[1], -10'000.0, 10'000.0),
             "metres ahead of the lamp, from 0.1, and left of the car's middle, up to 10000");
        return;
    }
    const AdaptiveRequest usual;
    const char* const alone = other_size_m != usual.other_size_m ? "--other-size"
                              : lamp_at_m != usual.lamp_at_m     ? "--lamp-at"
                              : margin_deg != usual.margin_deg   ? "--margin"
                                                                 : nullptr;
    if (alone)
        refuse(alone, "found without --other", "--other AHEAD LEFT with it");
}

AngleBox spare_other(LampFile& lamp, const AdaptiveRequest& request, std::string& how) {
    if (!lamp.pixels)
        refuse("--other", "found with " + printable(lamp.name, 90) + ", none of whose parts dims by itself",
               "a pixel lamp, or the file of the dimmed state, of fmvss108-adb with --dimmed");
    OtherUser other;
    other.ahead_m = request.other_m[0];
    other.left_m = request.other_m[1];
    other.width_m = request.other_size_m[0];
    other.height_m = request.other_size_m[1];
    const LampPlace place{.position_m = {0.0, request.lamp_at_m[0], request.lamp_at_m[1]}};
    const std::optional<SparingState> state = sparing_state(*lamp.pixels, other, place, request.margin_deg);
    if (!state)
        refuse("--other", fmt::format("no pixel lights a place {} m ahead and {} m to the left", other.ahead_m, other.left_m),
               "someone whom the lamp lights");
    lamp.table = lamp.pixels->table(state->levels);
    how = fmt::format(
        "assumed: pixels are dark for what is {:g} m wide and {:g} m high {:g} m ahead of the lamp and {:g} m left of the car's "
        "middle, with {:g} degrees to each side; the lamp is {:g} m left of the middle and {:g} m above the road",
        other.width_m, other.height_m, other.ahead_m, other.left_m, request.margin_deg, request.lamp_at_m[0], request.lamp_at_m[1]);
    return state->spared;
}

int lamp_adaptive(const LampRequest& request) {
    const AdaptiveRequest& asked = request.adaptive;
    asked.check();
    if (!asked.asked())
        refuse("--regulation", fmt::format("found {} and not where the beam is dimmed", adaptive_table), "--other or --dimmed with it");
    if (request.left_hand_traffic)
        refuse("--left-hand-traffic", fmt::format("{}, which has one form for all traffic", adaptive_table), "no flag");
    if (request.scale != 1.0 || request.mirror || !request.subtract.empty())
        refuse("--regulation", fmt::format("found {} with a lamp that is changed", adaptive_table), "the lamp as it is, and --add");
    if (!request.other_side.empty())
        refuse("--other-side", fmt::format("found with {}, which judges the beam by itself", adaptive_table),
               "--add, which adds the low beam");
    LampRequest alone = request;
    alone.add.clear();
    LampFile lamp = lamp_of(alone);
    std::string how = "the file is the beam in the state that is dimmed there";
    AngleBox dimmed = asked.other_m.empty() ? dimmed_of(asked.dimmed_deg) : spare_other(lamp, asked, how);
    if (!asked.dimmed_deg.empty())
        dimmed = dimmed_of(asked.dimmed_deg);
    std::vector<std::string> names{lamp.name};
    for (const std::filesystem::path& path : request.add) {
        const LampFile other = read_lamp(path, request.reading);
        lamp.table = sum(lamp.table, other.table);
        names.push_back(other.name);
    }
    CheckOptions options;
    options.aim = requested_aim(request);
    options.as_filed = false; // rows are cut to the aimed lamp's dimmed area
    std::optional<LampFile> aim_by;
    if (!request.aim_by.empty()) {
        aim_by = read_lamp(request.aim_by, request.reading);
        options.aim_by = &aim_by->table;
        const Direction turned = aim_of(aim_by->table, rule_of_aim_by(options.aim.value_or(AimRule::as_is))).turned;
        dimmed = {dimmed.left_deg + turned.h_deg, dimmed.right_deg + turned.h_deg, dimmed.bottom_deg + turned.v_deg,
                  dimmed.top_deg + turned.v_deg};
    } else if (options.aim && *options.aim != AimRule::as_is)
        refuse("--aim-rule", "found without the lower beam whose aim the beam keeps", "--aim-by LOWER with it");
    Regulation r = fmvss108_adaptive(dimmed, asked.tables[0], asked.tables[1]);
    r.notes.push_back(how);
    if (!asked.other_m.empty() && request.add.empty())
        r.notes.emplace_back("judged without a low beam: where the pixels shine beside one, add it with --add FILE");
    return tell_regulation({r, {fmt::format("{}", fmt::join(names, " + "))}, check_regulation(r, {lamp.table}, options)}, request);
}

void add_adaptive_options(CLI::App& command, AdaptiveRequest& request) {
    const char* group = "Adaptive beams (of --regulation fmvss108-adb, r149-adb-... and r123-adb-...)";
    const auto add = [&](const char* name, std::vector<double>& numbers, const char* text, const char* names) {
        return command.add_option(name, numbers, text)
            ->expected(static_cast<int>(numbers.empty() ? 2 : numbers.size()))
            ->option_text(names)
            ->group(group);
    };
    add("--other", request.other_m, "place of the vehicle that a pixel lamp spares: ahead of the lamp, left of the car's middle, in m",
        "AHEAD LEFT");
    add("--other-size", request.other_size_m, "its width and height in m", "WIDTH HEIGHT")->default_str("1.8 1.5");
    add("--lamp-at", request.lamp_at_m, "where the lamp is: left of the car's middle and above the road, in m", "LEFT UP")
        ->default_str("0.45 0.65");
    command.add_option("--margin", request.margin_deg, "degrees of dark on each side of it")
        ->option_text("DEG")
        ->capture_default_str()
        ->group(group);
    command.add_option("--dimmed", request.dimmed_deg, "of fmvss108-adb: the area that counts as dimmed, in degrees of the file as filed")
        ->expected(4)
        ->option_text("LEFT RIGHT BOTTOM TOP")
        ->default_str("the other")
        ->group(group);
    command.add_option("--adb-tables", request.tables, "of fmvss108-adb: tables of the lower and of the upper beam")
        ->expected(2)
        ->option_text("LOWER UPPER")
        ->default_str("fmvss108-lb2v-vol fmvss108-ub2")
        ->group(group);
}

} // namespace fernlicht
