#include "runner/experiments/run/page_parts.h"
#include "runner/files/clean_text.h"

#include <fmt/format.h>

namespace fernlicht {
namespace {

using kainjow::mustache::data;
using List = data::type;

std::string ms(const std::vector<double>& seconds) { return figure(1e3 * spread_of(seconds).value().median, 2); }

std::string sentence(const Savings& savings) {
    const std::optional<PairedRatio> ratio = savings.ratio();
    if (!ratio)
        return "not measured: " + clean_text(savings.not_measured);
    const std::string pruned = ms(savings.pruned_s) + " ms", unpruned = ms(savings.unpruned_s) + " ms";
    const std::string spread = fmt::format("(ratio {}, {} … {} over {} rounds)", figure(ratio->median, 2), figure(ratio->p05, 2),
                                           figure(ratio->p95, 2), ratio->rounds);
    if (ratio->difference == Difference::not_distinguishable)
        return fmt::format("nothing that can be told from chance: {} a frame against {} {}", pruned, unpruned, spread);
    return fmt::format("{} instead of {} a frame {}{}", pruned, unpruned, spread,
                       ratio->difference == Difference::slower ? ": leaving out made it slower" : "");
}

data work_row(const char* what, const std::vector<double>& seconds, const Work& work) {
    data row;
    row.set("what", what);
    row.set("time", ms(seconds));
    row.set("passes", fmt::format("{}", work.passes));
    row.set("draws", fmt::format("{}", work.draws));
    row.set("samplers", fmt::format("{}", work.samplers));
    row.set("features", fmt::format("{}", work.features));
    row.set("triangles", fmt::format("{}", work.triangles));
    row.set("fragments", fmt::format("{}", work.fragments));
    return row;
}

} // namespace

data savings_part(const ComparedDrive& drive) {
    data part, sets{List::list};
    bool counted = false, said = false;
    for (std::size_t i = 0; i < drive.variants.size(); ++i) {
        const Savings& savings = drive.variants[i]->savings;
        if (savings.not_measured.empty() && !savings.ratio())
            continue; // the run ended before
        data set, rows{List::list};
        set.set("lamp", short_text(drive.variants[i]->variant, 40));
        set.set("colour", variant_colour(i));
        set.set("sentence", sentence(savings));
        if (savings.ratio()) {
            rows.push_back(work_row("as drawn", savings.pruned_s, savings.pruned));
            rows.push_back(work_row("nothing left out", savings.unpruned_s, savings.unpruned));
            counted = true;
        }
        set.set("rows", rows);
        sets.push_back(set);
        said = true;
    }
    part.set("said", said);
    part.set("counted", counted);
    part.set("sets", sets);
    return part;
}

} // namespace fernlicht
