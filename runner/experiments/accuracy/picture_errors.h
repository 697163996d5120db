// A renderer's pictures against the reference's: how a drive's moments are compared, and what each pixel shows of the road.
#pragma once

#include "renderer/reference/reference.h"
#include "renderer/renderer.h"
#include "runner/experiments/accuracy/accuracy_result.h"
#include "runner/play/extent_fold.h"
#include "runner/play/stage.h"

#include <deque>
#include <map>
#include <set>

namespace fernlicht {

/// A view of a moment with its reference. `geometry` is drawn by a rasteriser: depth and ids.
struct ReferenceShot {
    View view;
    ReferenceImage reference;
    Frame geometry;
    Image<float> road_m2; ///< of road surface in the pixel; below 0: the pixel shows none
};

/// m2 of road surface that each pixel of a perspective view shows, by the distances between what neighbouring pixels show; 0 where no
/// neighbour shows the same mesh, -1 where it is no road (carriageway with its marks; not verge and terrain). The frame has depth and ids.
Image<float> road_areas_m2(const Scene& scene, const Moment& moment, const View& view, const Frame& frame);

/// With lamps of others that light but are not seen themselves, as the reference has them: a face of thousands of cd/m2 before a dark sky
/// would be most of a mean error.
std::vector<Moment> without_faces(std::vector<Moment> moments);

/// True for meshes of carriageway.
bool is_road(const Scene& scene, std::uint32_t id);

/// The reference's pictures of a drive's moments: from the driver's seat at each size that is compared, and from above for reach.
class ReferencePictures {
  public:
    /// `drive` is the stage's with the extent that is measured. All but `settings` must outlive it.
    ReferencePictures(const Stage& stage, const Drive& drive, Device& device, const std::vector<Moment>& moments,
                      const ReferenceSettings& settings);

    /// False when it was stopped; then the picture is not there.
    bool add_driver(std::size_t moment, const View& view, const StopAsked& stop = {});
    bool add_map(std::size_t moment, const StopAsked& stop = {});

    const std::vector<Moment>& moments() const { return moments_; }
    const ReferenceShot& driver(std::size_t moment, const View& view) const;
    /// The grid with its map view and the reference's lux as its frame; what is measured in it.
    const ExtentDrawing& map(std::size_t moment) const { return maps_.at(moment).first; }
    const std::vector<LaneExtent>& extents(std::size_t moment) const { return maps_.at(moment).second; }
    const ExtentFold& fold() const { return fold_; }
    const ReferenceSettings& settings() const { return settings_; }
    ReferenceCost cost() const;

  private:
    void count(const ReferenceImage& image);

    const Stage& stage_;
    const std::vector<Moment>& moments_;
    ReferenceSettings settings_;
    Reference reference_;
    Renderer geometry_;
    ExtentFold fold_;
    std::map<std::tuple<std::size_t, int, int>, ReferenceShot> shots_;
    std::map<std::size_t, std::pair<ExtentDrawing, std::vector<LaneExtent>>> maps_;
    ReferenceCost cost_;
    std::vector<double> samples_; ///< medians a picture
};

/// Illuminances by the reference in place of a renderer's; `seen` gets each image first.
Draw drawn_by(const Reference& reference, const ReferenceSettings& settings, const std::function<void(const ReferenceImage&)>& seen,
              const StopAsked& stop = {});

/// Adds the pixels that `road_m2` knows with their areas (road_areas_m2), or all pixels without it; of the picture's part in `box`.
void add_pixels(PixelErrorFold& fold, const Image<float>& tested, const Estimate& reference, const Image<float>* road_m2, int picture,
                const PixelBox& box);
void add_pixels(PixelErrorFold& fold, const Image<float>& tested, const Estimate& reference, const Image<float>* road_m2, int picture);

/// Errors of moments together, without times; maps for reach are drawn with `map_scale` times the reference's pixels each way. What the
/// technique does not compute has no errors but a reason.
class ConfigurationErrors {
  public:
    /// `references` must outlive it.
    ConfigurationErrors(const ReferencePictures& references, const Technique& technique, const Configuration& configuration,
                        const View& view, double map_scale);

    /// The moment as `draw` draws it; its references are there.
    void add(std::size_t moment, const Draw& draw);
    /// Of the moments added.
    ConfigurationResult finish() const;

  private:
    const ReferencePictures* references_;
    bool illuminance_, target_, luminance_;
    View view_;
    double map_scale_;
    ConfigurationResult so_far_;
    PixelErrorFold road_, whole_, target_errors_, bright_;
    std::vector<std::size_t> moments_;
    std::vector<std::vector<LaneExtent>> rendered_; ///< by the moments_
};

/// Adds a picture. `edges`: the same view by the pixels' areas, whose marks say where shadows and surfaces end. The frame has illuminance,
/// depth and ids. Pixels that several surfaces share, or whose mesh differs, or without light to speak of, are left out and counted.
class TwinAgreementFold {
  public:
    explicit TwinAgreementFold(double min_lx) : min_lx_(min_lx) {}

    void add(const Moment& moment, const View& view, const Frame& frame, const ReferenceImage& twin, const ReferenceImage& edges,
             int picture);
    TwinAgreement finish() const;

  private:
    double min_lx_;
    PixelErrorFold flat_, of_bound_; ///< of_bound_: error over what gradient and angle error allow
    TwinAgreement counts_;
    std::size_t within_ = 0;
};

} // namespace fernlicht
