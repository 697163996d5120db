// The beams of lamp files on the GPU, each uploaded once.
#pragma once

#include "renderer/gl/beam_bounds.h"
#include "renderer/gl/objects.h"
#include "scenarios/drives/moment.h"

#include <map>
#include <memory>

namespace fernlicht::gl {

/// Tangents in lamp space that a shadow map covers.
struct ShadowWindow {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

struct Beam {
    int id = 0; ///< in the order of upload
    BeamTexture grid;
    BeamBounds bounds;
    ShadowWindow window;
    bool steep = false; ///< reaches beyond 30 degrees up or down
    Texture texture;
};

class Beams {
  public:
    explicit Beams(Context& context) : context_(context) {}

    const Beam& of(const std::shared_ptr<const LampFile>& file);
    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    Context& context_;
    std::map<const LampFile*, std::pair<std::shared_ptr<const LampFile>, Beam>> known_;
    std::size_t texture_bytes_ = 0;
};

/// Lamps that shine, in the moment's order; with `all` those that are off too. Throws InputError for more than most_lamps.
std::vector<LitLamp> shining(const Moment& moment, bool all);
inline constexpr std::size_t most_lamps = 8;

/// A world direction in lamp space (x right, y up, z forward).
glm::dvec3 to_lamp_space(const LitLamp& lamp, const glm::dvec3& direction);

} // namespace fernlicht::gl
