// What is read before the first frame.
#include "renderer/beam_texture.h"
#include "renderer/projected_beam.h"
#include "scenarios/can/can_database.h"
#include "scenarios/can/candump_stream.h"
#include "scenarios/can/signal_codec.h"
#include "scenarios/lamps/eulumdat.h"
#include "scenarios/lamps/ies.h"
#include "scenarios/roads/mesh/road_mesh.h"
#include "scenarios/yaml/yaml_tree.h"
#include "tests/benchmarks/country_road.h"
#include "tests/trial.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <random>

namespace fernlicht {
namespace {

void read_ies_file(benchmark::State& state) {
    const std::string path = library_path("lamps/xenon-low.ies"), text = text_of(path);
    for (auto _ : state)
        benchmark::DoNotOptimize(read_ies(path, text, {}, {}));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_ies_file)->Unit(benchmark::kMillisecond);

/// Without symmetry: 144 planes every 2.5 degrees with 181 angles each, in cd per 1000 lm.
std::string eulumdat_text() {
    constexpr int planes = 144, angles = 181;
    std::string text = fmt::format("ACME\n2\n0\n{}\n2.5\n{}\n1\nreport\nWidget\n4711\nw.ldt\n2024\n", planes, angles);
    text += "100\n100\n50\n100\n100\n0\n0\n0\n0\n90\n100\n1\n0\n1\n1\nLED\n1000\n4000\n80\n15\n";
    for (int i = 0; i < 10; ++i)
        text += "0\n";
    for (int plane = 0; plane < planes; ++plane)
        text += fmt::format("{}\n", 2.5 * plane);
    for (int angle = 0; angle < angles; ++angle)
        text += fmt::format("{}\n", angle);
    for (int plane = 0; plane < planes; ++plane)
        for (int angle = 0; angle < angles; ++angle)
            text += fmt::format("{}.{}\n", 1000 - 5 * angle, plane % 10);
    return text;
}

void read_eulumdat_text(benchmark::State& state) {
    const std::string text = eulumdat_text();
    LampReadOptions options{.type_c_axis = TypeCAxis::horizontal};
    for (auto _ : state)
        benchmark::DoNotOptimize(read_eulumdat("w.ldt", text, options, {}));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_eulumdat_text)->Unit(benchmark::kMillisecond);

void read_opendrive_file(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(read_opendrive(country_road().drive.road_file));
}
BENCHMARK(read_opendrive_file)->Unit(benchmark::kMillisecond);

void build_road_scene(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(build_scene(country_road().network));
}
BENCHMARK(build_road_scene)->Unit(benchmark::kMillisecond);

void parse_drive_yaml(benchmark::State& state) {
    const std::string path = library_path("drives/first-light.yaml"), text = text_of(path);
    for (auto _ : state)
        benchmark::DoNotOptimize(parse_yaml(text, path));
}
BENCHMARK(parse_drive_yaml)->Unit(benchmark::kMillisecond);

/// With its four lamp files.
void read_whole_drive(benchmark::State& state) {
    const std::string path = library_path("drives/first-light.yaml");
    for (auto _ : state)
        benchmark::DoNotOptimize(read_drive(path));
}
BENCHMARK(read_whole_drive)->Unit(benchmark::kMillisecond);

void beam_texture(benchmark::State& state) {
    const CandelaTable& table = country_road().moment.lamps.front().file->table;
    for (auto _ : state)
        benchmark::DoNotOptimize(make_beam_texture(table));
}
BENCHMARK(beam_texture)->Unit(benchmark::kMillisecond);

void projected_beam(benchmark::State& state) {
    const CandelaTable& table = country_road().moment.lamps.front().file->table;
    for (auto _ : state)
        benchmark::DoNotOptimize(make_projected_beam(table, {512, 128, 8}));
}
BENCHMARK(projected_beam)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime(); // parallel inside

/// 100 000 frames of 0 to 8 bytes on two channels, as `candump -L` writes them.
std::string candump_text(const CandumpStyle& style) {
    std::string text;
    CanFrame frame;
    std::uint64_t state = 1;
    for (int i = 0; i < 100'000; ++i) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        frame.time_ns = 1'436'509'052'249'713'000 + i * 500'000LL;
        frame.channel = state >> 33 & 1 ? "can0" : "can1";
        frame.extended = state >> 34 & 1;
        frame.id = static_cast<std::uint32_t>(state >> 35) & (frame.extended ? 0x1fffffffU : 0x7ffU);
        frame.length = static_cast<std::uint8_t>(state >> 20 & 15U) < 8 ? 8 : static_cast<std::uint8_t>(state >> 20 & 7U);
        frame.data = {};
        for (std::size_t byte = 0; byte < frame.length; ++byte)
            frame.data[byte] = static_cast<std::uint8_t>(state >> (7 * byte));
        append_candump_line(text, frame, style);
        text += '\n';
    }
    return text;
}

void read_candump_text(benchmark::State& state, bool screen) {
    CandumpStyle style;
    style.form = screen ? CandumpStyle::Form::screen : CandumpStyle::Form::log;
    const std::string text = candump_text(style);
    for (auto _ : state) {
        CandumpStream stream("a.log", text);
        std::int64_t sum = 0;
        while (stream.next() != CandumpStream::What::end)
            sum += stream.line().frame.data[0];
        benchmark::DoNotOptimize(sum);
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
    state.SetItemsProcessed(state.iterations() * 100'000);
}
BENCHMARK_CAPTURE(read_candump_text, log, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(read_candump_text, screen, true)->Unit(benchmark::kMillisecond);

void write_candump_text(benchmark::State& state) {
    std::vector<CandumpLine> lines;
    const std::string all = candump_text({});
    for (CandumpStream stream("a.log", all); stream.next() != CandumpStream::What::end;)
        lines.push_back(stream.line());
    std::string text;
    for (auto _ : state) {
        text.clear();
        for (const CandumpLine& line : lines)
            append_candump_line(text, line.frame, line.style);
        benchmark::DoNotOptimize(text.data());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(write_candump_text)->Unit(benchmark::kMillisecond);

// Frames of a bus to values of signals and back, and reading what they mean.

/// `count` messages of eight signals each: byte orders, signs and lengths in turn; every fourth message multiplexed.
std::string many_messages(int count) {
    std::string text = "VERSION \"\"\nBU_: A B\n";
    for (int m = 0; m < count; ++m) {
        text += fmt::format("BO_ {} Message{}: 8 A\n", m + 1, m);
        const bool multiplexed = m % 4 == 3;
        for (int s = 0; s < 8; ++s) {
            const std::string when = !multiplexed ? "" : s == 0 ? " M" : fmt::format(" m{}", s % 2);
            if (s % 2 == 0)
                text += fmt::format(" SG_ Signal{}{} : {}|8@1+ (0.1,-40) [0|0] \"km/h\" B\n", s, when, 8 * s);
            else
                text += fmt::format(" SG_ Signal{}{} : {}|7@0- (0.5,0) [0|0] \"deg\" B\n", s, when, 8 * s + 6);
        }
    }
    for (int m = 0; m < count; ++m)
        text += fmt::format("VAL_ {} Signal1 0 \"off\" 1 \"on\" 2 \"faulty\" ;\n", m + 1);
    return text;
}

CanDatabase database_of(const std::string& text) {
    static const std::filesystem::path folder = tests::new_folder();
    FilesRead opened;
    return read_dbc(tests::written("benchmark.dbc", text, folder), opened);
}

std::vector<std::array<std::uint8_t, 8>> random_frames() {
    std::mt19937 random(1);
    std::vector<std::array<std::uint8_t, 8>> frames(1024);
    for (auto& frame : frames)
        for (auto& byte : frame)
            byte = static_cast<std::uint8_t>(random());
    return frames;
}

/// Argument: 0 a plain message, 3 a multiplexed one.
void decode_can_frame(benchmark::State& state) {
    const CanDatabase database = database_of(many_messages(4));
    const CanMessage& message = database.messages[static_cast<std::size_t>(state.range(0))];
    const auto frames = random_frames();
    std::vector<CanValue> values;
    std::size_t next = 0;
    for (auto _ : state) {
        decode_into(message, frames[next++ % frames.size()], values);
        benchmark::DoNotOptimize(values.data());
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(decode_can_frame)->Arg(0)->Arg(3);

void decode_one_can_signal(benchmark::State& state) {
    const CanDatabase database = database_of(many_messages(4));
    const CanMessage& message = database.messages[0];
    const auto frames = random_frames();
    std::size_t next = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(decode(message, message.signals[2], frames[next++ % frames.size()]));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(decode_one_can_signal);

void encode_can_frame(benchmark::State& state) {
    const CanDatabase database = database_of(many_messages(4));
    const CanMessage& message = database.messages[0];
    std::map<std::string, double> values;
    for (const CanSignal& signal : message.signals)
        values[signal.name] = -20.0;
    for (auto _ : state)
        benchmark::DoNotOptimize(encode(message, values));
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(encode_can_frame);

void read_dbc_of_500_messages(benchmark::State& state) {
    const std::string text = many_messages(500);
    for (auto _ : state)
        benchmark::DoNotOptimize(database_of(text));
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}
BENCHMARK(read_dbc_of_500_messages)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace fernlicht
