#include "scenarios/drives/keys/drive_keys.h"

#include "scenarios/drives/keys/seeing_keys.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

constexpr double fastest_mps = 150.0;
constexpr double kmh_in_mps = 1.0 / 3.6;
constexpr double longest_s = 1.0e6;

double speed_mps(std::string_view key, const YamlEntry& entry) {
    return key == "speed_kmh" ? entry.number(0.0, fastest_mps / kmh_in_mps) / 3.6 : entry.number(0.0, fastest_mps);
}

double speed_of_point(const YamlMap& point) {
    const auto given = point.one_of({"speed_kmh", "speed_mps"});
    if (!given)
        point.refuse_missing("speed_kmh", "speed_kmh or speed_mps");
    return speed_mps(given->first, given->second);
}

Limit read_limit(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"reading", "at_least", "at_most"});
    Limit limit;
    limit.reading = keys.require("reading").text();
    if (const auto least = keys.find("at_least"))
        limit.at_least = least->number(-1.0e12, 1.0e12);
    if (const auto most = keys.find("at_most"))
        limit.at_most = most->number(-1.0e12, 1.0e12);
    if (!limit.at_least && !limit.at_most)
        entry.refuse("a limit without a number", "at_least, at_most or both");
    if (limit.at_least && limit.at_most && *limit.at_least > *limit.at_most)
        entry.refuse(fmt::format("at_least {} above at_most {}", *limit.at_least, *limit.at_most), "a range that holds a value");
    return limit;
}

ExtentParameters read_extent(const YamlEntry& entry) {
    const YamlMap keys = entry.map({"limits_lx", "target_height_m", "ahead_m", "beside_m", "cell_m", "width_at_m"});
    ExtentParameters extent;
    if (const auto limits = keys.find("limits_lx"))
        extent.limits_lx = limits->numbers(1, 16, 1.0e-6, 1.0e6);
    extent.target_height_m = keys.number_or("target_height_m", extent.target_height_m, 0.0, 10.0);
    extent.ahead_m = keys.number_or("ahead_m", extent.ahead_m, 1.0, 2000.0);
    extent.beside_m = keys.number_or("beside_m", extent.beside_m, 0.5, 200.0);
    extent.cell_m = keys.number_or("cell_m", extent.cell_m, 0.02, 10.0);
    if (const auto widths = keys.find("width_at_m"))
        extent.width_at_m = widths->numbers(0, 16, 0.0, 2000.0);
    const double cells = extent.ahead_m / extent.cell_m * (8.0 * extent.beside_m / extent.cell_m);
    if (cells > 4.0e6)
        entry.refuse(fmt::format("a grid of {:.0f} points", cells), "at most 4000000 (larger cell_m, less ahead_m or beside_m)");
    return extent;
}

Probe read_probe(const std::string& name, const YamlEntry& entry) {
    const YamlMap keys = entry.map({"ahead_m", "left_m", "above_m"});
    Probe probe;
    probe.name = name;
    probe.ahead_m = keys.require("ahead_m").number(-2000.0, 2000.0);
    probe.left_m = keys.number_or("left_m", 0.0, -200.0, 200.0);
    probe.above_m = keys.number_or("above_m", 0.0, 0.0, 50.0);
    return probe;
}

} // namespace

std::string name_from(const std::filesystem::path& path) {
    std::string name = path.stem().string().substr(0, 64);
    for (char& c : name)
        if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_'))
            c = '-';
    if (name.empty() || name[0] == '.')
        name.insert(0, "lamp");
    return name;
}

std::vector<SpeedPoint> read_speed(const YamlMap& drive) {
    const auto given = drive.one_of({"speed_kmh", "speed_mps", "speed"});
    if (!given)
        drive.refuse_missing("speed_kmh", "speed_kmh, speed_mps or speed (a list of {at_s, speed_kmh})");
    if (given->first != "speed")
        return {{0.0, speed_mps(given->first, given->second)}};
    if (given->second.is_scalar())
        given->second.refuse("a list of {at_s, speed_kmh}; one speed for all of the drive is speed_kmh or speed_mps");
    std::vector<SpeedPoint> points;
    for (const YamlEntry& entry : given->second.list(1, 10'000)) {
        const YamlMap keys = entry.map({"at_s", "speed_kmh", "speed_mps"});
        const double time_s = keys.require("at_s").number(0.0, longest_s);
        if (!points.empty() && time_s <= points.back().time_s)
            entry.refuse(fmt::format("at_s {} after {}", time_s, points.back().time_s), "times that ascend");
        points.push_back({time_s, speed_of_point(keys)});
    }
    return points;
}

double read_step_s(const YamlMap& drive) {
    const auto given = drive.one_of({"step_s", "rate_hz"});
    if (!given)
        return 1.0 / 30.0;
    return given->first == "step_s" ? given->second.number_above(0.0, 3600.0) : 1.0 / given->second.number_above(0.0, 1.0e6);
}

Capture read_capture(const YamlMap& drive) {
    Capture capture;
    const auto given = drive.find("capture");
    if (!given)
        return capture;
    const YamlMap keys = given->map({"per_second", "all", "exr", "png"});
    capture.per_second = keys.number_or("per_second", capture.per_second, 0.0, 1.0e6);
    capture.all = keys.flag_or("all", capture.all);
    capture.exr = keys.flag_or("exr", capture.exr);
    capture.png = keys.flag_or("png", capture.png);
    return capture;
}

void read_measure(const YamlMap& keys, Drive& drive) {
    drive.extent = ExtentParameters{};
    const auto given = keys.find("measure");
    if (!given)
        return;
    const YamlMap measure = given->map({"extent", "probes", "sensors", "glare", "visibility", "homogeneity", "places"});
    if (const auto parameters = measure.find("extent")) {
        if (!parameters->is_scalar())
            drive.extent = read_extent(*parameters);
        else if (!parameters->flag())
            drive.extent.reset();
    }
    if (const auto named = measure.find("probes"))
        for (const auto& [name, entry] : named->named(1000))
            drive.probes.push_back(read_probe(name, entry));
    drive.seeing = read_seeing(measure);
}

std::vector<Limit> read_limits(const YamlMap& drive) {
    std::vector<Limit> limits;
    if (const auto given = drive.find("limits"))
        for (const YamlEntry& entry : given->list(0, 1000))
            limits.push_back(read_limit(entry));
    return limits;
}

} // namespace fernlicht
