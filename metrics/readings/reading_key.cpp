#include "metrics/readings/reading_key.h"

#include "scenarios/values/glob.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <fmt/format.h>
#include <span>
#include <stdexcept>
#include <utility>

namespace fernlicht {
namespace {

/// A word of a form and what it says. Forms (quantities.h) are made of such words in brackets, of which a name
/// has one; of slots: <name>, <lane>, <eye>, <m> for a distance, <from> and <to> for a range of them, <lx>, <percent> and <rating> for a
/// threshold; and of letters that stand for themselves. "Not set" is each field's default.
struct Word {
    const char* word;
    Aspect aspect = Aspect::value;
    Statistic statistic = Statistic::none;
    ReadingPlace place = ReadingPlace::none;
    ReadingSurface surface = ReadingSurface::none;
    const char *lane = "", *subject = "";
    const char* spelt_as = nullptr; ///< where it is not itself

    std::string_view spelt() const { return spelt_as ? spelt_as : word; }
};
constexpr Word known_words[] = {
    {.word = "median", .statistic = Statistic::median, .spelt_as = ""}, // goes without saying
    {.word = "mean", .statistic = Statistic::mean, .spelt_as = ""},
    {.word = "_median", .statistic = Statistic::median},
    {.word = "_min", .statistic = Statistic::minimum},
    {.word = "_max", .statistic = Statistic::maximum},
    {.word = "_p05", .statistic = Statistic::p05},
    {.word = "_p95", .statistic = Statistic::p95},
    {.word = "_spread", .statistic = Statistic::spread},
    {.word = "_twin", .aspect = Aspect::twin, .statistic = Statistic::median},
    {.word = "_twin_difference", .aspect = Aspect::twin_difference, .statistic = Statistic::median},
    {.word = "_twin_difference_worst", .aspect = Aspect::twin_difference, .statistic = Statistic::maximum},
    {.word = "_grid_error", .aspect = Aspect::grid_error, .statistic = Statistic::median},
    {.word = "_edge_grid_error", .aspect = Aspect::grid_error, .statistic = Statistic::median, .place = ReadingPlace::edges},
    {.word = "_left_edge", .statistic = Statistic::median, .place = ReadingPlace::left_edge},
    {.word = "_right_edge", .statistic = Statistic::median, .place = ReadingPlace::right_edge},
    {.word = "left", .place = ReadingPlace::left},
    {.word = "right", .place = ReadingPlace::right},
    {.word = "overhead", .place = ReadingPlace::overhead},
    {.word = "along", .place = ReadingPlace::along},
    {.word = "across", .place = ReadingPlace::across},
    {.word = "left_bends", .place = ReadingPlace::left_bends},
    {.word = "right_bends", .place = ReadingPlace::right_bends},
    {.word = "mirrors", .place = ReadingPlace::mirrors},
    {.word = "own_eyes", .place = ReadingPlace::own_eyes, .spelt_as = "own"},
    {.word = "road", .surface = ReadingSurface::road},
    {.word = "target", .surface = ReadingSurface::target},
    {.word = "kerb", .surface = ReadingSurface::road},
    {.word = "kerb_target", .surface = ReadingSurface::target},
    {.word = "own", .lane = "own"},
    {.word = "oncoming", .lane = "oncoming"},
    {.word = "inside"},
    {.word = "inside_gain", .aspect = Aspect::by_control},
    {.word = "reach"},
    {.word = "reach_gain", .aspect = Aspect::by_control},
    {.word = "glare"},
    {.word = "glare_cost", .aspect = Aspect::by_control},
    {.word = "others"},
    {.word = "others_still", .aspect = Aspect::held_still},
    {.word = "c", .subject = "c"},
    {.word = "v", .subject = "v"},
    {.word = "e", .subject = "e"},
    {.word = "w", .subject = "w"},
};

const Word& find_word(std::string_view word) {
    const auto found = std::ranges::find(known_words, word, &Word::word);
    if (found == std::end(known_words))
        throw std::logic_error(fmt::format("a form has the unknown word {}", word));
    return *found;
}

void say(const Word& word, ReadingKey& key) {
    key.aspect = word.aspect != Aspect::value ? word.aspect : key.aspect;
    key.statistic = word.statistic != Statistic::none ? word.statistic : key.statistic;
    key.place = word.place != ReadingPlace::none ? word.place : key.place;
    key.surface = word.surface != ReadingSurface::none ? word.surface : key.surface;
    key.lane = *word.lane ? word.lane : key.lane;
    key.subject = *word.subject ? word.subject : key.subject;
}

/// How much of the key the word says; nullopt where it says something else.
std::optional<int> said(const Word& word, const ReadingKey& key) {
    int much = 0;
    bool agrees = true;
    const auto field = [&](const auto& says, const auto& nothing, const auto& is) {
        much += says != nothing ? 1 : 0;
        agrees = agrees && (says == nothing || says == is);
    };
    field(word.aspect, Aspect::value, key.aspect);
    field(word.statistic, Statistic::none, key.statistic);
    field(word.place, ReadingPlace::none, key.place);
    field(word.surface, ReadingSurface::none, key.surface);
    field(std::string_view(word.lane), "", key.lane);
    field(std::string_view(word.subject), "", key.subject);
    return agrees ? std::optional(much) : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char by) {
    std::vector<std::string_view> parts;
    for (std::size_t end = text.find(by); end != std::string_view::npos; end = text.find(by)) {
        parts.push_back(text.substr(0, end));
        text.remove_prefix(end + 1);
    }
    parts.push_back(text);
    return parts;
}

/// "(left|right)" with its words, "<lx>", or text that stands for itself.
struct Part {
    std::string text;
    std::vector<const Word*> words = {};
};

std::vector<Part> parts_of(std::string_view form) {
    std::vector<Part> parts;
    while (!form.empty()) {
        const std::size_t size = form[0] == '('   ? form.find(')') + 1
                                 : form[0] == '<' ? form.find('>') + 1
                                                  : std::min(form.find_first_of("(<"), form.size());
        Part& part = parts.emplace_back(Part{std::string(form.substr(0, size))});
        if (form[0] == '(')
            for (const std::string_view word : split(form.substr(1, size - 2), '|'))
                part.words.push_back(&find_word(word));
        form.remove_prefix(size);
    }
    return parts;
}

constexpr const char* eyes[] = {"(mirrors)_at_<m>m", "(own_eyes)", "<name>"};

struct Form {
    Quantity quantity;
    std::vector<Part> parts;
};

/// Of all quantities, with every kind of eye in place of <eye>.
const std::vector<Form>& forms() {
    static const std::vector<Form> all = [] {
        std::vector<Form> made;
        for (const QuantityRow& row : quantities())
            for (const std::string_view form : split(row.forms, ' '))
                if (const std::size_t at = form.find("<eye>"); at == std::string_view::npos)
                    made.push_back({row.quantity, parts_of(form)});
                else
                    for (const char* eye : eyes)
                        made.push_back({row.quantity, parts_of(std::string(form).replace(at, 5, eye))});
        return made;
    }();
    return all;
}

ThresholdUnit threshold_unit(std::string_view slot) {
    return slot == "<lx>" ? ThresholdUnit::lx : slot == "<percent>" ? ThresholdUnit::percent : ThresholdUnit::de_boer;
}

bool is_distance(std::string_view slot) { return slot == "<m>" || slot == "<from>" || slot == "<to>"; }

/// A name in this form; nullopt where the key lacks what it asks for.
std::optional<std::string> spell(std::span<const Part> form, const ReadingKey& key) {
    std::string text;
    for (const auto& [part, words] : form) {
        if (!words.empty()) {
            const Word* best = nullptr;
            for (const Word* word : words)
                if (const auto much = said(*word, key); much && (!best || *much > *said(*best, key)))
                    best = word;
            if (!best)
                return std::nullopt;
            text += best->spelt();
        } else if (part == "<name>" || part == "<lane>") {
            std::string named = part == "<name>" ? key.subject : key.lane;
            if (part == "<lane>")
                std::ranges::replace(named, ' ', '_');
            if (named.empty())
                return std::nullopt;
            text += named;
        } else if (is_distance(part)) {
            const std::optional<double>& metres = part == "<to>" ? key.to_m : key.distance_m;
            if (!metres)
                return std::nullopt;
            text += fmt::format("{}", *metres);
        } else if (part[0] == '<') {
            if (key.threshold.unit != threshold_unit(part))
                return std::nullopt;
            text += fmt::format("{}", key.threshold.value);
        } else
            text += part;
    }
    return text;
}

/// A number as it is printed, at the text's beginning: its end and value.
std::optional<std::pair<std::size_t, double>> number_at(std::string_view text) {
    double value = 0.0;
    const char* const end = std::from_chars(text.data(), text.data() + text.size(), value).ptr;
    const auto size = static_cast<std::size_t>(end - text.data());
    if (size == 0 || fmt::format("{}", value) != text.substr(0, size) || !(value >= 0.0 && value <= 1e300))
        return std::nullopt;
    return std::pair(size, value);
}

/// "own", "all", "left_2": its end.
std::size_t lane_end(std::string_view text) {
    for (const std::string_view lane : {"own", "all"})
        if (text.starts_with(lane))
            return lane.size();
    for (const std::string_view side : {"left_", "right_"})
        if (text.starts_with(side) && text.size() > side.size() && text[side.size()] != '0')
            return std::min(text.find_first_not_of("0123456789", side.size()), text.size());
    return 0;
}

/// Whether the text is a name in this form; then `key` has its fields. Of several ways to read it the one with the shortest subject.
bool match(std::span<const Part> form, std::string_view text, ReadingKey& key) {
    if (form.empty())
        return text.empty();
    const std::string& part = form.front().text;
    const std::vector<const Word*>& words = form.front().words;
    const auto goes_on = [&](std::size_t from, auto&& set) {
        ReadingKey next = key;
        set(next);
        const bool found = match(form.subspan(1), text.substr(from), next);
        if (found)
            key = std::move(next);
        return found;
    };
    if (!words.empty())
        return std::ranges::any_of(words, [&](const Word* word) {
            return text.starts_with(word->spelt()) && goes_on(word->spelt().size(), [&](ReadingKey& next) { say(*word, next); });
        });
    if (part == "<name>") {
        const std::size_t longest =
            std::min(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-"), text.size());
        for (std::size_t size = 1; size <= longest; ++size)
            if (goes_on(size, [&](ReadingKey& next) { next.subject = text.substr(0, size); }))
                return true;
        return false;
    }
    if (part == "<lane>") {
        const std::size_t size = lane_end(text);
        return size > 0 && goes_on(size, [&](ReadingKey& next) {
                   next.lane = text.substr(0, size);
                   std::ranges::replace(next.lane, '_', ' ');
               });
    }
    if (part[0] == '<') {
        const auto number = number_at(text);
        return number && goes_on(number->first, [&](ReadingKey& next) {
                   if (is_distance(part))
                       (part == "<to>" ? next.to_m : next.distance_m) = number->second;
                   else
                       next.threshold = {number->second, threshold_unit(part)};
               });
    }
    return text.starts_with(part) && match(form.subspan(1), text.substr(part.size()), key);
}

void add_shapes(std::span<const Part> form, ReadingKey key, const ReadingKey& sample, std::vector<ReadingKey>& shapes) {
    if (form.empty()) {
        shapes.push_back(std::move(key));
        return;
    }
    const auto& [part, words] = form.front();
    if (part == "<name>")
        key.subject = sample.subject;
    else if (part == "<lane>")
        key.lane = sample.lane;
    else if (is_distance(part))
        (part == "<to>" ? key.to_m : key.distance_m) = part == "<to>" ? sample.to_m : sample.distance_m;
    else if (part[0] == '<')
        key.threshold = {sample.threshold.value, threshold_unit(part)};
    for (const Word* word : words) {
        ReadingKey next = key;
        say(*word, next);
        add_shapes(form.subspan(1), std::move(next), sample, shapes);
    }
    if (words.empty())
        add_shapes(form.subspan(1), std::move(key), sample, shapes);
}

/// Between a reading's name and its unit.
constexpr std::pair<Aspect, std::string_view> aspects_before_unit[] = {{Aspect::standard_error, "_standard_error_"},
                                                                       {Aspect::cars_p05, "_cars_p05_"},
                                                                       {Aspect::cars_median, "_cars_median_"},
                                                                       {Aspect::cars_p95, "_cars_p95_"}};

/// "cdm2": a unit as names end in it; "1" for none.
std::string unit_word(const ReadingKey& key) {
    const std::string unit = unit_of(key);
    return unit == "cd/m2" ? "cdm2" : unit == "%" ? "percent" : unit == "1/m" ? "per_m" : unit == "1/deg" ? "per_deg" : unit;
}

/// A name that may lead back to another key, where the subject is not clear.
std::optional<std::string> spell(const ReadingKey& key) {
    if (const auto before = std::ranges::find(aspects_before_unit, key.aspect, &std::pair<Aspect, std::string_view>::first);
        before != std::end(aspects_before_unit)) {
        ReadingKey of = key;
        of.aspect = Aspect::value;
        std::optional<std::string> name = spell(of);
        const std::string unit = unit_word(key);
        if (name && name->ends_with("_" + unit))
            name->resize(name->size() - unit.size() - 1);
        return name ? std::optional(fmt::format("{}{}{}", *name, before->second, unit)) : std::nullopt;
    }
    for (const Form& form : forms())
        if (std::optional<std::string> name = form.quantity == key.quantity ? spell(form.parts, key) : std::nullopt)
            return name;
    return std::nullopt;
}

/// `at`: where the aspect begins.
std::optional<ReadingKey> with_aspect(std::string_view name, std::size_t at, Aspect aspect, std::string_view spelt) {
    const std::string_view unit = name.substr(at + spelt.size());
    std::optional<ReadingKey> key = key_of(fmt::format("{}{}{}", name.substr(0, at), unit == "1" ? "" : "_", unit == "1" ? "" : unit));
    if (!key || key->aspect != Aspect::value)
        return std::nullopt;
    key->aspect = aspect;
    return spell(*key) == name ? key : std::nullopt;
}

bool is_clear(const ReadingKey& key) {
    const auto name = spell(key);
    return name && key_of(*name) == key;
}

} // namespace

std::string name_of(const ReadingKey& key) {
    const auto name = spell(key);
    if (!name || key_of(*name) != key)
        throw std::logic_error(fmt::format("no reading is named {}, subject '{}'", name.value_or(row_of(key.quantity).id), key.subject));
    return *name;
}

std::optional<ReadingKey> key_of(std::string_view name) {
    for (const auto& [aspect, spelt] : aspects_before_unit)
        if (const std::size_t at = name.rfind(spelt); at != std::string_view::npos)
            return with_aspect(name, at, aspect, spelt);
    for (const Form& form : forms()) {
        ReadingKey key{.quantity = form.quantity};
        if (match(form.parts, name, key))
            return key;
    }
    return std::nullopt;
}

std::optional<std::size_t> place_among(const ReadingKey& key, const std::vector<std::string>& names) {
    const std::string own = name_of(key);
    const auto found = std::ranges::find_if(names, [&](const std::string& name) { return matches(name, own); });
    return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
}

bool is_clear_subject(SubjectKind kind, std::string_view subject) {
    for (const QuantityRow& row : quantities())
        if (row.subject == kind)
            for (ReadingKey& key : shapes_of(
                     {.quantity = row.quantity, .subject = std::string(subject), .threshold = {1.0}, .distance_m = 1.0, .to_m = 2.0})) {
                if (!is_clear(key))
                    return false;
                if (key.aspect == Aspect::value)
                    for (const auto& [aspect, spelt] : aspects_before_unit) {
                        key.aspect = aspect;
                        if (!is_clear(key))
                            return false;
                    }
            }
    return true;
}

std::string pass_subject(std::string_view pass) {
    std::string subject;
    for (const char c : pass) {
        const bool upper = c >= 'A' && c <= 'Z', plain = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
        subject += upper ? static_cast<char>(c - 'A' + 'a') : plain ? c : '_';
    }
    return subject;
}

std::string eye_name(const ReadingKey& key) {
    for (const char* eye : eyes)
        if (const auto name = spell(parts_of("glare_" + std::string(eye)), key))
            return *name;
    return {};
}

std::optional<ReadingKey> eye_of(std::string_view name) {
    for (const char* eye : eyes)
        if (ReadingKey key{.quantity = Quantity::glare_facing}; match(parts_of("glare_" + std::string(eye)), name, key))
            return key;
    return std::nullopt;
}

const char* unit_of(const ReadingKey& key) { return row_of(key.quantity).unit; }
bool is_extent(const ReadingKey& key) { return row_of(key.quantity).is_extent; }
bool is_time(const ReadingKey& key) { return key.quantity == Quantity::pass_time; }
bool is_uncertainty(const ReadingKey& key) { return key.aspect >= Aspect::twin; }
bool is_of_cars(const ReadingKey& key) {
    return (key.aspect >= Aspect::cars_p05 && key.aspect <= Aspect::cars_p95) || key.quantity == Quantity::cars_within;
}

std::vector<ReadingKey> shapes_of(const ReadingKey& sample) {
    std::vector<ReadingKey> shapes;
    for (const Form& form : forms())
        if (form.quantity == sample.quantity)
            add_shapes(form.parts, {.quantity = form.quantity}, sample, shapes);
    return shapes;
}

std::vector<std::string> forms_in_words(const QuantityRow& row) {
    static constexpr std::pair<const char*, const char*> slots[] = {{"<name>", "NAME"}, {"<lane>", "LANE"},  {"<eye>", "EYE"},
                                                                    {"<m>", "50"},      {"<from>", "30"},    {"<to>", "60"},
                                                                    {"<lx>", "5"},      {"<percent>", "10"}, {"<rating>", "5"}};
    std::vector<std::string> all;
    for (const std::string_view form : split(row.forms, ' ')) {
        std::string& text = all.emplace_back();
        for (const auto& [part, words] : parts_of(form)) {
            std::string choice;
            for (const Word* word : words)
                choice.append(choice.empty() || word->spelt().empty() ? "" : "/").append(word->spelt());
            const bool may_miss = !words.empty() && words.front()->spelt().empty() && !choice.empty();
            if (!words.empty())
                text += may_miss ? "[" + choice + "]" : words.size() > 1 ? "(" + choice + ")" : choice;
            else if (part[0] == '<')
                text += std::ranges::find(slots, part, &std::pair<const char*, const char*>::first)->second;
            else
                text += part;
        }
    }
    return all;
}

const char* name_of(Aspect aspect) {
    static constexpr const char* names[] = {"value",    "by_control", "held_still",      "cars_p05",   "cars_median",
                                            "cars_p95", "twin",       "twin_difference", "grid_error", "standard_error"};
    return names[static_cast<std::size_t>(aspect)];
}

const char* name_of(Statistic statistic) {
    static constexpr const char* names[] = {"", "median", "min", "max", "p05", "p95", "spread", "mean"};
    return names[static_cast<std::size_t>(statistic)];
}

const char* name_of(ReadingSurface surface) {
    static constexpr const char* names[] = {"", "road", "target"};
    return names[static_cast<std::size_t>(surface)];
}

const char* name_of(ReadingPlace place) {
    static constexpr const char* names[] = {"",      "left_edge", "right_edge", "edges",       "left",    "right",   "overhead",
                                            "along", "across",    "left_bends", "right_bends", "mirrors", "own_eyes"};
    return names[static_cast<std::size_t>(place)];
}

const char* name_of(ThresholdUnit unit) {
    static constexpr const char* names[] = {"", "lx", "percent", "de_boer"};
    return names[static_cast<std::size_t>(unit)];
}

} // namespace fernlicht
