#include "metrics/aliasing/temporal_aliasing.h"

#include "metrics/aliasing/spatial_aliasing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace fernlicht {
namespace {

constexpr std::size_t fewest_frames = 8;

void check(const std::vector<Image<double>>& aliasing, const std::vector<Image<double>>& levels, const std::vector<PixelTrack>& tracks,
           double rate_hz, double pixels_per_degree) {
    const bool fits = aliasing.size() >= fewest_frames && levels.size() == aliasing.size() && rate_hz > 0.0 && pixels_per_degree > 0.0;
    const auto pixels = fits ? static_cast<std::int64_t>(aliasing.front().size()) : 0;
    const bool one_size = fits && std::ranges::all_of(aliasing, [&](const auto& a) { return a.size() == aliasing.front().size(); }) &&
                          std::ranges::all_of(levels, [&](const auto& a) { return a.size() == aliasing.front().size(); });
    const bool within = std::ranges::all_of(tracks, [&](const PixelTrack& track) {
        return track.size() == aliasing.size() && std::ranges::all_of(track, [&](std::int32_t p) { return p >= 0 && p < pixels; });
    });
    if (!one_size || !within)
        throw std::invalid_argument(fmt::format("aliasing over time takes at least {} frames of one size, tracks within them, a rate and a "
                                                "resolution above 0; found {} frames",
                                                fewest_frames, aliasing.size()));
}

/// Mean squares at the frequencies k / frames of the rate, k = 1 ... frames / 2; their sum is the variance under a Hann window.
class Periodogram {
  public:
    explicit Periodogram(std::size_t frames) : frames_(frames) {
        for (std::size_t t = 0; t < frames; ++t) {
            const double at = 2.0 * std::numbers::pi / static_cast<double>(frames);
            turns_.push_back(std::polar(1.0, -at * static_cast<double>(t)));
            window_.push_back(0.5 - 0.5 * std::cos(at * (static_cast<double>(t) + 0.5)));
            weight_ += window_.back();
            squares_ += window_.back() * window_.back();
        }
    }

    std::vector<double> of(std::vector<double> values) const {
        const double first = values.front(); // equal values come out as exactly 0
        double mean = 0.0;
        for (std::size_t t = 0; t < frames_; ++t) {
            values[t] -= first;
            mean += window_[t] * values[t] / weight_;
        }
        std::vector<double> powers;
        for (std::size_t k = 1; k <= frames_ / 2; ++k) {
            std::complex<double> sum = 0.0;
            for (std::size_t t = 0; t < frames_; ++t)
                sum += window_[t] * (values[t] - mean) * turns_[k * t % frames_];
            powers.push_back((2 * k == frames_ ? 1.0 : 2.0) * std::norm(sum) / (static_cast<double>(frames_) * squares_));
        }
        return powers;
    }

  private:
    std::size_t frames_;
    std::vector<std::complex<double>> turns_;
    std::vector<double> window_;
    double weight_ = 0.0, squares_ = 0.0;
};

/// Sums of squared contrast over tracks, by frequency.
std::vector<double> summed(const std::vector<TrackSamples>& tracks, std::size_t frames) {
    const Periodogram periodogram(frames);
    std::vector<double> sums(frames / 2);
    for (const TrackSamples& track : tracks) {
        const double level = std::max(track.level, min_seen_cdm2);
        const std::vector<double> powers = periodogram.of(track.values);
        for (std::size_t k = 0; k < powers.size(); ++k)
            sums[k] += powers[k] / (level * level);
    }
    return sums;
}

/// Frequencies below `from_hz` are left out.
TemporalAliasing weighed(const std::vector<double>& sums, std::size_t tracks, std::size_t frames, double rate_hz, double pixels_per_degree,
                         double from_hz = 0.0) {
    TemporalAliasing result;
    result.tracks = tracks;
    const double count = std::max(1.0, static_cast<double>(tracks));
    double crawl = 0.0, flicker = 0.0, visible = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        const double square = sums[k] / count, hertz = rate_hz * static_cast<double>(k + 1) / static_cast<double>(frames);
        if (hertz < from_hz)
            continue;
        const double sensitivity = flicker_sensitivity(0.25 * pixels_per_degree, hertz);
        (hertz < crawl_below_hz ? crawl : flicker) += square;
        visible += 2.0 * square * sensitivity * sensitivity; // a sine's modulation^2 is twice its mean square
        result.spectrum.push_back({hertz, 100.0 * std::sqrt(square)});
    }
    result.crawl_percent = 100.0 * std::sqrt(crawl);
    result.flicker_percent = 100.0 * std::sqrt(flicker);
    result.visible = std::sqrt(visible);
    return result;
}

