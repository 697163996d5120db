// Numbers themselves: rounding as IEEE 754 has it, denormals, the largest, and none that is not finite in a file; each light equation by
// itself in float against double, on the CPU and on the device.
#include "renderer/reference/reference.h"
#include "runner/experiments/run/run_drives.h"
#include "runner/experiments/run/run_report.h"
#include "runner/experiments/stability/equations.h"
#include "runner/experiments/stability/trial.h"
#include "runner/files/picture_file.h"
#include "runner/findings/moment_columns.h"

#include <algorithm>
#include <cctype>
#include <cfenv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace fernlicht {
namespace {

using namespace stability;

/// A value that the compiler does not know.
template <class T> T unknown(T value) {
    volatile T hidden = value;
    return hidden;
}

template <class T> void try_type(const std::string& type, T big, std::vector<std::string>& broken) {
    const auto must = [&](bool holds, const char* rule) {
        if (!holds)
            broken.push_back(type + ": " + rule);
    };
    using Limits = std::numeric_limits<T>;
    const T zero = unknown(T(0)), one = unknown(T(1)), nan = unknown(Limits::quiet_NaN()), infinity = unknown(Limits::infinity());
    // With -ffinite-math-only these comparisons are folded away.
    must(nan != nan && !(nan == nan) && !(nan < one) && std::isnan(nan * zero), // NOLINT(misc-redundant-expression): that is asked
         "NaN is no number");
    must(one / zero == infinity && std::isinf(infinity) && infinity > Limits::max(), "1 / 0 is infinite");
    // -fno-signed-zeros, -freciprocal-math
    must(std::signbit(-zero) && one / -zero == -infinity && !std::signbit(-zero + zero), "zeros have signs");
    const T three = unknown(T(3)), ten = unknown(T(10));
    must(three / ten != three * (one / ten) || sizeof(T) == 4, "a quotient is no product with the reciprocal");
    // -fassociative-math would give back 1.
    must((one + big) - big == zero && one + (big - big) == one, // NOLINT(misc-redundant-expression): that is asked
         "sums are taken in the order written");
    // (1 + e)^2 = 1 + 2 e + e^2: rounded the product loses e^2, fused it keeps it.
    const T e = unknown(Limits::epsilon()), factor = one + e, product = factor * factor;
    must(unknown(factor) * unknown(factor) + unknown(-product) == zero && std::fma(factor, factor, -product) == e * e,
         "a product is rounded before it is added");
    const T smallest = unknown(Limits::min()), half = unknown(T(0.5));
    must(smallest * half > zero && (smallest * half) * (one + one) == smallest, "denormals are kept");
    must(unknown(Limits::denorm_min()) > zero, "the least denormal is not 0");
}

/// On the calling thread: each rule of IEEE 754 that does not hold, in words; empty where all do. Tried are NaN, signed zeros, infinities,
/// the order of sums, products that are not fused into sums, denormals, and where there is one, the control register (MXCSR).
std::vector<std::string> ieee754_violations() {
    std::vector<std::string> broken;
    try_type<float>("float", 1e9F, broken);
    try_type<double>("double", 1e17, broken);
    if (std::fegetround() != FE_TONEAREST)
        broken.emplace_back("rounding is to nearest");
#if defined(__SSE2__)
    constexpr unsigned flush_to_zero = 1U << 15U, denormals_are_zero = 1U << 6U;
    if ((_mm_getcsr() & (flush_to_zero | denormals_are_zero)) != 0)
        broken.emplace_back("MXCSR: neither flush-to-zero nor denormals-are-zero is set");
#endif
    return broken;
}

/// Before and after a device, Embree and oneTBB had their chance to set flush-to-zero, on this thread and on theirs.
void float_rules(StabilityBench& bench, Found& worst) {
    const auto add = [&](const std::string& at) {
        const std::vector<std::string> broken = ieee754_violations();
        worst.add(static_cast<double>(broken.size()), broken.empty() ? "every rule holds " + at : fmt::format("{} {}", broken.front(), at));
    };
    add("at first");
    Scene scene = scene_of_sheet("wall", 0, {10.0, 3.0, -3.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 6.0});
    Moment moment = moment_of(lamp(constant_table(1000.0), {0.0, 0.0, 0.0}));
    const View view = camera({0.0, 0.0, 0.0}, 0.0, 0.0, 30.0, 32, 32);
    Renderer renderer(bench.device(), scene, unshadowed());
    renderer.draw(moment, view, everything);
    add("after rendering");
    const Reference reference(scene);
    ReferenceSettings settings;
    settings.max_samples = 16;
    reference.render(moment, view, {.illuminance = true}, settings);
    add("after the reference");
    // As many tasks as to reach every worker that the two have left.
    const int broken = tbb::parallel_reduce(
        tbb::blocked_range<int>(0, 4096, 1), 0,
        [](const tbb::blocked_range<int>& range, int sum) {
            for (int i = range.begin(); i < range.end(); ++i)
                sum += static_cast<int>(ieee754_violations().size());
            return sum;
        },
        std::plus<>());
    worst.add(broken, "in workers of oneTBB");
}

/// Lamps so weak that their light is denormal in float, or none.
void denormals(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("wall", 1, {10.0, 3.0, -3.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 6.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    for (const double cd : {1e-300, 1e-45, 1e-42, 1e-38, 1e-36, 1e-30}) {
        Moment moment = moment_of(lamp(constant_table(cd), {0.0, 0.0, 0.0}));
        const View view = camera({0.0, 0.0, 0.0}, 0.0, 0.0, 30.0, 16, 16);
        const Frame frame = renderer.draw(moment, view, everything);
        const Twin twin(scene, false);
        for (int i = 0; i < 16; ++i) {
            const double truth = twin.pixel(moment, view, i + 0.5, i + 0.5).illuminance_lx;
            const double off = std::abs(static_cast<double>(frame.illuminance_lx.at(i, i)) - truth);
            // Five products, each of which may lose what is below the smallest normal number.
            worst.add(not_finite(frame) > 0 ? unbounded : off / (1e-6 * truth + 5.0 * 1.18e-38 * 100.0), fmt::format("{:.0e} cd", cd));
        }
    }
}

/// The brightest lamps that a file may hold, eight of them, at a millimetre and at ten metres.
void brightest(StabilityBench& bench, Found& worst) {
    Scene scene = scene_of_sheet("wall", 1, {0.001, 3.0, -3.0}, {0.0, -6.0, 0.0}, {0.0, 0.0, 6.0});
    add_sheet(scene, "road", 0, {-20.0, -10.0, -1.0}, {40.0, 0.0, 0.0}, {0.0, 20.0, 0.0});
    Renderer renderer(bench.device(), scene, unshadowed());
    Moment moment;
    for (int i = 0; i < 8; ++i) {
        moment.lamps.push_back(lamp(constant_table(1e12), {0.0, 0.001 * i, 0.0}, 0.0, -0.3));
        moment.lamps.back().intensity_factor = 1.0;
    }
    for (const glm::dvec3& eye : {glm::dvec3(-0.5, 0.0, 0.0), glm::dvec3(-5.0, 0.0, 1.0)}) {
        const AgainstTwin found = against_twin(renderer, scene, moment, camera(eye, 0.0, -0.1, 60.0, 32, 32));
        worst.add(found.error(), fmt::format("seen from {} m: {}, {:.1e} relative", eye.x, found.where, found.worst_relative),
                  found.compared);
    }
}

/// Numbers that are none, in a text of JSON or CSV.
std::size_t not_numbers(const std::string& text) {
    constexpr std::string_view between = " \t\r\n,:[]}", words[] = {"nan", "inf", "infinity"};
    std::size_t found = 0;
    for (std::size_t begin = 0, end = 0; (begin = text.find_first_not_of(between, end)) != std::string::npos;) {
        end = std::min(text.find_first_of(between, begin), text.size());
        std::string word = text.substr(text[begin] == '-' ? begin + 1 : begin, end - begin - (text[begin] == '-' ? 1 : 0));
        std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        found += static_cast<std::size_t>(std::ranges::count(words, word));
    }
    return found;
}

struct Played {
    Report report;
    std::filesystem::path folder;
};

/// Plays a drive file from start to end, as `fernlicht run` does.
Played play_to_the_end(StabilityBench& bench, const std::filesystem::path& drive, const std::string& name) {
    bench.close_device();
    Played played;
    played.folder = bench.file(name);
    std::error_code ignored;
    std::filesystem::remove_all(played.folder, ignored);
    RunOptions options;
    options.folder = played.folder;
    options.quiet = true;
    options.ticks = {0, 1};
    options.backend = bench.backend();
    options.write = [](const Report& report, const std::filesystem::path& folder) {
        write_file(folder / "report.json", report_json(report));
    };
    played.report = run_drives({read_drive(drive)}, options);
    return played;
}

/// A dark lamp, the brightest lamp, probes in the dark and right at a lamp: whatever is written must be a number.
void reports(StabilityBench& bench, Found& worst) {
    for (const auto& [name, cd] : {std::pair("dark.csv", 0.0), std::pair("brightest.csv", 1e12)})
        write_matrix(bench, name, {{-40.0, 40.0}, {-20.0, 20.0}, {cd, cd, cd, cd}, {}, BetweenSamples::linear_cd});
    for (const char* file : {"dark.csv", "brightest.csv"}) {
        const std::string more = fmt::format(
            "    left: {{file: {}, position_m: [3.5, 0.6, 0.65]}}\nviews: {{driver: {{resolution_px: [64, 48]}}}}\n"
            "capture: {{all: true}}\nmeasure:\n  extent: {{ahead_m: 60, beside_m: 6}}\n"
            "  probes: {{at_lamp: {{ahead_m: 3.5, left_m: 0.6, above_m: 0.65}}, dark: {{ahead_m: -50}}, road: {{ahead_m: 20}}}}",
            file);
        const Played played = play_to_the_end(bench, write_drive_file(bench, "report.yaml", more), "report");
        FilesRead read;
        worst.add(static_cast<double>(not_numbers(read_file(played.folder / "report.json", read))),
                  fmt::format("report.json with {}", file));
        for (const PlayedCell& lamp_set : played.report.played) // which throws where a figure is no number
            worst.add(moment_columns(lamp_set).empty() ? std::nan("") : 0.0, fmt::format("moments with {}", file));
        std::size_t pictures = 0, values = 0, bad = 0;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(played.folder))
            if (entry.path().extension() == ".exr")
                for (const PictureChannel& channel : read_exr(entry.path())) {
                    ++pictures;
                    values += channel.values.size();
                    bad +=
                        static_cast<std::size_t>(std::ranges::count_if(channel.values.pixels(), [](float v) { return !std::isfinite(v); }));
                }
        worst.add(pictures == 0 ? std::nan("") : static_cast<double>(bad),
                  fmt::format("{} channels of EXR, {} values, with {}", pictures, values, file), static_cast<int>(values));
    }
}

/// A probe nearer to a lamp than its photometric distance is marked, one farther away is not, and the report says so.
void near_field(StabilityBench& bench, Found& worst) {
    const std::string more =
        "    left: {file: even.csv, position_m: [3.5, 0.6, 0.65], photometric_distance_m: 10}\nviews: {driver: {resolution_px: [64, 48]}}\n"
        "measure:\n  extent: false\n  probes: {near: {ahead_m: 3.501, left_m: 0.6, above_m: 0.65}, far: {ahead_m: 30}}";
    const Played played = play_to_the_end(bench, write_drive_file(bench, "near.yaml", more), "near");
    std::size_t near = 0, far = 0;
    for (const PlayedCell& lamp_set : played.report.played) {
        for (const Reading& reading : lamp_set.readings) {
            const bool marked = reading.where.find("near-field") != std::string::npos;
            near += (reading.key.subject == "near") && !marked ? 1U : 0U;
            far += (reading.key.subject == "far") && marked ? 1U : 0U;
        }
        worst.add(std::ranges::any_of(lamp_set.notes, [](const std::string& note) { return note.find("near field") != std::string::npos; })
                      ? 0.0
                      : 1.0,
                  "the report's notes");
    }
    worst.add(static_cast<double>(near), "readings nearer than 10 m that are not marked");
    worst.add(static_cast<double>(far), "readings farther than 10 m that are marked");
    worst.add(played.report.played.empty() ? 1.0 : 0.0, "nothing played");
}

std::string text_of(const Equation& equation, const EquationArguments& x) {
    std::string text;
    for (const EquationInput& input : equation.inputs)
        for (std::size_t slot = input.slot; slot < input.slot + (input.kind == EquationInput::Kind::direction ? 3 : 1); ++slot)
            text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", x[slot]);
    return text;
}

void examined(const Equation& equation, StabilityBench& bench, Found& worst) {
    const EquationBound& bound = bound_of(equation.function);
    const Examination found = examine(equation, bench.device(), bench.thorough ? 10.0 : 1.0, StabilityBench::seed);
    const EquationError* worse = &found.in_float;
    for (const EquationError* other : {&found.in_packs, &found.on_gpu})
        worse = other->error <= worse->error ? worse : other;
    const std::string condition = found.condition > 1e4 ? "unbounded" : fmt::format("{:.2g}", found.condition);
    worst.add(worse->error,
              fmt::format("C++ {:.2g}, packs {:.2g}, device {:.2g}, condition {}{}", found.in_float.error, found.in_packs.error,
                          found.on_gpu.error, condition, worse->error > 0.0 ? "; worst at " + text_of(equation, worse->at) : std::string()),
              static_cast<int>(found.points));
    if (bound.condition > 0.0 && found.condition > 1.01 * bound.condition)
        worst.add(unbounded, fmt::format("condition {:.3g} at {}, stated is {:g}", found.condition, text_of(equation, found.condition_at),
                                         bound.condition));
}

} // namespace

std::vector<StabilityCase> number_cases() {
    return {
        {"number", "float-rules", "fast-math, fused a * b + c, flush-to-zero set by a library in some thread", 0.0, "rules broken",
         "same inputs, same bytes: C++ rounds after each operation, keeps NaN, signed zeros and denormals", float_rules},
        {"number", "denormals", "lamps of 1e-300 to 1e-30 cd: products below the smallest normal float", 1.0,
         "of 6e-36 lx and 1e-6 of the light",
         "a GPU may flush each of five factors to 0 below 1.2e-38, which the albedo and distance here scale by up to 100", denormals},
        {"number", "brightest", "eight lamps of 1e12 cd at 1 mm: 1e18 lx each, luminances, tone mapping", 1.0,
         "of the pixel's rounding bound", "the largest intensity a file may hold over the square of a millimetre is far below 3e38",
         brightest},
        {"number", "reports", "a dark lamp, one of 1e12 cd, a probe right at the lamp: whole runs", 0.0, "values that are not finite",
         "what could not be measured is not_measured, never NaN or infinity", reports},
        {"number", "near-field", "1 mm from a lamp that was measured from 10 m: a point source no more", 0.0, "readings not marked rightly",
         "the photometric distance decides; marked are the probe's readings and the run's notes", near_field},
    };
}

std::vector<StabilityCase> equation_cases() {
    std::vector<StabilityCase> cases;
    for (const Equation& equation : equations()) {
        const EquationBound& bound = bound_of(equation.function);
        cases.push_back({"equation", equation.lamp_set.empty() ? equation.function : equation.function + "-" + equation.lamp_set,
                         "float against double over " + equation.domain, bound.error, bound.of, bound.reason,
                         [&equation](StabilityBench& bench, Found& worst) { examined(equation, bench, worst); }});
    }
    return cases;
}

} // namespace fernlicht
