// Who else used the machine's cores while something was timed. From Linux's /proc.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace fernlicht {

/// CPU seconds used so far.
struct CpuUse {
    double wall_s = 0.0;                                     ///< of a steady clock
    double own_s = 0.0;                                      ///< this process, all threads, user and system
    std::optional<double> machine_s;                         ///< all cores, time stolen by the hypervisor too; nullopt: /proc does not tell
    std::map<int, std::pair<std::string, double>> processes; ///< name and seconds by process id, as far as they can be seen
    std::optional<std::array<double, 3>> load_average;       ///< over 1, 5 and 15 minutes
};
CpuUse cpu_use();

/// Own CPU seconds, all threads, user and system.
double own_cpu_s();

/// What others used between two looks, in cores: 1.0 is one core all the time.
struct OtherUse {
    std::optional<double> cores; ///< nullopt: /proc does not tell
    std::string busiest;         ///< the process that used most; "" where none used a hundredth of a core
    double busiest_cores = 0.0;
};
OtherUse other_use(const CpuUse& before, const CpuUse& after, int own_process);

/// Above it times are called disturbed.
inline constexpr double disturbing_cores = 0.2;

/// Ticks of work in the line `cpu` of /proc/stat: user, nice, system, irq, softirq and steal. nullopt when it is not that.
std::optional<double> machine_ticks(const std::string& stat);
/// Name and ticks (user and system) of /proc/PID/stat. The name may hold spaces and parentheses.
std::optional<std::pair<std::string, double>> process_ticks(const std::string& stat);

} // namespace fernlicht
