#include "metrics/regulation/rows.h"
#include "scenarios/values/errors.h"

#include <iterator>

namespace fernlicht {

const std::vector<Regulation>& regulations() {
    static const std::vector<Regulation> all = [] {
        std::vector<Regulation> list;
        for (const auto family :
             {r149_regulations, r112_and_r98_regulations, r123_passing_regulations, r123_driving_regulations, fmvss108_regulations}) {
            std::vector<Regulation> some = family();
            std::move(some.begin(), some.end(), std::back_inserter(list));
        }
        return list;
    }();
    return all;
}

std::vector<std::string> regulation_ids() {
    std::vector<std::string> ids;
    for (const Regulation& one : regulations())
        ids.push_back(one.id);
    return ids;
}

const Regulation& regulation(const std::string& id) {
    for (const Regulation& one : regulations())
        if (one.id == id)
            return one;
    const std::string nearest = nearest_name(id, regulation_ids());
    throw InputError({{}, 0, 0, "--regulation"}, "found '" + printable(id) + "'",
                     nearest.empty() ? "an id of `--regulation list`" : "'" + nearest + "' or another id of `--regulation list`");
}

} // namespace fernlicht
