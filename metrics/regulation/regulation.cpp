#include "metrics/regulation/regulation.h"

#include "metrics/regulation/rows.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <iterator>

namespace fernlicht {

const char* in_words(Sureness sureness) {
    static constexpr const char* words[]{"", "one source", "two prints, one reader", "two sources", "inferred, not read"};
    return words[static_cast<int>(sureness)];
}

const std::vector<Regulation>& regulations() {
    static const std::vector<Regulation> all = [] {
        std::vector<Regulation> list;
        for (const auto family : {r149_regulations, r112_and_r98_regulations, r123_regulations, fmvss108_regulations}) {
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

const Regulation& regulation(const std::string& asked) {
    std::string id = asked;
    std::ranges::transform(id, id.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    for (const Regulation& one : regulations())
        if (one.id == id)
            return one;
    std::string beginning;
    for (const std::string& known : regulation_ids())
        if (id.size() >= 3 && known.starts_with(id))
            beginning += (beginning.empty() ? "'" : ", '") + known + "'";
    if (!beginning.empty())
        throw InputError({{}, 0, 0, "--regulation"}, "found '" + printable(asked) + "'", "one of " + beginning);
    const std::string nearest = nearest_name(id, regulation_ids());
    throw InputError({{}, 0, 0, "--regulation"}, "found '" + printable(asked) + "'",
                     nearest.empty() ? "an id of `--regulation list`" : "'" + nearest + "' or another id of `--regulation list`");
}

} // namespace fernlicht
