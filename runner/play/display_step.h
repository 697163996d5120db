// How a drive's stored pictures are shown, from frame to PNG, within the play loop.
#pragma once

#include "metrics/display/display_colour.h"
#include "metrics/display/night_vision.h"
#include "runner/findings/report.h"
#include "scenarios/drives/play/frame.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace fernlicht {

/// Writes a frame's picture to a PNG.
using WritePicture = std::function<void(const Frame&, const View&, const std::filesystem::path&)>;

class DisplayStep {
  public:
    /// The drive's tone mapper is closed (fit_tone_mapper). It outlives what it is made for.
    explicit DisplayStep(const Drive& drive);

    /// What to draw besides, so that the picture can be shown: of a stored one its coloured light, and where white adapts that of each
    /// driver's.
    FrameOutputs with_light(FrameOutputs outputs, const View& view, bool stored, bool drivers) const;
    /// Whether the eye is followed, and so wants the driver's frame of every moment.
    bool adapts() const { return adapted_.has_value(); }
    /// The driver's frame of a moment, before its pictures are written. Nothing without adaptation.
    void see(const Frame& frame);
    /// Of that moment, with the exposure of now; may be called by another thread, and later. Frames without coloured light (techniques that
    /// compute no luminance) are written as they were drawn.
    WritePicture writer(const Moment& moment) const;
    /// What each stage took, a sample a picture. After all is written.
    std::vector<PassTime> times() const;
    /// How the pictures are seen; nullptr where the profile does not say from where, or how large its pixels are. After all is written.
    std::shared_ptr<const SeenDisplay> seen() const;

  private:
    struct Written {
        std::mutex mutex;
        std::vector<PassTime> stages;
        std::map<std::string, std::map<std::filesystem::path, double>> mean_cdm2; ///< by view and file, so that sums have one order
    };
    ToneMapper mapper() const;

    const Drive& drive_;
    bool after_drawing_;
    std::optional<AdaptedLuminance> adapted_;
    double first_cdm2_ = 0.0; ///< what the eye was adapted to at first, where white is the tone mapper's
    std::string icc_;
    std::shared_ptr<Written> written_;
};

} // namespace fernlicht
