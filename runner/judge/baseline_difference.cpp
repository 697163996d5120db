#include "runner/judge/baseline_difference.h"

#include "metrics/images/image_difference.h"
#include "metrics/readings/reading_labels.h"
#include "metrics/statistics/statistics.h"
#include "runner/files/picture_file.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

std::string value_text(const AcceptedReading& reading) {
    return reading.mean.measured()
               ? with_bound(reading.mean, fmt::format("{:.7g}{}", *reading.mean.figure(), unit_suffix(unit_of(reading.key))))
               : "not measured";
}

std::string label_of(const AcceptedReading& reading) {
    return name_of(reading.key) + (reading.tick < 0 ? "" : fmt::format(" at frame {}", reading.tick));
}

ResultDifference only_one(const std::string& what, const std::string& text, const std::optional<ReadingKey>& reading = {}) {
    return {what, Agreement::differs, text, 0.0, reading};
}

/// By the spread over the repeats: the tolerance for rounding, and on top what chance reaches.
ResultDifference judge_by_spread(ResultDifference difference, double off, double rounding, const SpreadTest& test,
                                 const std::string& figures, const BaselineTolerance& tolerance) {
    const double by_chance = test.bound * test.standard_error, allowed = rounding + by_chance;
    difference.of_allowed = off / allowed;
    difference.text =
        fmt::format("{}, z = {:.3g}, at most {:.3g} by chance ({} repeats beyond the first), and {:.3g}{} for rounding", figures,
                    off / test.standard_error, test.bound, test.freedom, rounding, unit_suffix(unit_of(*difference.reading)));
    if (off <= rounding && test.standard_error <= rounding / tolerance.negligible_noise)
        difference.agreement = Agreement::agrees; // as where nothing varies
    else if (off > allowed)
        difference.agreement = Agreement::differs;
    else if (allowed > tolerance.max_allowed * rounding) {
        difference.agreement = Agreement::undecided;
        difference.text += fmt::format(": chance alone may reach {:.3g}, too much to see 1 %: accept a run with more repeats", by_chance);
    }
    return difference;
}

/// `other`: the figure whose exactness or sensitivity the reading tells, 0 for one that stands for itself.
ResultDifference compare(const AcceptedReading& tested, const AcceptedReading& accepted, double other, const BaselineTolerance& tolerance,
                         std::size_t comparisons) {
    ResultDifference difference{label_of(accepted), Agreement::agrees, "", 0.0, accepted.key};
    const std::string text = fmt::format("{}, accepted {}", value_text(tested), value_text(accepted));
    if (tested.mean.measured() != accepted.mean.measured())
        return only_one(difference.what, text, accepted.key);
    difference.text = text;
    if (!accepted.mean.measured())
        return difference;
    // A bound by its figure, too: where light ends just at the edge of what is looked at, rounding makes a number of a bound.
    const double was = *accepted.mean.figure(), off = std::abs(*tested.mean.figure() - was);
    const double rounding = tolerance.absolute + tolerance.relative * std::abs(was) + tolerance.of_other * std::abs(other);
    const std::string unit = unit_suffix(unit_of(accepted.key)),
                      figures = fmt::format("{}, off by {:.3g}{}{}", text, off, unit,
                                            was == 0.0 ? "" : fmt::format(" ({:.3g} %)", 100.0 * off / std::abs(was)));
    const auto test = spread_test({tested.count, tested.variance}, {accepted.count, accepted.variance}, tolerance.false_alarm, comparisons);
    if (test)
        return judge_by_spread(difference, off, rounding, *test, figures, tolerance);
    difference.of_allowed = off / rounding;
    difference.agreement = off <= rounding ? Agreement::agrees : Agreement::differs;
    difference.text = fmt::format("{}, allowed for rounding: {:.3g}{}", figures, rounding, unit);
    return difference;
}

/// Channels that hold light; depth belongs to geometry.
bool holds_light(const std::string& channel) { return channel.ends_with(".lx") || channel.ends_with(".cdm2"); }

std::string difference_text(const ImageDifference& difference, const std::string& channel) {
    if (difference.identical)
        return channel + " identical";
    const std::string psnr = std::isfinite(difference.psnr_db) ? fmt::format("{:.1f} dB", difference.psnr_db) : "not measured";
    return fmt::format("{}: maximum {:.4g} at pixel {}, {}, RMSE {:.3g}, PSNR {}, {:.3g} % of pixels over the threshold", channel,
                       difference.maximum, difference.maximum_x, difference.maximum_y, difference.rmse, psnr, difference.percent_over);
}

const PictureChannel* find(const std::vector<PictureChannel>& channels, const std::string& name) {
    const auto found = std::ranges::find(channels, name, &PictureChannel::name);
    return found == channels.end() ? nullptr : &*found;
}

/// The channel that holds a channel's variance, in pictures that were drawn by rays.
std::string variance_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    return channel.substr(0, dot) + (channel.ends_with(".lx") ? ".variance_lx2" : ".variance_cd2m4");
}

/// Each pixel's variance comes from the spread of 8 means of direct light, 16 of paths (docs/reference.md): the fewer hold for both.
constexpr int pixel_freedom = 7;

/// A picture by rays: the light's channel, its variance, and which pixels are mixed.
NoisyPicture noisy_picture(const std::vector<PictureChannel>& channels, const PictureChannel& light, const PictureChannel& variance) {
    const PictureChannel* const mixed = find(channels, "mixed");
    return {&light.values, &variance.values, mixed ? &mixed->values : nullptr, pixel_freedom};
}

