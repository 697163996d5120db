// A bench as it might have been, with figures that are easy to work out.
#pragma once

#include "runner/experiments/bench/bench_result.h"

namespace fernlicht::tests {

/// Two moments, seven rounds. texturing-only takes 10 ms but 20 in round 3; full twice that; clamped, which is full up to 1 % of noise;
/// light-map a tenth of it.
inline BenchResult sample_bench() {
    BenchResult result;
    result.context.command = "fernlicht bench";
    result.context.started_utc = "2026-01-31T22:15:00Z";
    result.context.seed = 5;
    result.context.backend = "egl";
    result.context.gl_renderer = "llvmpipe <&>";
    result.context.cpu = "a CPU (avx2)";
    result.context.versions = {{"fernlicht", "0.1.0"}};
    result.context.inputs = {{"a.yaml", 12, "00112233445566778899aabbccddeeff"}};
    result.cores = 2;
    result.load_before = {0.25, 0.5, 1.0};
    result.load_after = {1.5, 0.75, 1.0};
    result.others.cores = 0.1;
    result.drive = "night";
    result.variant = "xenon";
    result.width_px = 640;
    result.height_px = 480;
    result.moments = {{0, 0.0}, {30, 1.0}};
    result.rounds_planned = 7;
    result.warm_up_plays = 2;
    result.gpu_not_measured = "the driver draws on the CPU";
    const auto add = [&](const char* name, int thesis_row, const char* thesis_fps, double factor, double noise) {
        BenchedTechnique benched;
        benched.row.name = name;
        benched.row.thesis_row = thesis_row;
        benched.row.thesis_fps = thesis_fps;
        for (int round = 0; round < 7; ++round) {
            const double frame_s = (round == 3 ? 0.020 : 0.010) * factor * (round % 2 == 0 ? 1.0 + noise : 1.0 - noise);
            benched.samples.frame_s.push_back(frame_s);
            benched.samples.cpu_s.push_back(2.0 * frame_s);
            benched.samples.latency_s.insert(benched.samples.latency_s.end(), {1.5 * frame_s, 2.5 * frame_s});
        }
        benched.work = {{1, 20, 3, 5, 2, 4, 7, 4000, 300000, 3 << 20}, {1, 30, 3, 5, 2, 4, 7, 5000, 310000, 3 << 20}};
        result.techniques.push_back(std::move(benched));
    };
    add("texturing-only", 3, ">= 60", 1.0, 0.0);
    add("full", 4, "~22", 2.0, 0.0);
    add("clamped", 8, "~30", 2.0, 0.01);
    add("light-map", 0, "", 0.1, 0.0);
    result.orders.assign(7, {2, 0, 3, 1});
    return result;
}

} // namespace fernlicht::tests
