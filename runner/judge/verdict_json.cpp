#include "runner/judge/verdict_json.h"

#include "runner/findings/extent_keys.h"

#include <algorithm>
#include <array>

namespace fernlicht {
namespace {

using Json = nlohmann::ordered_json;

const char* expectation_name(Expectation expectation) {
    switch (expectation) {
    case Expectation::known:
        return "known";
    case Expectation::expired:
        return "expired";
    case Expectation::unexpected_pass:
        return "unexpected_pass";
    case Expectation::none:
        break;
    }
    return "";
}

} // namespace

nlohmann::ordered_json verdicts_json(const std::vector<Verdict>& verdicts) {
    Json out = Json::array();
    for (const Verdict& verdict : verdicts) {
        Json entry{{"name", verdict.name}, {"verdict", verdict_name(verdict.kind)}, {"text", verdict.text}, {"rerun", verdict.rerun}};
        if (verdict.expectation != Expectation::none || !verdict.known.empty())
            entry["listed"] = {{"as", expectation_name(verdict.expectation)}, {"text", verdict.known}};
        out.push_back(std::move(entry));
    }
    return out;
}

Verdict read_verdict(const CheckedJson& json) {
    Verdict verdict{VerdictKind::pass, json.at("name").text(), json.at("text").text(), json.at("rerun").text()};
    const auto choose = [](const CheckedJson& word, auto& value, const auto& all, const auto& name_of, const char* expected) {
        const auto found = std::ranges::find_if(all, [&](const auto& one) { return word.text() == name_of(one); });
        if (found == std::end(all))
            word.refuse(expected);
        value = *found;
    };
    choose(json.at("verdict"), verdict.kind,
           std::array{VerdictKind::pass, VerdictKind::fail, VerdictKind::not_measured, VerdictKind::flaky}, verdict_name,
           "pass, fail, not_measured or flaky");
    if (!json.has("listed"))
        return verdict;
    const CheckedJson listed = json.at("listed");
    choose(listed.at("as"), verdict.expectation,
           std::array{Expectation::none, Expectation::known, Expectation::expired, Expectation::unexpected_pass}, expectation_name,
           "known, expired, unexpected_pass or nothing");
    verdict.known = listed.at("text").text();
    return verdict;
}

nlohmann::ordered_json counts_json(const VerdictCounts& counts) {
    return {{"pass", counts.pass},   {"fail", counts.fail},   {"not_measured", counts.not_measured},
            {"flaky", counts.flaky}, {"known", counts.known}, {"unexpected_pass", counts.unexpected_pass}};
}

nlohmann::ordered_json repeats_json(const Repeats& repeats) {
    Json spread = Json::array();
    for (const ReadingSpread& reading : repeats.spread)
        spread.push_back({{"name", name_of(reading.key)},
                          {"frame", reading.tick < 0 ? Json(nullptr) : Json(reading.tick)},
                          {"count", reading.count},
                          {"mean", reading.mean},
                          {"variance", reading.variance}});
    return {{"count", repeats.count}, {"differ", repeats.differ}, {"spread", spread}};
}

} // namespace fernlicht
