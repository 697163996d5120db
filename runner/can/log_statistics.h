// What a log of a CAN bus shows: by identifier, by channel. Fed frame by frame; memory grows with identifiers, not with frames.
#pragma once

#include "scenarios/can/can_frame.h"
#include "scenarios/can/frame_bits.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace fernlicht {

struct StatisticsOptions {
    double bitrate = 0.0;      ///< bit/s; 0: no load
    double data_bitrate = 0.0; ///< of CAN FD with bit rate switch, bit/s; 0: as `bitrate`
    double gap_factor = 3.0;   ///< a period is a gap where it is longer than so many medians
};

/// Times between frames, in ns. Of no periods all figures are 0.
class PeriodStatistics {
  public:
    void add(std::int64_t period_ns, std::int64_t ended_ns);
    std::uint64_t count() const { return count_; }
    std::int64_t least_ns() const { return least_; }
    std::int64_t most_ns() const { return most_; }
    std::int64_t most_ended_ns() const { return most_ended_; } ///< when the first of the longest ended
    double mean_ns() const { return mean_; }
    double deviation_ns() const; ///< standard deviation of the periods (n - 1): the jitter
    double median_ns() const;    ///< mean of those periods within 1.1 % of each other among which it is
    /// How many are longer than so many medians, to 1.1 %; nullopt where the median is 0.
    std::optional<std::uint64_t> gaps(double medians) const;

  private:
    std::uint64_t count_ = 0;
    std::int64_t least_ = 0, most_ = 0, most_ended_ = 0;
    double mean_ = 0.0, squares_ = 0.0;
    /// Periods of nearly one length: 64 bins an octave, those alone that there are.
    struct Bin {
        std::uint32_t index = 0;
        std::uint64_t count = 0;
        double sum_ns = 0.0;
    };
    std::vector<Bin> bins_; ///< ascending
};

/// Seconds of the bus by how stuffed bits are counted.
struct BusTime {
    double without_stuffing_s = 0.0, exact_s = 0.0, worst_s = 0.0;
    void operator+=(const BusTime& other);
    BusTime operator-(const BusTime& other) const;
};

/// One identifier on one channel; requests for its data apart.
struct IdStatistics {
    std::uint32_t id = 0;
    bool extended = false, remote = false;
    std::uint64_t frames = 0, fd_frames = 0, sent = 0;
    std::optional<std::int64_t> first_ns, last_ns; ///< nullopt: without stamps
    PeriodStatistics periods;
    std::uint64_t backwards = 0;                ///< stamps below the one before
    std::vector<std::uint8_t> lengths;          ///< that came, ascending
    std::array<std::uint8_t, 64> first_bytes{}; ///< each as it was first seen
    std::array<std::uint8_t, 64> changed{};     ///< bits that were ever different from that
    std::uint8_t bytes_seen = 0;                ///< length of the longest
    std::uint64_t frames_at_end = 0;            ///< stamped as the last: they begin what is no longer seen
    BusTime bus, bus_at_end;                    ///< of stamped frames; of those stamped as the last

    void add(const CanFrame& frame, bool stamped, std::optional<bool> sent_here);
};

struct ChannelStatistics {
    std::string name;
    std::vector<IdStatistics> ids; ///< ascending, 11 bits first, requests behind data
    std::uint64_t frames = 0, errors = 0, lost = 0, backwards = 0;
    std::array<std::uint64_t, 11> error_classes{}; ///< by can_error_classes; the last: others
    std::optional<std::int64_t> first_ns, last_ns;
    std::int64_t silence_ns = 0, silence_ended_ns = 0; ///< longest time without a frame
    std::uint64_t frames_at_end = 0;                   ///< stamped as the last
    BusTime bus, bus_at_end;
    double busiest_second = 0.0; ///< greatest share of the bus's time, exact bits, in whole seconds from the first frame on
    std::int64_t step_ns =
        0; ///< where most stamps equal the one before: what all times between them are multiples of, if above 1 us; else 0
    /// Seconds of the bus for a second of time, from the first stamp up to the last, without those stamped as the last: n - 1 of n frames.
    BusTime load() const;
    BusTime load(const IdStatistics& id) const; ///< of one identifier over the channel's time: all sum up to load()
    double seconds() const { return first_ns && last_ns ? static_cast<double>(*last_ns - *first_ns) * 1e-9 : 0.0; }
};

class LogStatistics {
  public:
    explicit LogStatistics(const StatisticsOptions& options) : options_(options) {}
    /// `stamped`: the frame's time counts. `sent`: as CandumpStyle has it.
    void add(const CanFrame& frame, bool stamped, std::optional<bool> sent);
    void lost(const std::string& channel, std::uint64_t frames);
    /// What was added so far, by name of the channel.
    std::vector<ChannelStatistics> so_far() const;

  private:
    struct Channel {
        ChannelStatistics all;
        std::unordered_map<std::uint32_t, IdStatistics> ids; ///< by identifier with the kernel's flags
        std::int64_t second = 0;                             ///< since first_ns, whose bus time is `second_s`
        double second_s = 0.0;
        std::int64_t step_ns = 0;       ///< 1000: no longer looked for
        std::uint64_t equal_stamps = 0; ///< to the frame before
    };
    Channel& channel(const std::string& name);
    void add_load(Channel& on, IdStatistics& id, const CanFrame& frame); ///< of a stamped one
    double wire_seconds(const FrameBits& bits) const;

    StatisticsOptions options_;
    std::map<std::string, Channel> channels_;
    Channel* last_ = nullptr; ///< of the frame before
};

} // namespace fernlicht
