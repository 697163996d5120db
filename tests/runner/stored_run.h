// A small run on disk, made without drawing: for tests of what is done with runs.
#pragma once

#include "runner/commands/run_files.h"
#include "runner/files/picture_file.h"
#include "runner/findings/report.h"
#include "runner/judge/baselines.h"

namespace fernlicht::tests {

namespace fs = std::filesystem;

/// A small run on disk: two lamp sets, two frames each, a few readings. `light` scales all of it.
struct StoredRun {
    explicit StoredRun(const fs::path& folder_, double light = 1.0) : folder(folder_) {
        fs::create_directories(folder / "frames");
        report.context.backend = "egl";
        report.context.gl_renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
        report.context.cpu = "Some CPU @ 2 GHz (avx2)";
        report.context.command = "fernlicht run straight.yaml";
        report.context.started_utc = "2026-01-31T22:15:00Z";
        for (const char* lamp_set : {"halogen", "xenon"})
            report.played.push_back(played(lamp_set, light));
        write_report(report, folder);
    }

    PlayedCell played(const std::string& lamp_set, double light) const {
        PlayedCell result;
        result.drive = "straight";
        result.lamp_set = lamp_set;
        result.technique = "photometric";
        result.ticks_planned = result.ticks_done = 20;
        result.input_hashes = {{"drive", "hash of the drive"}, {"road", "hash of the road"}};
        result.readings = {{key_of("reach_5lx_road_own_m").value(), 60.0 * light},
                           {key_of("reach_1lx_road_own_m").value(), Value::not_measured("beyond")},
                           {key_of("frame_time_median_ms").value(), 12.5 + 100.0 * light}};
        for (const int tick : {0, 10}) {
            const std::string exr = "frames/" + lamp_set + "-" + std::to_string(tick) + ".exr";
            write_frame(exr, tick, light);
            result.frames.push_back({tick, 0.1 * tick, "driver", "", exr});
        }
        return result;
    }

    void write_frame(const std::string& exr, int tick, double light) const {
        Frame frame;
        frame.illuminance_lx = Image<float>(64, 48);
        frame.luminance_cdm2 = Image<float>(64, 48);
        for (std::size_t i = 0; i < frame.illuminance_lx.size(); ++i) {
            const std::size_t row = i / 64;
            frame.illuminance_lx.pixels()[i] = static_cast<float>(light * (1.0 + static_cast<double>(i % 64) + tick));
            frame.luminance_cdm2.pixels()[i] = static_cast<float>(light * 0.05 * static_cast<double>(row));
        }
        View view;
        view.name = "driver";
        view.width_px = 64;
        view.height_px = 48;
        Moment moment;
        moment.tick = tick;
        write_exr(frame, moment, view, folder / exr);
    }

    std::vector<Verdict> judged(const fs::path& baselines) const {
        return judge_against_baselines(report.played[0], report.context, folder, baselines, "photometric");
    }

    fs::path folder;
    Report report;
};

} // namespace fernlicht::tests
