// One moment drawn small in every technique, side by side: what each makes of the same light.
#pragma once

#include "renderer/renderer.h"
#include "runner/findings/document.h"
#include "runner/play/stage.h"

#include <glm/vec2.hpp>

namespace fernlicht {

/// One technique's pictures of the moment.
struct SheetTile {
    Technique row;
    Image<Rgb8> colour;
    Image<float> illuminance_lx;   ///< empty: the technique believes in none
    std::optional<double> spot_lx; ///< at the sheet's spot
    std::string not_drawn;         ///< why the technique cannot draw the moment; "": it has
};

struct ContactSheet {
    std::string drive, title, lamp_set;
    Moment moment;
    View view;                         ///< the driver's, 320 pixels wide
    View spot;                         ///< a map of 3 x 3 pixels, the spot in the middle one
    std::optional<glm::dvec2> spot_px; ///< the spot in `view`; nullopt: out of the picture
    double spot_ahead_m = 0.0;         ///< of the bumper, on the own lane's centre, on the road
    double twin_lx = 0.0;              ///< there, of own lamps and sky, calculated in double precision without shadows
    std::vector<SheetTile> tiles;
};

/// Without tiles. The spot is 20 m ahead of the bumper. The drive has a perspective view.
ContactSheet new_sheet(const Stage& stage, const LampSet& lamp_set, const Moment& moment);

/// Draws the sheet's moment once more, by a renderer of its stage's scene. A technique that cannot draw what is mounted leaves a tile
/// without pictures. Throws DeviceError.
void add_tile(ContactSheet& sheet, Renderer& renderer);

/// The sheet of every technique, each with a renderer of its own that lives for its tiles only; one sheet a moment. `settings`: all but the
/// technique. Throws DeviceError.
void add_all_techniques(std::vector<ContactSheet>& sheets, const Stage& stage, Device& device, RendererSettings settings);

/// Pictures above, below them lux images in one false-colour scale, 0.1 to 100 lx, with its bar and a cross at the spot; five across,
/// names below.
Plot contact_sheet(const ContactSheet& sheet);

} // namespace fernlicht
