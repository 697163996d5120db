// The drawing thread's part of a live drive: moments that are handed over become pictures in the report's folder.
#pragma once

#include "renderer/renderer.h"
#include "runner/play/capture.h"
#include "runner/play/live/live_pictures.h"
#include "runner/play/stage.h"

namespace fernlicht {

class LiveDrawing {
  public:
    /// To be made before the drive happens. Compiles what the drive's moments need while all lamps shine. Stage and device must outlive it.
    /// Throws DeviceError, and InputError for a tone mapper that is fitted and for white that adapts: both look at pictures that a live
    /// drive may leave out.
    LiveDrawing(const Stage& stage, const LampSet& lamp_set, Device& device, std::filesystem::path folder);

    /// Draws until no more come. Throws DeviceError.
    void draw_all(LivePictures& pictures);
    /// Puts frames and maps into the report, once all is drawn.
    void finish(PlayedCell& played);

    int drawn() const { return drawn_; }
    int captured() const { return captured_; }

  private:
    void draw(const LivePicture& picture);

    const Stage& stage_;
    std::string set_;
    std::filesystem::path folder_;
    Renderer renderer_;
    DisplayStep display_;
    Writers writers_;
    std::vector<StoredFrame> frames_;
    std::vector<LuxMap> maps_;
    int drawn_ = 0, captured_ = 0;
};

} // namespace fernlicht
