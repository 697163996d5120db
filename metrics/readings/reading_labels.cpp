#include "metrics/readings/reading_labels.h"

#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

const char* statistic_in_words(Statistic statistic) {
    static constexpr const char* words[] = {
        "", "", ", least", ", largest", ", 5th percentile", ", 95th percentile", ", 95th less 5th percentile", ""};
    return words[static_cast<std::size_t>(statistic)];
}

const char* aspect_in_words(Aspect aspect) {
    static constexpr const char* words[] = {"",
                                            ", gained by control",
                                            ", lamps held still",
                                            ", 5 % of cars below",
                                            ", half of cars below",
                                            ", 95 % of cars below",
                                            ", twin",
                                            ", rendered against the twin",
                                            ", error of the grid",
                                            ", standard error"};
    return words[static_cast<std::size_t>(aspect)];
}

std::string lane_in_words(const std::string& lane) {
    return lane == "own" ? "own lane" : lane == "oncoming" ? "oncoming lane" : lane == "all" ? "whole width" : lane;
}

std::string beyond_in_words(const Threshold& threshold) {
    switch (threshold.unit) {
    case ThresholdUnit::percent:
        return fmt::format("above {} % of threshold increment", threshold.value);
    case ThresholdUnit::de_boer:
        return fmt::format("below de Boer's {}", threshold.value);
    default:
        return fmt::format("above {} lx", threshold.value);
    }
}

/// What stands for a word in braces (quantities.cpp).
std::string filled(std::string_view slot, const ReadingKey& key) {
    const std::string distance = key.distance_m ? fmt::format("{} m", *key.distance_m) : "";
    const std::pair<const char*, std::string> slots[] = {
        {"limit", fmt::format("{} lx", key.threshold.value)},
        {"beyond", beyond_in_words(key.threshold)},
        {"surface", key.surface == ReadingSurface::road ? " on the road" : " on a target"},
        {"lane", ", " + lane_in_words(key.lane)},
        {"stand", key.lane.empty() ? fmt::format("{} edge of the lanes", name_of(key.place)) : lane_in_words(key.lane)},
        {"place", key.place == ReadingPlace::left_bends    ? "left bends"
                  : key.place == ReadingPlace::right_bends ? "right bends"
                                                           : name_of(key.place)},
        {"subject", key.subject},
        {"distance", distance},
        {"before", distance.empty() || key.place == ReadingPlace::mirrors ? ""
                   : key.to_m                                             ? fmt::format(" at {} to {} m", *key.distance_m, *key.to_m)
                                                                          : " at " + distance},
        {"most", key.statistic == Statistic::maximum   ? "largest "
                 : key.statistic == Statistic::minimum ? "smallest "
                 : key.statistic == Statistic::p05     ? "5th percentile of "
                 : key.statistic == Statistic::p95     ? "95th percentile of "
                                                       : ""},
        {"eye", eye_label(key)}};
    for (const auto& [word, text] : slots)
        if (slot == word)
            return text;
    throw std::logic_error(fmt::format("words with {{{}}}", slot));
}

} // namespace

std::string reading_label(const ReadingKey& key) {
    const std::string_view words = row_of(key.quantity).words;
    std::string text;
    for (std::size_t at = 0; at < words.size();)
        if (words[at] == '{') {
            const std::size_t end = words.find('}', at);
            text += filled(words.substr(at + 1, end - at - 1), key);
            at = end + 1;
        } else
            text += words[at++];
    if (key.place == ReadingPlace::left_edge || key.place == ReadingPlace::right_edge || key.place == ReadingPlace::edges)
        text += key.place == ReadingPlace::left_edge ? ", left edge" : key.place == ReadingPlace::right_edge ? ", right edge" : ", edges";
    if (words.find("{most}") == std::string_view::npos)
        text += statistic_in_words(key.statistic);
    return text + aspect_in_words(key.aspect);
}

std::string eye_label(const ReadingKey& key) {
    if (key.place == ReadingPlace::mirrors)
        return fmt::format("mirrors of a car {} m ahead", key.distance_m.value_or(0.0));
    return key.place == ReadingPlace::own_eyes ? "eyes of the own driver"
           : key.subject == "oncoming"         ? "eyes of an oncoming driver"
                                               : "eyes of oncoming driver " + key.subject;
}

} // namespace fernlicht
