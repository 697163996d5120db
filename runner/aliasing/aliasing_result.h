// What `fernlicht aliasing` found: how much of what pictures show is not there, by how they are drawn. The writers only format it.
#pragma once

#include "metrics/aliasing/jaggedness.h"
#include "metrics/aliasing/spatial_aliasing.h"
#include "metrics/aliasing/temporal_aliasing.h"
#include "renderer/surface_filter.h"
#include "runner/report/report.h"
#include "scenarios/lamps/beam_texels.h"

namespace fernlicht {

/// One way to draw the moments.
struct AliasingConfiguration {
    std::string technique;
    std::optional<BeamTexels> beams;                 ///< nullopt: as fine as the technique takes them, in float
    SurfaceFilter filter = SurfaceFilter::mipmapped; ///< of surface textures
    int samples = 1;                                 ///< a pixel, 1, 4, 9 or 16: drawn so many times as large, averaged in linear light
    std::string varied;                              ///< what differs from the first way of this technique; "" for nothing
};
std::string filter_name(SurfaceFilter filter);                   ///< "mipmapped", "none", "trilinear"
std::string name_of(const AliasingConfiguration& configuration); ///< "photometric, 512x128x8 beams"

struct AliasingRow {
    AliasingConfiguration configuration;
    std::string why_not;                  ///< why nothing was measured; "" where it was
    SpatialAliasing spatial;              ///< numbers: r.m.s. over the moments; pictures: of the one shown
    std::optional<Jaggedness> jaggedness; ///< of the moment shown
    std::string no_jaggedness;            ///< why there is none
    std::optional<TemporalAliasing> temporal;
    std::string no_temporal;     ///< why there is none
    Image<float> picture, ideal; ///< of the moment shown, cd/m2
};

struct AliasingResult {
    RunContext context;
    std::string drive, title, variant;
    View view;
    double rate_hz = 0.0;
    std::vector<std::pair<int, double>> moments; ///< frame, time_s
    std::size_t shown = 0;                       ///< of `moments`
    int supersample = 4;
    bool displayed = false;         ///< luminance of the tone-mapped picture on a display whose white has display_white_cdm2
    double pixels_per_degree = 0.0; ///< at the middle of the view
    double level_lx = 0.0;          ///< of the line whose jaggedness is measured
    std::vector<AliasingRow> rows;
    std::string interrupted; ///< "" where all was measured
};

/// White of the reference display of sRGB (IEC 61966-2-1).
inline constexpr double display_white_cdm2 = 80.0;

std::string aliasing_text(const AliasingResult& result);
std::string aliasing_json(const AliasingResult& result);
std::string aliasing_csv(const AliasingResult& result);
std::string aliasing_html(const AliasingResult& result);
/// Rows by what an eye sees of them, least first.
std::vector<std::size_t> ranked(const AliasingResult& result);
/// The picture, its aliasing in false colours, and where it is worst of all rows enlarged beside what should be there.
std::string aliasing_sheet_svg(const AliasingResult& result, const AliasingRow& row);
std::string spatial_plot_svg(const AliasingResult& result);
/// "" where nothing was measured over time.
std::string temporal_plot_svg(const AliasingResult& result);
/// aliasing.json, aliasing.csv, aliasing.html and every picture as SVG and PNG. Throws DeviceError.
void write_aliasing(const AliasingResult& result, const std::filesystem::path& folder);

} // namespace fernlicht
