#include "runner/can/log_statistics.h"

#include "scenarios/can/can_filter.h"
#include "scenarios/can/error_words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

namespace fernlicht {
namespace {

/// 64 an octave, by the logarithm's whole part and the six bits behind it.
std::uint32_t period_bin(std::int64_t period_ns) {
    const auto value = static_cast<std::uint64_t>(period_ns);
    const auto octave = static_cast<std::uint32_t>(std::bit_width(value | 1U)) - 1;
    const std::uint64_t within = octave >= 6 ? value >> (octave - 6) : value << (6 - octave);
    return octave * 64 + static_cast<std::uint32_t>(within & 63U);
}

} // namespace

void PeriodStatistics::add(std::int64_t period_ns, std::int64_t ended_ns) {
    ++count_;
    if (count_ == 1 || period_ns < least_)
        least_ = period_ns;
    if (count_ == 1 || period_ns > most_) {
        most_ = period_ns;
        most_ended_ = ended_ns;
    }
    const double value = static_cast<double>(period_ns), off = value - mean_; // Welford
    mean_ += off / static_cast<double>(count_);
    squares_ += off * (value - mean_);
    const std::uint32_t index = period_bin(period_ns);
    auto bin = std::ranges::lower_bound(bins_, index, {}, &Bin::index);
    if (bin == bins_.end() || bin->index != index)
        bin = bins_.insert(bin, Bin{index, 0, 0.0});
    ++bin->count;
    bin->sum_ns += value;
}

double PeriodStatistics::deviation_ns() const { return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : 0.0; }

double PeriodStatistics::median_ns() const {
    std::uint64_t so_far = 0;
    for (const Bin& bin : bins_) {
        so_far += bin.count;
        if (2 * so_far >= count_)
            return bin.sum_ns / static_cast<double>(bin.count);
    }
    return 0.0;
}

std::optional<std::uint64_t> PeriodStatistics::gaps(double medians) const {
    const double bound = medians * median_ns();
    if (bound <= 0.0)
        return std::nullopt;
    std::uint64_t longer = 0;
    for (const Bin& bin : bins_)
        if (bin.sum_ns > bound * static_cast<double>(bin.count))
            longer += bin.count;
    return longer;
}

void BusTime::operator+=(const BusTime& other) {
    without_stuffing_s += other.without_stuffing_s;
    exact_s += other.exact_s;
    worst_s += other.worst_s;
}

BusTime BusTime::operator-(const BusTime& other) const {
    return {without_stuffing_s - other.without_stuffing_s, exact_s - other.exact_s, worst_s - other.worst_s};
}

BusTime ChannelStatistics::load() const {
    const BusTime taken = bus - bus_at_end;
    return {taken.without_stuffing_s / seconds(), taken.exact_s / seconds(), taken.worst_s / seconds()};
}

BusTime ChannelStatistics::load(const IdStatistics& id) const {
    const BusTime taken = id.bus - (id.last_ns == last_ns ? id.bus_at_end : BusTime{});
    return {taken.without_stuffing_s / seconds(), taken.exact_s / seconds(), taken.worst_s / seconds()};
}

void IdStatistics::add(const CanFrame& frame, bool stamped, std::optional<bool> sent_here) {
    ++frames;
    fd_frames += frame.fd ? 1U : 0U;
    sent += sent_here.value_or(false) ? 1U : 0U;
    if (const auto at = std::ranges::lower_bound(lengths, frame.length); at == lengths.end() || *at != frame.length)
        lengths.insert(at, frame.length);
    if (stamped) {
        if (last_ns != frame.time_ns) {
            frames_at_end = 0;
            bus_at_end = {};
        }
        ++frames_at_end;
        if (!last_ns)
            first_ns = frame.time_ns;
        else if (frame.time_ns < *last_ns)
            ++backwards;
        else
            periods.add(frame.time_ns - *last_ns, frame.time_ns);
        last_ns = frame.time_ns;
    }
    const std::size_t length = frame.bytes().size();
    for (std::size_t i = 0; i < std::min<std::size_t>(length, bytes_seen); ++i)
        changed[i] = static_cast<std::uint8_t>(changed[i] | (frame.data[i] ^ first_bytes[i]));
    for (std::size_t i = bytes_seen; i < length; ++i)
        first_bytes[i] = frame.data[i];
    bytes_seen = std::max(bytes_seen, static_cast<std::uint8_t>(length));
}

LogStatistics::Channel& LogStatistics::channel(const std::string& name) {
    if (!last_ || last_->all.name != name) {
        last_ = &channels_[name];
        last_->all.name = name;
    }
    return *last_;
}

double LogStatistics::wire_seconds(const FrameBits& bits) const {
    const double data_bitrate = options_.data_bitrate > 0.0 ? options_.data_bitrate : options_.bitrate;
    return bits.nominal / options_.bitrate + bits.data / data_bitrate;
}

void LogStatistics::add_load(Channel& on, IdStatistics& id, const CanFrame& frame) {
    const BusTime time{wire_seconds(frame_bits(frame, BitStuffing::none)), wire_seconds(frame_bits(frame, BitStuffing::exact)),
                       wire_seconds(frame_bits(frame, BitStuffing::worst))};
    id.bus += time;
    id.bus_at_end += time;
    on.all.bus += time;
    on.all.bus_at_end += time;
    if (frame.time_ns < *on.all.first_ns)
        return;
    const std::int64_t second = (frame.time_ns - *on.all.first_ns) / 1'000'000'000;
    if (second != on.second)
        on.second_s = 0.0;
    on.second = second;
    on.second_s += time.exact_s;
    on.all.busiest_second = std::max(on.all.busiest_second, on.second_s);
}

void LogStatistics::add(const CanFrame& frame, bool stamped, std::optional<bool> sent) {
    Channel& on = channel(frame.channel);
    ChannelStatistics& all = on.all;
    ++all.frames;
    if (stamped) {
        if (all.last_ns != frame.time_ns) {
            all.frames_at_end = 0;
            all.bus_at_end = {};
        }
        ++all.frames_at_end;
        if (!all.last_ns) {
            all.first_ns = frame.time_ns;
        } else if (frame.time_ns < *all.last_ns) {
            ++all.backwards;
        } else if (frame.time_ns - *all.last_ns > all.silence_ns) {
            all.silence_ns = frame.time_ns - *all.last_ns;
            all.silence_ended_ns = frame.time_ns;
        }
        on.equal_stamps += all.last_ns == frame.time_ns ? 1U : 0U;
        if (all.last_ns && on.step_ns != 1000)
            on.step_ns = std::max<std::int64_t>(std::gcd(on.step_ns, frame.time_ns - *all.last_ns), on.step_ns == 0 ? 0 : 1000);
        all.last_ns = frame.time_ns;
    }
    if (frame.error) {
        ++all.errors;
        bool known = false;
        for (std::size_t i = 0; i < can_error_classes.size(); ++i)
            if (frame.id >> i & 1) {
                ++all.error_classes[i];
                known = true;
            }
        all.error_classes.back() += known ? 0U : 1U;
        return;
    }
    IdStatistics& id = on.ids[kernel_can_id(frame)];
    id.id = frame.id;
    id.extended = frame.extended;
    id.remote = frame.remote;
    id.add(frame, stamped, sent);
    if (options_.bitrate > 0.0 && stamped)
        add_load(on, id, frame);
}

void LogStatistics::lost(const std::string& name, std::uint64_t frames) { channel(name).all.lost += frames; }

std::vector<ChannelStatistics> LogStatistics::so_far() const {
    std::vector<ChannelStatistics> out;
    for (const auto& [name, one] : channels_) {
        ChannelStatistics& all = out.emplace_back(one.all);
        for (const auto& [key, id] : one.ids)
            all.ids.push_back(id);
        std::ranges::sort(all.ids, [](const IdStatistics& a, const IdStatistics& b) {
            return std::tuple(a.extended, a.id, a.remote) < std::tuple(b.extended, b.id, b.remote);
        });
        all.step_ns = one.step_ns > 1000 && 2 * one.equal_stamps > all.frames ? one.step_ns : 0;
    }
    return out;
}

} // namespace fernlicht
