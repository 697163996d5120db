#include "runner/experiments/stability/stability_case.h"

#include "scenarios/values/errors.h"

#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <fstream>

namespace fernlicht {

Device& StabilityBench::device() {
    if (!device_)
        device_.emplace(open_device(backend_));
    return *device_;
}

std::filesystem::path StabilityBench::file(const std::string& name) {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error)
        throw DeviceError(fmt::format("{} cannot be made: {}", folder_.string(), error.message()));
    return folder_ / name;
}

std::filesystem::path StabilityBench::write(const std::string& name, std::string_view content) {
    std::filesystem::path path = file(name);
    std::ofstream stream(path, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!stream.flush())
        throw DeviceError(fmt::format("{} cannot be written", path.string()));
    return path;
}

void Found::add(double trial_error, const std::string& trial, int values) {
    ++trials;
    judged += values;
    if (!std::isfinite(error) && !where.empty())
        return;
    if (where.empty() || !(trial_error <= error)) {
        error = trial_error;
        where = trial;
    }
}

StabilityRow judge(const StabilityCase& one, StabilityBench& bench) {
    StabilityRow row;
    row.of = &one;
    const auto began = std::chrono::steady_clock::now();
    try {
        Found worst; // of a case that throws nothing is told but that
        one.measure(bench, worst);
        row.found = worst;
        row.passed = std::isfinite(row.found.error) && row.found.error <= one.bound;
    } catch (const DeviceError&) {
        if (!bench.drew())
            throw;
        row.found.where = "the device gave up";
    } catch (const std::exception& thrown) {
        row.found.error = std::nan("");
        row.found.where = fmt::format("thrown: {}", thrown.what());
    }
    // The folder may have a name of chance; what is said of its files may not depend on it.
    for (std::size_t at; (at = row.found.where.find(bench.folder() + "/")) != std::string::npos;)
        row.found.where.erase(at, bench.folder().size() + 1);
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return row;
}

const std::vector<StabilityCase>& stability_cases() {
    static const std::vector<StabilityCase> all = [] {
        std::vector<StabilityCase> cases;
        for (const auto family : {lamp_cases, camera_cases, table_cases, tone_cases, geometry_cases, shadow_cases, shadow_plane_cases,
                                  shadow_map_cases, shadow_volume_cases, road_cases, image_cases, time_cases, number_cases, motion_cases,
                                  weather_cases, traffic_cases, equation_cases})
            for (StabilityCase& one : family())
                cases.push_back(std::move(one));
        return cases;
    }();
    return all;
}

} // namespace fernlicht
