#include "metrics/folds/sensitivity_fold.h"

#include "scenarios/drives/play/nudge.h"

#include <oneapi/tbb/parallel_for.h>
#include <stdexcept>

namespace fernlicht {

SensitivityFold::SensitivityFold(const Drive& drive, const Route& route, const LampSet& lamp_set)
    : lamp_set_(lamp_set), nudged_(nudge_kinds) {
    const Nudges nudges = usual_nudges(drive, lamp_set);
    for (std::size_t kind = 0; kind < nudges.size(); ++kind)
        if (nudges[kind])
            nudged_[kind].emplace(drive, route, *nudges[kind]);
}

void SensitivityFold::add(const Moment& moment) {
    oneapi::tbb::parallel_for(std::size_t{0}, nudged_.size(), [&](std::size_t kind) {
        if (nudged_[kind])
            nudged_[kind]->add(moment, lamp_set_);
    });
}

void SensitivityFold::tell(Readings& readings) const {
    for (std::size_t kind = 0; kind < nudged_.size(); ++kind) {
        const Readings nudged = nudged_[kind] ? nudged_[kind]->readings() : Readings();
        if (nudged_[kind] && nudged.size() != readings.size())
            throw std::logic_error("SensitivityFold: readings of another drive");
        for (std::size_t i = 0; i < nudged.size(); ++i)
            readings[i].sensitivity.*sensitivity_rows[kind].member = move_of(nudged[i].value, readings[i].value);
    }
}

} // namespace fernlicht
