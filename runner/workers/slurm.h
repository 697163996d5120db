// Commands on a cluster, as job arrays of Slurm: its own programs (sbatch, squeue, scontrol, scancel) are called by argument vectors, and
// nothing else is known of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fernlicht {

/// What each task of an array may take; empty and 0: the cluster's own defaults.
struct SlurmResources {
    double minutes = 60.0;
    std::uint64_t memory_mib = 0;
    int cores = 1;
    std::string partition, gpus; ///< gpus: as --gres takes it, "gpu:1"
    int at_once = 0;             ///< tasks of one array at a time
};

/// An array as it was asked for. Where the answer was lost, by a kill or a controller that did not answer, `id` is empty, and its name
/// tells.
struct SlurmArray {
    std::string name; ///< unique on the cluster
    std::string id;
};

/// Writes NAME.commands (a line each) and NAME.sh below `folder`, which all nodes see, and submits them; logs of tasks go to NAME-N.log
/// there. Returns the array's id. Throws DeviceError with what sbatch said.
std::string submit_array(const std::string& name, const std::vector<std::string>& commands, const SlurmResources& resources,
                         const std::filesystem::path& folder);

struct SlurmTask {
    std::string state, reason; ///< "PENDING", "Resources"
};
/// The tasks that the controller knows and that have not ended, by array id and task. nullopt where it does
/// not answer; then nothing is known of any task.
using SlurmTasks = std::map<std::pair<std::string, std::size_t>, SlurmTask>;
std::optional<SlurmTasks> active_tasks(const std::vector<SlurmArray>& arrays);

/// The id of an array that is known by its name alone; "" where none is active. nullopt where the controller does not answer.
std::optional<std::string> array_id(const std::string& name);

/// How a task ended, as the controller remembers it for some minutes: "NODE_FAIL", "TIMEOUT", "COMPLETED"; "" where it does not.
std::string ended_state(const std::string& array_id, std::size_t task);

/// How many tasks an array may have. Throws DeviceError where no controller answers.
std::size_t most_tasks();

/// Ends all of them, by name. Returns a sentence for each of which Slurm did not say so.
std::vector<std::string> cancel_arrays(const std::vector<SlurmArray>& arrays);

} // namespace fernlicht
