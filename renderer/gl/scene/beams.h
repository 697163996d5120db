// The beams of lamp files on the GPU, each uploaded once.
// How bright a beam can be at most within a cone of directions: what decides, without looking at a triangle, that no light can arrive.
#pragma once

#include "renderer/beam_texture.h"
#include "renderer/gl/device/objects.h"
#include "scenarios/drives/play/camera.h"

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>

namespace fernlicht::gl {

class BeamBounds {
  public:
    BeamBounds() = default;
    explicit BeamBounds(const BeamTexture& beam);

    /// No direction towards the sphere has more, in cd. `centre` in lamp space. 0 only where the beam is exactly dark.
    double max_towards(const glm::dvec3& centre, double radius) const;

    double most() const { return most_; } ///< cd, in any direction

  private:
    double h_first_ = 0.0, v_first_ = 0.0, h_cell_ = 1.0, v_cell_ = 1.0, most_ = 0.0;
    int columns_ = 0, rows_ = 0;
    std::vector<float> max_of_cell_;
};

/// Tangents in lamp space that a shadow map covers.
struct ShadowWindow {
    double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0;
};

struct Beam {
    int id = 0;             ///< in the order of upload
    int shape = 0;          ///< id of the first that lies on the same grid: all that shaders are compiled for
    BeamTexture grid;       ///< without texels, unless these are kept
    double cd_a_unit = 1.0; ///< of what a look-up gives: 1 for float, the largest value for steps of it
    BeamBounds bounds;
    ShadowWindow window;
    bool steep = false; ///< reaches beyond 30 degrees up or down
    Texture texture;
};

/// Of one channel with so many bits (BeamTexels): as it is with 32, else in steps.
Texture make_texels(Context& context, int width, int height, int bits, std::span<const float> values, std::span<const std::uint16_t> steps);

class Beams {
  public:
    /// `kept`: texels stay in the beams' grids for who lights on the CPU; else they are on the device alone.
    Beams(Context& context, const std::optional<BeamTexels>& texels, bool kept = false) : context_(context), texels_(texels), kept_(kept) {}

    /// Of a state of a lamp's pixels it is the beam of that lamp, which has the latest state that was asked for.
    const Beam& of(const std::shared_ptr<const LampFile>& file);
    /// The beam's grid with its texels, made anew where they are not kept.
    BeamTexture grid_of(const Beam& beam) const;
    /// Of the beam as it is drawn with against its table, relative to the peak.
    double error_of_peak(const LampFile& file) const {
        const auto known = known_.find(file.state_of ? file.state_of.get() : &file);
        return known != known_.end() ? known->second.beam.grid.worst_error_of_peak : made(file.table).worst_error_of_peak;
    }
    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    BeamTexture made(const CandelaTable& table) const { return texels_ ? make_beam_texture(table, *texels_) : make_beam_texture(table); }

    Context& context_;
    std::optional<BeamTexels> texels_;
    bool kept_;
    struct Known {
        std::shared_ptr<const LampFile> file, shown; ///< the second differs where it is a state of the first
        Beam beam;
    };
    void show(const std::shared_ptr<const LampFile>& state, Known& known);

    std::map<const LampFile*, Known> known_;
    std::size_t texture_bytes_ = 0;
};

/// Lamps that shine, in the moment's order; with `all` those that are off too. Throws InputError for more than max_lamps.
std::vector<LitLamp> shining(const Moment& moment, bool all);
inline constexpr std::size_t max_lamps = 8;

/// A world direction in lamp space (x right, y up, z forward).
glm::dvec3 to_lamp_space(const LitLamp& lamp, const glm::dvec3& direction);
/// To it from places relative to `ego_m`.
inline glm::dmat4 lamp_from_ego(const Pose& lamp, const glm::dvec3& ego_m) {
    return view_matrix(-lamp.left(), lamp.up(), lamp.forward(), lamp.position_m - ego_m);
}

} // namespace fernlicht::gl
