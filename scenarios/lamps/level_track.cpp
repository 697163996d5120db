#include "scenarios/lamps/level_track.h"

#include "scenarios/lamps/pixel_lamp.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t files_kept = 4;
constexpr std::size_t most_changes = std::size_t{1} << 28; ///< 2 GiB

} // namespace

LevelTrack::LevelTrack(std::shared_ptr<const LampFile> lamp) : lamp_(std::move(lamp)) {
    if (!lamp_->pixels)
        throw std::invalid_argument("level track: a lamp without pixels");
    full_ = std::make_shared<const LampFile>(*lamp_);
    last_.assign(lamp_->pixels->count(), 1.0F);
    course_ = at_the_beginning();
}

void LevelTrack::ask(double time_s, std::span<const float> levels, const InputError::Where& where) {
    if (levels.size() != last_.size())
        throw std::invalid_argument(fmt::format("level track: {} levels of {} pixels", levels.size(), last_.size()));
    const std::scoped_lock lock(mutex_);
    const PixelAnswer& answer = lamp_->pixels->answer();
    const bool first = asked_.empty();
    Asked asked{first ? -std::numeric_limits<double>::infinity() : time_s + answer.latency_s, {}};
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const float level =
            answer.steps > 0 ? std::round(levels[i] * static_cast<float>(answer.steps)) / static_cast<float>(answer.steps) : levels[i];
        if (level != last_[i])
            asked.changes.push_back({static_cast<std::uint32_t>(i), last_[i] = level});
    }
    if (asked.changes.empty() && !first)
        return;
    kept_changes_ += asked.changes.size();
    if (kept_changes_ > most_changes)
        throw InputError(where, fmt::format("more than {} changes of a pixel's level", most_changes),
                         "fewer pixels, or fewer of their changes");
    asked_.push_back(std::move(asked));
}

LevelTrack::Course LevelTrack::at_the_beginning() const {
    const std::vector<float> full(last_.size(), 1.0F);
    return {0, full, full, std::vector<double>(last_.size(), -std::numeric_limits<double>::infinity())};
}

float LevelTrack::level(std::size_t pixel, double time_s) const {
    const double from = static_cast<double>(course_.from[pixel]), to = static_cast<double>(course_.to[pixel]);
    const double way = lamp_->pixels->answer().slew_per_s * (time_s - course_.since_s[pixel]);
    if (from == to || !(way < std::abs(to - from))) // infinitely fast at once: NaN
        return course_.to[pixel];
    return static_cast<float>(from + std::copysign(way, to - from));
}

std::vector<float> LevelTrack::levels(double time_s) const {
    const std::scoped_lock lock(mutex_);
    return locked_levels(time_s);
}

std::vector<float> LevelTrack::locked_levels(double time_s) const {
    if (course_.done > 0 && asked_[course_.done - 1].arrives_s > time_s)
        course_ = at_the_beginning();
    for (; course_.done < asked_.size() && asked_[course_.done].arrives_s <= time_s; ++course_.done) {
        const Asked& asked = asked_[course_.done];
        for (const auto& [pixel, to] : asked.changes) {
            course_.from[pixel] = std::isinf(asked.arrives_s) ? to : level(pixel, asked.arrives_s);
            course_.to[pixel] = to;
            course_.since_s[pixel] = asked.arrives_s;
        }
    }
    std::vector<float> levels(course_.to.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
        levels[i] = level(i, time_s);
    return levels;
}

std::shared_ptr<const LampFile> LevelTrack::at(double time_s) const {
    const std::scoped_lock lock(mutex_);
    const std::vector<float> now = locked_levels(time_s);
    const double moment_s = now != course_.to ? time_s : std::numeric_limits<double>::quiet_NaN();
    const auto known = std::ranges::find_if(shown_, [&](const Shown& shown) {
        return shown.done == course_.done && (shown.time_s == moment_s || (std::isnan(shown.time_s) && std::isnan(moment_s)));
    });
    if (known != shown_.end()) {
        std::rotate(known, known + 1, shown_.end());
        return shown_.back().file;
    }
    std::shared_ptr<const LampFile> file = full_;
    if (std::ranges::any_of(now, [](float level) { return level != 1.0F; })) {
        auto state = std::make_shared<LampFile>();
        state->name = full_->name;
        state->format = full_->format;
        state->table = full_->pixels->table(now);
        state->state_of = full_;
        file = std::move(state);
    }
    if (shown_.size() == files_kept)
        shown_.erase(shown_.begin());
    return shown_.emplace_back(Shown{course_.done, moment_s, std::move(file)}).file;
}

} // namespace fernlicht
