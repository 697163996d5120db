#include "metrics/folds/sensitivity_fold.h"

#include "scenarios/drives/play/nudge.h"
#include "scenarios/values/trace.h"

#include <map>
#include <oneapi/tbb/parallel_for.h>

namespace fernlicht {
namespace {

using ByKey = std::map<ReadingKey, Value>;

ByKey values_by_key(const Readings& readings) {
    ByKey values;
    for (const Reading& reading : readings)
        values.emplace(reading.key, reading.value);
    return values;
}

} // namespace

bool tells_sensitivity(int k, int planned, int moments) {
    const auto place = [&](int at) { return static_cast<long long>(at) * moments / planned; };
    return planned <= moments || k == 0 || place(k) != place(k - 1);
}

SensitivityFold::SensitivityFold(const Drive& drive, const Route& route, const LampSet& lamp_set)
    : lamp_set_(lamp_set), nudged_(nudge_kinds), medians_(drive, route, {}, SeeingPart::medians) {
    const Nudges nudges = usual_nudges(drive, lamp_set);
    for (std::size_t kind = 0; kind < nudges.size(); ++kind)
        if (nudges[kind])
            nudged_[kind].emplace(Nudged{SeeingFold(drive, route, *nudges[kind], SeeingPart::of_every_moment),
                                         SeeingFold(drive, route, *nudges[kind], SeeingPart::medians)});
}

void SensitivityFold::add(const Moment& moment, bool sampled) {
    const TraceSpan span("sensitivity", "measure");
    if (sampled)
        medians_.add(moment, lamp_set_);
    oneapi::tbb::parallel_for(std::size_t{0}, nudged_.size(), [&](std::size_t kind) {
        if (!nudged_[kind])
            return;
        nudged_[kind]->every_moment.add(moment, lamp_set_);
        if (sampled)
            nudged_[kind]->medians.add(moment, lamp_set_);
    });
}

void SensitivityFold::tell(Readings& readings) const {
    const ByKey as_is = values_by_key(medians_.readings());
    for (std::size_t kind = 0; kind < nudged_.size(); ++kind) {
        if (!nudged_[kind])
            continue;
        ByKey values = values_by_key(nudged_[kind]->every_moment.readings());
        values.merge(values_by_key(nudged_[kind]->medians.readings()));
        for (Reading& reading : readings)
            if (const auto nudged = values.find(reading.key); nudged != values.end()) {
                const auto median = as_is.find(reading.key);
                reading.sensitivity.*sensitivity_rows[kind].member =
                    move_of(nudged->second, median == as_is.end() ? reading.value : median->second);
            }
    }
}

} // namespace fernlicht
