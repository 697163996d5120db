// What a cell of a study may take of the machine that plays it.
#pragma once

#include <string>

namespace fernlicht {

template <class Struct> struct Fields;

struct StudyResources {
    double minutes = 60.0;    ///< then it is stopped
    double memory_mib = 4096; ///< of its own data; 0: as much as there is
    int cores = 0;            ///< of each cell, and what a cluster is asked for; 0: one; all with --jobs 1
    std::string partition;    ///< of the cluster; "": its default
    std::string gpus;         ///< as Slurm's --gres has it, "gpu:1"; "": none
    int at_once = 0;          ///< cells at a time on a cluster; 0: as many as it likes
};

const Fields<StudyResources>& study_resources_fields();

} // namespace fernlicht
