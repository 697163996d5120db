// Nights of a small study whose changes are known: two lamps on three drives, readings that repeat to the last bit, times that do not.
#pragma once

#include "runner/experiments/history/night_of_study.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace fernlicht::tests {

/// 2026-01-01 for 0.
inline std::string date_of_night(int night) {
    return night < 31 ? fmt::format("2026-01-{:02}", night + 1) : fmt::format("2026-02-{:02}", night - 30);
}

/// What is so on a night. A change of a hash without one of a factor moves nothing.
struct World {
    std::map<std::string, int> version = {}; ///< of a lamp's file, a drive, a road, a folder of the program: its hash
    std::string driver = "Mesa 22.3.6";
    std::map<std::string, double> lamp_light = {}; ///< by lamp: its reach and light
    double program_area = 1.0;                     ///< what the program makes of areas
    double drift_of_halogen = 1.0;                 ///< of its illuminance on the probe
    double last_digits = 0.0;                      ///< relative, of what a driver rounds otherwise
    double slow = 1.0;

    std::string hash(const std::string& name) const {
        const auto found = version.find(name);
        const std::string text = fmt::format("{} {}", name, found == version.end() ? 0 : found->second);
        return content_hash(text.data(), text.size());
    }
};

class PlantedNights {
  public:
    explicit PlantedNights(std::uint64_t seed) : generator_(seed) {
        for (const char* drive : drives)
            for (const char* lamp : lamps)
                for (const char* reading : {"reach_5lx_target_own_m", "reach_1lx_road_own_m", "area_5lx_road_all_m2", "probe_kerb_lx"})
                    base_[fmt::format("{}_{} {}", drive, lamp, reading)] = 10.0 + 90.0 * share();
    }

    /// As the study would read in that world; noise of times comes from the seed.
    StudyResult play(int night, const World& world) {
        StudyResult result;
        result.study.name = result.study.title = "planted";
        result.study.decide = {"reach_5lx_target_own_m"};
        for (const char* lamp : lamps)
            result.study.lamps.emplace_back().name = lamp;
        result.study.conditions.times_of_day = {{.name = "night"}};
        result.context.backend = "egl";
        result.context.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
        result.context.gl_version = world.driver;
        result.context.cpu = "Some CPU @ 2 GHz (avx2)";
        result.context.os = "Debian 12";
        result.context.started_utc = date_of_night(night) + "T02:00:00Z";
        for (const char* drive : drives)
            for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
                result.cells.push_back(cell_of(drive, lamp, world));
        return result;
    }

    /// What a cell reads in that world.
    std::map<std::string, double> readings(const std::string& cell, const World& world) const {
        std::map<std::string, double> all;
        const std::string lamp = cell.substr(cell.find('_') + 1);
        const auto light = world.lamp_light.find(lamp);
        for (const auto& [name, base] : base_)
            if (name.starts_with(cell + " ")) {
                const std::string reading = name.substr(cell.size() + 1);
                double value = base;
                value *= reading.starts_with("area") ? world.program_area : light == world.lamp_light.end() ? 1.0 : light->second;
                value *= reading.starts_with("probe") && lamp == "halogen" ? world.drift_of_halogen : 1.0;
                value *= 1.0 + world.last_digits * std::sin(base);
                all[reading] = value;
            }
        return all;
    }

    static inline const std::vector<const char*> drives{"straight", "s-bend", "country"}, lamps{"halogen", "xenon"};

  private:
    double share() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }

    CellResult cell_of(const std::string& drive, std::size_t lamp, const World& world) {
        CellResult cell;
        cell.cell.lamp = lamp;
        cell.cell.name = drive + "_" + lamps[lamp];
        cell.cell.condition = "night";
        cell.drive = drive;
        for (const auto& [name, value] : readings(cell.cell.name, world)) {
            const ReadingKey key = key_of(name).value();
            cell.readings[key] = {key, value};
        }
        cell.readings[key_of("frame_time_median_ms").value()] = {key_of("frame_time_median_ms").value(), 10.0 + share()};
        cell.inputs = {{InputKind::drive, drive + ".yaml", world.hash(drive)},
                       {InputKind::road, drive + ".xodr", world.hash(drive + ".xodr")},
                       {InputKind::lamp, std::string(lamps[lamp]) + "-low.ies", world.hash(lamps[lamp])}};
        for (const char* folder : {"scenarios", "metrics", "renderer", "runner"})
            cell.inputs.push_back({InputKind::program, folder, world.hash(folder)});
        cell.inputs.push_back({InputKind::library, "OpenCV", "4.6.0"});
        cell.inputs.push_back({InputKind::device, "renderer", "llvmpipe (LLVM 15.0.6, 256 bits)"});
        cell.inputs.push_back({InputKind::device, "driver", world.driver});
        double normal = -6.0;
        for (int i = 0; i < 12; ++i)
            normal += share();
        if (drive != "country") // a few cells are timed
            cell.frame_s = 0.012 * world.slow * (1.0 + 0.015 * normal);
        return cell;
    }

    std::map<std::string, double> base_;
    std::mt19937_64 generator_;
};

} // namespace fernlicht::tests
