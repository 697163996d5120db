// What the published techniques light with, on the GPU: beam textures, merged beams, spot lights, light maps; each made once.
#pragma once

#include "renderer/gl/device/objects.h"
#include "renderer/light_map.h"
#include "renderer/projected_beam.h"
#include "scenarios/lamps/spots/spot_fit.h"

#include <list>
#include <map>
#include <memory>

namespace fernlicht::gl {

/// E_m at 25 m in lux = texel * lx_a_unit. The outermost texels are black, so that clamping to the edge gives no light outside the window.
struct UploadedBeam {
    TangentWindow window;
    double lx_a_unit = 1.0, peak_lx = 0.0, worst_error_of_peak = 0.0;
    Texture texture;
};

struct UploadedMap {
    LightMapAxis ahead, left, up; ///< up: volumes only
    Texture texture;              ///< lux; the outermost texels are black
};

/// Where the lamps that are on stand on their car and how they shine: what merged beams and light maps are made from.
class LampArrangement {
  public:
    explicit LampArrangement(const Moment& moment);
    /// Within a micrometre and a microradian: moving the car rounds more than nothing.
    bool same_as(const LampArrangement& other) const;

  private:
    std::vector<LitLamp> lamps_; ///< poses in the car's frame
};

class PublishedBeams {
  public:
    PublishedBeams(Context& context, const BeamTexels& texels) : context_(context), texels_(texels) {}

    const UploadedBeam& of(const std::shared_ptr<const LampFile>& file);
    double error_of_peak(const LampFile& file) const;
    const std::vector<Spot>& spots_of(const std::shared_ptr<const LampFile>& file);
    /// Made anew when a lamp moves on its car or changes its level; the last few arrangements are kept.
    const UploadedBeam& merged(const Moment& moment);
    const UploadedMap& ground_map(const Moment& moment);
    const UploadedMap& volume_map(const Moment& moment);
    std::size_t texture_bytes() const { return texture_bytes_; }

  private:
    template <class Made> struct Kept {
        LampArrangement arrangement;
        Made made;
        std::size_t bytes;
    };
    template <class Made, class Make> const Made& kept(std::list<Kept<Made>>& list, const Moment& moment, Make make);
    UploadedBeam upload(const ProjectedBeam& beam);

    Context& context_;
    BeamTexels texels_;
    std::map<std::shared_ptr<const LampFile>, UploadedBeam> beams_;
    std::map<std::shared_ptr<const LampFile>, std::vector<Spot>> spots_;
    std::list<Kept<UploadedBeam>> merged_; ///< used last stands first
    std::list<Kept<UploadedMap>> maps_;
    std::size_t texture_bytes_ = 0;
};

} // namespace fernlicht::gl
