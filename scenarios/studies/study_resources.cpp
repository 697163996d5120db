#include "scenarios/studies/study_resources.h"

#include "scenarios/fields/field.h"

namespace fernlicht {

const Fields<StudyResources>& study_resources_fields() {
    using Resources = StudyResources;
    static const Fields<Resources> fields{
        field("minutes", 1, &Resources::minutes, above(0.0, 100'000.0), "that a cell may take; then it is stopped"),
        field("memory_mib", 2, &Resources::memory_mib, range(0.0, 1e7), "that a cell may take; 0: no limit"),
        field("cores", 3, &Resources::cores, range(0, 1024), "for each cell, and what a cluster is asked for; 0: one; all with --jobs 1"),
        field("partition", 4, &Resources::partition, any(), "of the cluster; its default where there is none"),
        field("gpus", 5, &Resources::gpus, any(), "for each cell, as Slurm's --gres has it: gpu:1"),
        field("at_once", 6, &Resources::at_once, range(0, 100'000), "cells at a time on a cluster; 0: as many as it likes"),
    };
    return fields;
}

} // namespace fernlicht
