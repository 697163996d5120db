// What `fernlicht aliasing` found: how much of what pictures show is not real, by how they are drawn. The writers only format it.
#pragma once

#include "metrics/aliasing/jaggedness.h"
#include "metrics/aliasing/optical_flow.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "renderer/device.h"
#include "runner/files/described_json.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"
#include "scenarios/drives/play/frame.h"
#include "scenarios/lamps/beam_texels.h"

namespace fernlicht {

/// One way to draw the moments.
struct AliasingConfiguration {
    std::string technique;
    std::optional<BeamTexels> beams;                 ///< nullopt: as fine as the technique takes them, in float
    SurfaceFilter filter = SurfaceFilter::mipmapped; ///< of surface textures
    int samples = 1;                                 ///< a pixel, 1, 4, 9 or 16: drawn so many times as large, averaged in linear light
    std::string varied;                              ///< what differs from the first way of this technique; "" for nothing
    std::string others; ///< pictures that others drew, by name: nothing of the above is known of them; "" for our own
};
std::string filter_name(SurfaceFilter filter);                   ///< "mipmapped", "none", "trilinear"
std::string name_of(const AliasingConfiguration& configuration); ///< "photometric, 512x128x8 beams"

/// Motion that was estimated, and how well it agrees with itself.
struct FollowedByFlow {
    std::size_t started = 0, followed = 0;                 ///< points
    std::size_t flat = 0;                                  ///< of those started, without contrast
    double median_motion_px = 0.0, median_return_px = 0.0; ///< from frame to frame; how far from the start going there and back ends
};

/// One sentence, without its full stop.
std::string motion_text(const FollowedByFlow& flow);

struct AliasingRow {
    AliasingConfiguration configuration;
    std::string why_not;                          ///< why nothing was measured; "" where it was
    std::string no_spatial;                       ///< why nothing was measured over space; "" where it was
    SpatialAliasing spatial;                      ///< numbers: r.m.s. over the moments; pictures: of the one shown
    std::optional<EdgeJaggedness> cut_off, marks; ///< of the moment shown
    std::string no_cut_off, no_marks;             ///< why there is none
    std::optional<TemporalAliasing> temporal;
    std::string no_temporal;               ///< why there is none
    std::optional<FollowedByFlow> by_flow; ///< nullopt: motion is known
    Image<float> picture, ideal;           ///< of the moment shown, cd/m2
};

/// Optical flow held against the motion that is known, on the first row's pictures.
struct FlowComparison {
    std::string pictures; ///< what it was given: "as drawn", "what the display could show"
    FlowMethod method = FlowMethod::dis;
    FlowError error;                          ///< of each frame to the next
    std::optional<TemporalAliasing> temporal; ///< along its paths
    std::optional<TemporalAliasing> known;    ///< of aliasing along the known paths of the same points, as far as those are known
    /// From the frame shown to the next, length in pixels; below 0: not known, or left out by the estimate. Of the first comparison alone.
    Image<float> known_px, estimated_px, off_px;
};
std::string method_name(FlowMethod method); ///< "dense inverse search", "Farneback"

struct AliasingResult : Findings {
    std::string drive, title, lamp_set;
    View view;
    double rate_hz = 0.0;
    std::vector<std::pair<int, double>> moments; ///< frame, time_s
    std::size_t shown = 0;                       ///< of `moments`
    int supersample = 4;
    bool displayed = false;         ///< luminance of the tone-mapped picture on a display whose white has display_white_cdm2
    double pixels_per_degree = 0.0; ///< at the middle of the view
    double level_lx = 0.0;          ///< of the line whose jaggedness is measured
    std::vector<AliasingRow> rows;
    std::vector<FlowComparison> flows; ///< empty where not asked for
    std::vector<std::string> notes;    ///< what is not known of frames of others, one sentence each
};

/// White of the reference display of sRGB (IEC 61966-2-1).
inline constexpr double display_white_cdm2 = 80.0;
/// Luminance of a pixel on it, cd/m2.
float displayed_cdm2(const Rgb8& pixel);

/// docs/aliasing.md tells how to read it.
Document document(const AliasingResult& result);
JsonMembers aliasing_members(AliasingResult& result); ///< of its JSON; pictures do not come back
std::string aliasing_csv(const AliasingResult& result);
bool measured_over_space(const AliasingRow& row);
/// Rows measured over space, by what an eye sees of them, least first.
std::vector<std::size_t> ranked(const AliasingResult& result);
/// The picture, its aliasing in false colours, and where it is worst of all rows enlarged beside what should be there.
plots::Drawing aliasing_sheet(const AliasingResult& result, const AliasingRow& row);
/// Ways to draw, least aliasing first, each at the places where one of them differs most; nullopt for fewer than two.
std::optional<plots::Drawing> ranking_sheet(const AliasingResult& result);
/// Motion that is known, as estimated, and how far that is off; nullopt where it was not asked for.
std::optional<plots::Drawing> flow_sheet(const AliasingResult& result);
plots::Figure spatial_plot(const AliasingResult& result);
/// nullopt where nothing was measured over time.
std::optional<plots::Figure> temporal_plot(const AliasingResult& result);

} // namespace fernlicht
