#include "runner/references.h"

#include "metrics/image_difference.h"
#include "runner/picture_file.h"
#include "runner/reference_store.h"
#include "runner/summary.h"
#include "scenarios/values/errors.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// Verdicts on many things of one kind: each that differs by itself, those that agree in one sum.
class Judgement {
  public:
    Judgement(std::string name, std::string rerun) : name_(std::move(name)), rerun_(std::move(rerun)) {}

    void agree(double share_of_tolerance, const std::string& text) {
        ++agreeing_;
        if (closest_text_.empty() || share_of_tolerance > closest_share_) {
            closest_share_ = share_of_tolerance;
            closest_text_ = text;
        }
    }
    void differ(const std::string& what, const std::string& text) {
        differing_.push_back({VerdictKind::fail, name_ + " " + what, text, rerun_});
    }
    std::vector<Verdict> finish(const std::string& things) {
        if (differing_.empty() && agreeing_ > 0)
            return {{VerdictKind::pass, name_, fmt::format("{} {} agree; the farthest off: {}", agreeing_, things, closest_text_), rerun_}};
        return std::move(differing_);
    }

  private:
    std::string name_, rerun_;
    std::size_t agreeing_ = 0;
    double closest_share_ = 0.0;
    std::string closest_text_;
    std::vector<Verdict> differing_;
};

std::string value_text(const Reading& reading) {
    return reading.value ? fmt::format("{} {}", *reading.value, reading.unit) : "not measured";
}

std::string reading_label(const Reading& reading) {
    return reading.tick < 0 ? reading.name : fmt::format("{} at frame {}", reading.name, reading.tick);
}

void judge_reading(Judgement& judgement, const Reading& tested, const Reading& accepted, const ReferenceTolerance& tolerance) {
    const std::string label = reading_label(accepted);
    const std::string text = fmt::format("{}, accepted {}", value_text(tested), value_text(accepted));
    if (tested.unit != accepted.unit || tested.value.has_value() != accepted.value.has_value())
        return judgement.differ(label, text);
    if (!accepted.value)
        return judgement.agree(0.0, fmt::format("{}, {}", label, text));
    const double difference = std::abs(*tested.value - *accepted.value);
    const double allowed = tolerance.absolute + tolerance.relative * std::abs(*accepted.value);
    const std::string figures =
        fmt::format("{}, {:.3g} % off", text, *accepted.value == 0.0 ? 0.0 : 100.0 * difference / std::abs(*accepted.value));
    if (difference <= allowed)
        judgement.agree(difference / allowed, fmt::format("{}, {}", label, figures));
    else
        judgement.differ(label, fmt::format("{}, at most {:.3g} %", figures, 100.0 * tolerance.relative));
}

std::vector<Verdict> judge_readings(const Readings& tested, const Readings& accepted, const std::string& rerun,
                                    const ReferenceTolerance& tolerance) {
    Judgement judgement("reference reading", rerun);
    const auto same = [](const Reading& a, const Reading& b) { return a.name == b.name && a.tick == b.tick; };
    for (const Reading& reference : accepted) {
        const auto found = std::ranges::find_if(tested, [&](const Reading& reading) { return same(reading, reference); });
        if (found == tested.end())
            judgement.differ(reading_label(reference), "not in this run, accepted " + value_text(reference));
        else
            judge_reading(judgement, *found, reference, tolerance);
    }
    for (const Reading& reading : tested)
        if (!is_of_time(reading) && std::ranges::none_of(accepted, [&](const Reading& reference) { return same(reading, reference); }))
            judgement.differ(reading_label(reading), value_text(reading) + ", nothing accepted to compare with");
    return judgement.finish("readings");
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

void judge_channels(Judgement& judgement, const std::string& label, const std::vector<PictureChannel>& tested,
                    const std::vector<PictureChannel>& accepted, const ReferenceTolerance& tolerance) {
    for (const PictureChannel& channel : tested)
        if (holds_light(channel.name) && !find(accepted, channel.name))
            judgement.differ(label, channel.name + ": nothing accepted to compare with");
    for (const PictureChannel& reference : accepted) {
        if (!holds_light(reference.name))
            continue;
        const PictureChannel* channel = find(tested, reference.name);
        if (!channel) {
            judgement.differ(label, reference.name + ": accepted, but not in this run");
            continue;
        }
        const ImageDifference difference = compare_images(channel->values, reference.values, tolerance.absolute, tolerance.relative);
        const std::string text = difference_text(difference, reference.name);
        if (difference.percent_over <= tolerance.percent_of_pixels)
            judgement.agree(difference.maximum, fmt::format("{}, {}", label, text));
        else
            judgement.differ(label, fmt::format("{}, at most {} %", text, tolerance.percent_of_pixels));
    }
}

std::vector<Verdict> judge_frames(const PlayedVariant& played, const std::filesystem::path& run_folder,
                                  const std::vector<ReferenceFrame>& accepted, const std::string& rerun,
                                  const ReferenceTolerance& tolerance) {
    Judgement judgement("reference frame", rerun);
    const auto same = [](const StoredFrame& frame, const ReferenceFrame& reference) {
        return frame.tick == reference.tick && frame.view == reference.view && !frame.exr.empty();
    };
    for (const ReferenceFrame& reference : accepted) {
        const std::string label = fmt::format("{} {}", reference.tick, reference.view);
        const auto found = std::ranges::find_if(played.frames, [&](const StoredFrame& frame) { return same(frame, reference); });
        if (found == played.frames.end()) {
            judgement.differ(label, "accepted, but not in this run");
            continue;
        }
        try {
            judge_channels(judgement, label, read_exr(run_folder / found->exr), read_exr(reference.exr), tolerance);
        } catch (const InputError& error) {
            judgement.differ(label, error.what());
        } catch (const std::invalid_argument& error) { // of other size, or with values that are no numbers
            judgement.differ(label, error.what());
        }
    }
    for (const StoredFrame& frame : played.frames)
        if (!frame.exr.empty() && std::ranges::none_of(accepted, [&](const ReferenceFrame& reference) { return same(frame, reference); }))
            judgement.differ(fmt::format("{} {}", frame.tick, frame.view), "nothing accepted to compare with");
    return judgement.finish("pictures");
}

} // namespace

std::vector<Verdict> judge_against_references(const PlayedVariant& played, const RunContext& context,
                                              const std::filesystem::path& run_folder, const std::filesystem::path& references_folder,
                                              const std::string& technique, const ReferenceTolerance& tolerance) {
    const ReferenceKey key = reference_key(played.drive, played.variant, technique, context);
    const auto failed = [&](const std::string& text) {
        return std::vector<Verdict>{{VerdictKind::fail, "reference", text, context.command}};
    };
    try {
        const std::optional<AcceptedReference> reference = find_reference(references_folder, key);
        if (!reference)
            return failed(fmt::format("nothing accepted in {} for {}", references_folder.string(), key_text(key)));
        std::vector<Verdict> verdicts = judge_readings(played.readings, reference->readings, context.command, tolerance);
        std::ranges::move(judge_frames(played, run_folder, reference->frames, context.command, tolerance), std::back_inserter(verdicts));
        return verdicts.empty() ? failed("the accepted reference holds neither readings nor frames") : verdicts;
    } catch (const InputError& error) {
        return failed(error.what());
    }
}

} // namespace fernlicht
