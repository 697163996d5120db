// Frames of a bus to values of signals and back, and reading what they mean.
#include "scenarios/can/can_database.h"
#include "scenarios/can/signal_codec.h"

#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <random>

namespace fernlicht {
namespace {

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
    std::string folder = (std::filesystem::temp_directory_path() / "fernlicht-dbc-XXXXXX").string();
    if (::mkdtemp(folder.data()) == nullptr)
        std::abort();
    const std::filesystem::path path = std::filesystem::path(folder) / "benchmark.dbc";
    std::ofstream(path) << text;
    FilesRead opened;
    CanDatabase database = read_dbc(path, opened);
    std::filesystem::remove_all(folder);
    return database;
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