ResultDifference compare_noise(const std::string& label, const std::string& channel, const NoisyPicture& tested,
                               const NoisyPicture& accepted, const BaselineTolerance& tolerance) {
    const NoisyDifference found = compare_noisy(tested, accepted, tolerance.absolute, tolerance.relative, tolerance.false_alarm);
    if (found.identical)
        return {label, Agreement::agrees, channel + " identical", 0.0};
    ResultDifference difference{label, found.differs() ? Agreement::differs : Agreement::agrees, "", 0.0};
    difference.of_allowed = found.worst_bound > 0.0 ? found.worst_z / found.worst_bound : 0.0;
    difference.text = fmt::format(
        "{}: z of the worst of {} squares of {} pixels {:.3g} from pixel {}, {} on, at most {:.3g} by chance, {} beyond; z of their sum "
        "{:.3g}, "
        "at most {:.3g}; {:.4g} % of the accepted light; left out {} of {} pixels, which are mixed; {} pixels without noise differ",
        channel, found.blocks, noise_block_px, found.worst_z, found.worst_x, found.worst_y, found.worst_bound, found.blocks_over,
        found.sum_z, found.sum_bound, 100.0 * found.sum_ratio, found.left_out, found.left_out + found.compared, found.exact_over);
    if (!found.differs() && !found.enough()) {
        difference.agreement = Agreement::undecided;
        difference.text += "; more are left out than are compared: accept a picture of more pixels";
    }
    return difference;
}

void compare_channels(std::vector<ResultDifference>& out, const std::string& label, const std::vector<PictureChannel>& tested,
                      const std::vector<PictureChannel>& accepted, const BaselineTolerance& tolerance) {
    for (const PictureChannel& channel : tested)
        if (holds_light(channel.name) && !find(accepted, channel.name))
            out.push_back(only_one(label, channel.name + ": nothing accepted to compare with"));
    for (const PictureChannel& baseline : accepted) {
        if (!holds_light(baseline.name))
            continue;
        const PictureChannel* channel = find(tested, baseline.name);
        if (!channel) {
            out.push_back(only_one(label, baseline.name + ": accepted, but not in this run"));
            continue;
        }
        const PictureChannel *noise = find(tested, variance_of(baseline.name)), *noise_before = find(accepted, variance_of(baseline.name));
        if (noise && noise_before) {
            out.push_back(compare_noise(label, baseline.name, noisy_picture(tested, *channel, *noise),
                                        noisy_picture(accepted, baseline, *noise_before), tolerance));
            continue;
        }
        const ImageDifference difference = compare_images(channel->values, baseline.values, tolerance.absolute, tolerance.relative);
        const bool agrees = difference.percent_over <= tolerance.percent_of_pixels;
        const std::string text = difference_text(difference, baseline.name);
        out.push_back({label, agrees ? Agreement::agrees : Agreement::differs,
                       agrees ? text : fmt::format("{}, at most {} %", text, tolerance.percent_of_pixels), difference.maximum});
    }
}

} // namespace

std::vector<ResultDifference> compare_readings(const std::vector<AcceptedReading>& tested, const std::vector<AcceptedReading>& accepted,
                                               const BaselineTolerance& tolerance) {
    const auto same = [](const AcceptedReading& a, const AcceptedReading& b) { return a.key == b.key && a.tick == b.tick; };
    const auto other_of = [&](AcceptedReading reading) {
        if (!is_uncertainty(reading.key))
            return 0.0;
        reading.key.aspect = Aspect::value;
        const auto found = std::ranges::find_if(accepted, [&](const AcceptedReading& other) { return same(other, reading); });
        return found == accepted.end() ? 0.0 : found->mean.figure().value_or(0.0);
    };
    std::vector<ResultDifference> out;
    for (const AcceptedReading& baseline : accepted) {
        const auto found = std::ranges::find_if(tested, [&](const AcceptedReading& reading) { return same(reading, baseline); });
        if (found == tested.end())
            out.push_back(only_one(label_of(baseline), "not in this run, accepted " + value_text(baseline), baseline.key));
        else
            out.push_back(compare(*found, baseline, other_of(baseline), tolerance, accepted.size()));
    }
    for (const AcceptedReading& reading : tested)
        if (std::ranges::none_of(accepted, [&](const AcceptedReading& baseline) { return same(reading, baseline); }))
            out.push_back(only_one(label_of(reading), value_text(reading) + ", nothing accepted to compare with", reading.key));
    return out;
}

std::vector<ResultDifference> compare_frames(const std::vector<BaselineFrame>& tested, const std::vector<BaselineFrame>& accepted,
                                             const BaselineTolerance& tolerance) {
    const auto same = [](const BaselineFrame& a, const BaselineFrame& b) { return a.tick == b.tick && a.view == b.view; };
    const auto label_of = [](const BaselineFrame& frame) { return fmt::format("{} {}", frame.tick, frame.view); };
    std::vector<ResultDifference> out;
    for (const BaselineFrame& baseline : accepted) {
        const std::string label = label_of(baseline);
        const auto found = std::ranges::find_if(tested, [&](const BaselineFrame& frame) { return same(frame, baseline); });
        if (found == tested.end()) {
            out.push_back(only_one(label, "accepted, but not in this run"));
            continue;
        }
        try {
            compare_channels(out, label, read_exr(found->exr), read_exr(baseline.exr), tolerance);
        } catch (const InputError& error) {
            out.push_back(only_one(label, error.what()));
        } catch (const std::invalid_argument& error) { // of other size, or with values that are no numbers
            out.push_back(only_one(label, error.what()));
        }
    }
    for (const BaselineFrame& frame : tested)
        if (std::ranges::none_of(accepted, [&](const BaselineFrame& baseline) { return same(frame, baseline); }))
            out.push_back(only_one(label_of(frame), "nothing accepted to compare with"));
    return out;
}

} // namespace fernlicht
