// What a bench found: each technique's raw samples and what machine they come from. The writers only format it.
#pragma once

#include "metrics/statistics/statistics.h"
#include "renderer/light_pass/peaks.h"
#include "renderer/renderer.h"
#include "renderer/technique.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/report.h"
#include "runner/play/interleaved_timing.h"

#include <algorithm>
#include <array>
#include <string>

namespace fernlicht {

struct BenchedTechnique {
    Technique row;
    TimingSamples samples;
    std::vector<Work> work; ///< by moment
};

/// What lighting a frame of `photometric` on the CPU takes, and what this machine could do at best.
struct Roofline {
    LightWork light; ///< of each count the median over the moments
    Peaks peaks;

    /// One thing that light asks for.
    struct Ceiling {
        const char* what;
        double a_frame, peak_per_s; ///< of a CPU second
        double floor_s() const { return a_frame / peak_per_s; }
    };
    std::array<Ceiling, 4> ceilings() const {
        return {Ceiling{"bytes", static_cast<double>(light.bytes), peaks.bytes_per_s},
                {"look-ups", static_cast<double>(light.look_ups), peaks.look_ups_per_s},
                {"operations", static_cast<double>(light.operations), peaks.operations_per_s},
                {"divisions and roots", static_cast<double>(light.divisions), peaks.divisions_per_s}};
    }
    /// That which takes longest: light takes no less CPU time.
    Ceiling bound() const {
        const std::array<Ceiling, 4> all = ceilings();
        return *std::ranges::max_element(all, {}, &Ceiling::floor_s);
    }
    double ratio() const { return light.cpu_s / bound().floor_s(); }
};

struct BenchResult : Findings {
    std::size_t cores = 0;
    std::string gl_vendor;
    std::optional<std::array<double, 3>> load_before, load_after;
    OtherLoad others;
    std::string drive, title, lamp_set;
    int width_px = 0, height_px = 0;
    std::vector<std::pair<int, double>> moments; ///< tick and time in seconds
    std::size_t rounds_planned = 0, warm_up_plays = 0;
    std::vector<std::vector<std::size_t>> orders; ///< of each round done, into `techniques`
    std::string gpu_not_measured;                 ///< why; "" where it was
    std::string lit_by;                           ///< who computed the light of `photometric`, and why; "" where it did not take part
    std::vector<BenchedTechnique> techniques;
    std::optional<Roofline> roofline;
    std::string roofline_not_measured; ///< why
};

/// `lit_by` where the CPU lit every picture.
inline constexpr std::string_view lit_by_cpu = "the CPU, each visible pixel once";

/// The technique that the others are held against: what texturing alone costs.
inline constexpr std::string_view reference_technique = "texturing-only";

/// One technique's samples, summed up. Times in seconds a frame.
struct BenchRow {
    const BenchedTechnique* benched = nullptr;
    Spread frame, cpu, latency;
    std::optional<Spread> gpu;
    double frame_deviation_s = 0.0;             ///< median absolute deviation
    std::optional<MedianInterval> frame_median; ///< 95 %
    std::optional<PairedRatio> ratio;           ///< to the reference; nullopt where that did not take part
    std::optional<Work> work;                   ///< of each count the median over the moments, the lower of two
    double frames_per_s() const { return 1.0 / frame.median; }
};
/// Of each count the median over the moments, the lower of two; nullopt for no moments.
std::optional<Work> typical_work(const std::vector<Work>& work);
LightWork typical_light(const std::vector<LightWork>& work); ///< of one at least

/// In the result's order. Techniques without a sample are left out.
std::vector<BenchRow> summarise(const BenchResult& result);

/// "slower (ratio 2.31, spread 2.25..2.40)"; "not distinguishable (ratio 1.02, spread 0.97..1.06)".
std::string verdict_text(const PairedRatio& ratio);
JsonMembers ratio_members(PairedRatio& ratio);
const char* difference_name(Difference difference); ///< "faster", "slower", "not distinguishable"

/// What makes the times doubtful, one sentence each: others at work, few rounds, an end before its time.
std::vector<std::string> bench_warnings(const BenchResult& result);

/// What was drawn on what, Table 6.1 beside ours, all other techniques, and what a frame costs.
Document document(const BenchResult& result);
/// docs/benchmarks.md and bench.schema.json describe it.
std::string bench_json(const BenchResult& result);
/// RFC 4180, one line per technique and round.
std::string bench_csv(const BenchResult& result);
/// Bars of the median time a frame with spread, in the tables' order, the ratio beside each.
plots::Drawing bench_plot(const BenchResult& result);

} // namespace fernlicht
