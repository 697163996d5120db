#include "runner/play/interleaved_timing.h"

#include "metrics/statistics/statistics.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>
#include <vector>

namespace fernlicht {
namespace {

/// All moments without a pause, as a simulator draws them that waits for nothing.
void play_back_to_back(const TimedTechnique& timed, const TimingOptions& options, const TimingClocks& clocks, TimingSamples& samples) {
    const bool gpu = static_cast<bool>(clocks.gpu_s);
    const auto frames = static_cast<double>(options.moments);
    const double cpu_s = clocks.cpu_s(), wall_s = clocks.wall_s();
    for (std::size_t moment = 0; moment < options.moments; ++moment) {
        if (gpu)
            clocks.gpu_begin();
        timed.draw(moment);
        if (gpu)
            clocks.gpu_end();
    }
    timed.finish();
    samples.frame_s.push_back((clocks.wall_s() - wall_s) / frames);
    samples.cpu_s.push_back((clocks.cpu_s() - cpu_s) / frames);
    if (gpu)
        samples.gpu_s.push_back(clocks.gpu_s() / frames);
}

void play_frame_by_frame(const TimedTechnique& timed, const TimingOptions& options, const TimingClocks& clocks, TimingSamples& samples) {
    for (std::size_t moment = 0; moment < options.moments; ++moment) {
        const double wall_s = clocks.wall_s();
        timed.draw(moment);
        timed.finish();
        samples.latency_s.push_back(clocks.wall_s() - wall_s);
    }
}

std::string first_line(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

/// The numbers after `at`, up to the first word that is none.
std::vector<double> numbers(const std::string& text, std::size_t at) {
    std::istringstream stream(text.substr(at));
    stream.imbue(std::locale::classic());
    std::vector<double> values;
    for (double value = 0.0; stream >> value;)
        values.push_back(value);
    return values;
}

std::map<int, std::pair<std::string, double>> processes(double ticks_per_s) {
    std::map<int, std::pair<std::string, double>> all;
    std::error_code error;
    for (std::filesystem::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        int id = 0;
        const auto [rest, failure] = std::from_chars(name.data(), name.data() + name.size(), id);
        if (failure != std::errc{} || rest != name.data() + name.size())
            continue;
        if (auto process = process_ticks(first_line(entry->path() / "stat"))) // one that has ended meanwhile has none
            all[id] = {std::move(process->first), process->second / ticks_per_s};
    }
    return all;
}

} // namespace

TimingClocks real_clocks() {
    TimingClocks clocks;
    clocks.wall_s = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); };
    clocks.cpu_s = own_cpu_s;
    return clocks;
}

InterleavedTimes time_interleaved(const std::vector<TimedTechnique>& timed_techniques, const TimingOptions& options,
                                  const TimingClocks& clocks) {
    InterleavedTimes timing;
    timing.samples.resize(timed_techniques.size());
    for (const TimedTechnique& timed : timed_techniques) {
        if (options.stop())
            return timing;
        for (std::size_t play = 0; play < options.warm_up_plays; ++play)
            for (std::size_t moment = 0; moment < options.moments; ++moment)
                timed.draw(moment);
        timed.finish();
    }
    std::mt19937_64 chance(options.seed);
    for (std::size_t round = 0; round < options.rounds && options.go_on(round); ++round) {
        timing.orders.push_back(random_order(timed_techniques.size(), chance));
        for (const std::size_t i : timing.orders.back()) {
            play_back_to_back(timed_techniques[i], options, clocks, timing.samples[i]);
            if (options.frame_by_frame)
                play_frame_by_frame(timed_techniques[i], options, clocks, timing.samples[i]);
        }
    }
    return timing;
}

std::optional<double> machine_ticks(const std::string& stat) {
    if (!stat.starts_with("cpu "))
        return std::nullopt;
    const std::vector<double> columns = numbers(stat, 4); // user nice system idle iowait irq softirq steal
    if (columns.size() < 8)
        return std::nullopt;
    return columns[0] + columns[1] + columns[2] + columns[5] + columns[6] + columns[7];
}

std::optional<std::pair<std::string, double>> process_ticks(const std::string& stat) {
    const std::size_t open = stat.find('('), close = stat.rfind(')');
    if (open == std::string::npos || close == std::string::npos || close < open || close + 3 >= stat.size())
        return std::nullopt;
    const std::vector<double> columns = numbers(stat, close + 3); // after ") S": the fourth column, the parent's id
    if (columns.size() < 12)
        return std::nullopt;
    return std::pair(stat.substr(open + 1, close - open - 1), columns[10] + columns[11]);
}

double own_cpu_s() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

CpuUse cpu_use() {
    const auto ticks_per_s = static_cast<double>(::sysconf(_SC_CLK_TCK));
    CpuUse use;
    use.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    use.own_s = own_cpu_s();
    if (const auto ticks = machine_ticks(first_line("/proc/stat")))
        use.machine_s = *ticks / ticks_per_s;
    use.processes = processes(ticks_per_s);
    if (const std::vector<double> load = numbers(first_line("/proc/loadavg"), 0); load.size() >= 3)
        use.load_average = {load[0], load[1], load[2]};
    return use;
}

std::string disturbance_text(const OtherLoad& others, std::size_t cores) {
    constexpr double disturbing_cores = 0.2;
    if (!others.cores)
        return "whether others used the machine could not be seen: /proc/stat does not tell";
    if (*others.cores <= disturbing_cores)
        return "";
    return fmt::format("others used {:.2f} of the machine's {} cores meanwhile{}: times are longer than on a quiet machine, and their "
                       "spread is wider",
                       *others.cores, cores,
                       others.busiest.empty() ? ""
                                              : fmt::format(" (busiest seen: '{}' with {:.2f})", others.busiest, others.busiest_cores));
}

OtherLoad other_load(const CpuUse& before, const CpuUse& after, int own_process) {
    OtherLoad use;
    const double wall_s = after.wall_s - before.wall_s;
    if (!(wall_s > 0.0))
        return use;
    if (before.machine_s && after.machine_s) // both clocks tick in hundredths: a difference below 0 is none
        use.cores = std::max(0.0, (*after.machine_s - *before.machine_s - (after.own_s - before.own_s)) / wall_s);
    for (const auto& [id, process] : after.processes) {
        const auto earlier = before.processes.find(id);
        const double cores = (process.second - (earlier == before.processes.end() ? 0.0 : earlier->second.second)) / wall_s;
        if (id != own_process && cores >= 0.01 && cores > use.busiest_cores) {
            use.busiest = process.first;
            use.busiest_cores = cores;
        }
    }
    return use;
}

} // namespace fernlicht