std::vector<TrackSamples> sampled(const std::vector<Image<double>>& pictures, const std::vector<Image<double>>& levels,
                                  const std::vector<PixelTrack>& tracks) {
    std::vector<TrackSamples> samples;
    for (const PixelTrack& track : tracks) {
        TrackSamples& one = samples.emplace_back();
        for (std::size_t t = 0; t < track.size(); ++t) {
            const auto pixel = static_cast<std::size_t>(track[t]);
            one.values.push_back(pictures[t].pixels()[pixel]);
            one.level += levels[t].pixels()[pixel] / static_cast<double>(track.size());
        }
    }
    return samples;
}

/// Each less the mean of the others, pixel by pixel.
std::vector<Image<double>> without_standing(const std::vector<Image<double>>& pictures) {
    std::vector<Image<double>> out = pictures;
    const double others = static_cast<double>(pictures.size() - 1);
    for (std::size_t i = 0; i < pictures.front().size(); ++i) {
        double sum = 0.0;
        for (const Image<double>& picture : pictures)
            sum += picture.pixels()[i];
        for (Image<double>& picture : out)
            picture.pixels()[i] -= (sum - picture.pixels()[i]) / others;
    }
    return out;
}

void remove_line(std::vector<double>& values) {
    const double count = static_cast<double>(values.size()), middle = 0.5 * (count - 1.0);
    double mean = 0.0, slope = 0.0, squares = 0.0;
    for (std::size_t t = 0; t < values.size(); ++t) {
        const double at = static_cast<double>(t) - middle;
        mean += values[t] / count;
        slope += at * values[t];
        squares += at * at;
    }
    for (std::size_t t = 0; t < values.size(); ++t)
        values[t] -= mean + slope / squares * (static_cast<double>(t) - middle);
}

} // namespace

double flicker_sensitivity(double cycles_per_degree, double hertz) {
    if (!(cycles_per_degree > 0.0 && hertz >= 0.0 && std::isfinite(cycles_per_degree) && std::isfinite(hertz)))
        throw std::invalid_argument("a flicker sensitivity takes a spatial frequency above 0 and a temporal one from 0 up");
    if (hertz == 0.0)
        return 0.0;
    const double a = 2.0 * std::numbers::pi * cycles_per_degree, v = hertz / cycles_per_degree;
    const double slowness = std::abs(std::log10(v / 3.0));
    return (6.1 + 7.3 * slowness * slowness * slowness) * v * a * a * std::exp(-2.0 * a * (v + 2.0) / 45.9);
}

TemporalAliasing measure_temporal_aliasing(const std::vector<Image<double>>& aliasing, const std::vector<Image<double>>& levels,
                                           const std::vector<PixelTrack>& tracks, double rate_hz, double pixels_per_degree) {
    check(aliasing, levels, tracks, rate_hz, pixels_per_degree);
    const std::size_t frames = aliasing.size();
    TemporalAliasing result = weighed(summed(sampled(aliasing, levels, tracks), frames), tracks.size(), frames, rate_hz, pixels_per_degree);
    const TemporalAliasing moves =
        weighed(summed(sampled(without_standing(aliasing), levels, tracks), frames), tracks.size(), frames, rate_hz, pixels_per_degree);
    const double all = result.flicker_percent * result.flicker_percent, others = static_cast<double>(frames - 1);
    result.standing_percent = std::sqrt(std::max(0.0, all - moves.flicker_percent * moves.flicker_percent * others / (others + 1.0)));
    return result;
}

TemporalAliasing measure_flicker(const std::vector<TrackSamples>& tracks, double rate_hz, double pixels_per_degree) {
    const std::size_t frames = tracks.empty() ? fewest_frames : tracks.front().values.size();
    if (frames < fewest_frames || !std::ranges::all_of(tracks, [&](const TrackSamples& t) { return t.values.size() == frames; }) ||
        !(rate_hz > 0.0 && pixels_per_degree > 0.0))
        throw std::invalid_argument(
            fmt::format("flicker takes at least {} frames, a rate and a resolution above 0; found {} frames", fewest_frames, frames));
    std::vector<TrackSamples> level = tracks;
    for (TrackSamples& track : level)
        if (std::ranges::any_of(track.values, [&](double v) { return v != track.values.front(); })) // equal values stay exactly that
            remove_line(track.values);
    TemporalAliasing result = weighed(summed(level, frames), tracks.size(), frames, rate_hz, pixels_per_degree, crawl_below_hz);
    result.crawl_percent.reset();
    return result;
}

} // namespace fernlicht
