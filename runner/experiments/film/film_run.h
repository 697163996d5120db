// Drives as a film: all panels are drawn at the same times, shown by one exposure, and handed over frame by frame.
#pragma once

#include "renderer/renderer.h"
#include "runner/experiments/film/film_frame.h"
#include "runner/files/film_file.h"
#include "runner/play/play.h"

#include <functional>
#include <optional>

namespace fernlicht {

struct FilmOverlays {
    bool lux = false;      ///< the road from above in false colours, and their scale
    bool isolux = false;   ///< lines of equal illuminance on the ground of the driver's view
    bool readings = false; ///< reach and width of the moment
    bool speed = false;
};

struct FilmRequest {
    std::vector<Drive> drives;
    std::vector<std::string> lamp_sets; ///< by name; none: all of each drive
    FilmArrangement arrangement = FilmArrangement::automatic;
    FilmOverlays overlays;
    FrameRate rate; ///< in place of the drives' steps
    int width_px = 1280, height_px = 720;
    std::optional<double> vertical_fov_rad; ///< of the driver's view; nullopt: the drive's
    TickRange frames;                       ///< frame k shows the drives at k / rate
    std::string backend = "auto";
    LightPass light_pass = LightPass::automatic;
    bool quiet = false;
    std::function<void()> begin; ///< when all input is read and the device is found sane
    /// In the order of frames, perhaps by another thread.
    std::function<void(Image<plots::Colour> pixels, const plots::Drawing& marks, int number)> take;
};

struct FilmFound {
    int planned = 0, filmed = 0;
    std::string interrupted; ///< "" where all was filmed
    std::vector<std::string> notes;
};

/// The film is as long as the longest drive; of a shorter one the last picture stays. What is drawn does not grow with the film. Throws
/// InputError for drives without a driver's view, that are shown by different tone mappers or displays, or by one that is not sRGB or
/// follows the pictures; DeviceError; and what `take` throws.
FilmFound run_film(const FilmRequest& request);

} // namespace fernlicht
