// How much of a picture is wrongly lit or wrongly dark: shadows as drawn against shadows as they are.
// Where shadows end: positions of edges along a cross-section, drawn against true, and how they move from step to step.
// Spots that are wrong where there is no doubt: shadow acne and light leaks.
#pragma once

#include "scenarios/values/image.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace fernlicht {

/// Illuminance of the same places, lx, all of one size. Not finite or not above the floor without shadows: the pixel does not count.
struct ShadowImages {
    Image<float> drawn_lx, true_lx;
    Image<float> unshadowed_lx;       ///< the truth without anything in the light's way
    Image<float> drawn_unshadowed_lx; ///< as drawn without shadows, so that what is wrong with the light is no shadow's error; empty:
                                      ///< unshadowed_lx
    Image<std::uint8_t> counts;       ///< 0: the pixel does not count (it shows different things in both); empty: all count
};

/// Below this illuminance without shadows a pixel's shadow does not count: on asphalt some 3e-5 cd/m2, what an eye adapted to the dark
/// hardly sees.
inline constexpr double shadow_floor_lx = 0.001;

/// 1 - E / E_unshadowed within 0..1, as drawn and as it is; nullopt where the pixel does not count.
struct ShadowDegrees {
    double drawn = 0.0, truth = 0.0;
};
std::optional<ShadowDegrees> shadow_degrees(const ShadowImages& images, int x, int y, double floor_lx = shadow_floor_lx);

/// Areas in the unit of the weights: m2, or pixels. A pixel that is half as dark as it should be counts half.
struct ShadowArea {
    double counted = 0.0, shadowed = 0.0; ///< lit without shadows; of it truly in shadow
    double wrongly_lit = 0.0, wrongly_dark = 0.0;

    double wrong() const { return wrongly_lit + wrongly_dark; }
    /// Of what is lit without shadows; 0 of nothing.
    double wrong_share() const { return counted > 0.0 ? wrong() / counted : 0.0; }
    double wrongly_lit_share() const { return counted > 0.0 ? wrongly_lit / counted : 0.0; }
    double wrongly_dark_share() const { return counted > 0.0 ? wrongly_dark / counted : 0.0; }

    ShadowArea& operator+=(const ShadowArea& other);
    bool operator==(const ShadowArea&) const = default;
};

/// `pixel_area`: of each pixel, all the same. Throws std::invalid_argument for images of different sizes and a floor or area not above 0.
ShadowArea shadow_area(const ShadowImages& images, double pixel_area = 1.0, double floor_lx = shadow_floor_lx);
/// Each pixel with an area of its own; what is not above 0 does not count.
ShadowArea shadow_area(const ShadowImages& images, const Image<float>& areas, double floor_lx = shadow_floor_lx);

/// True degree minus drawn degree: above 0 wrongly lit, below 0 wrongly dark; 0 where the pixel does not count.
Image<float> shadow_differences(const ShadowImages& images, double floor_lx = shadow_floor_lx);

/// Throws std::invalid_argument where the images are not all of one size.
void check_sizes(const ShadowImages& images);

struct ShadowEdge {
    double at_m = 0.0;
    int direction = 0; ///< +1: into the light, along the section; -1: into the shadow

    bool operator==(const ShadowEdge&) const = default;
};

/// Where lit_share = E / E_unshadowed crosses 50 %, straight between samples `pitch_m` apart, the first at 0. Where a sample is nullopt
/// nothing is known, and there is no edge to either side.
std::vector<ShadowEdge> shadow_edges(const std::vector<std::optional<double>>& lit_shares, double pitch_m);

struct MatchedEdge {
    ShadowEdge truth;
    double error_m = 0.0; ///< drawn minus true
};
struct EdgeMatch {
    std::vector<MatchedEdge> matched; ///< along the section
    std::size_t lost = 0;             ///< true ones that are not drawn
    std::size_t invented = 0;         ///< drawn ones that are not there
    std::size_t true_edges() const { return matched.size() + lost; }
};

/// Farther from where it should be than this, an edge is another one.
inline constexpr double same_edge_m = 1.0;

/// Edges of the same direction in the same order, so that the sum of distances is least, with an edge that finds no partner as dear as half
/// of `same_m`: two farther apart than that are not matched.
EdgeMatch match_edges(const std::vector<ShadowEdge>& truth, const std::vector<ShadowEdge>& drawn, double same_m = same_edge_m);

/// The same along a row of pixels, left to right.
EdgeMatch section_edges(const ShadowImages& images, int row, double pitch_m, double floor_lx = shadow_floor_lx);

/// r.m.s. and largest |error|, cm, of all matched edges; nullopt for none.
struct EdgeError {
    std::size_t edges = 0, lost = 0, invented = 0;
    std::optional<double> rms_cm, worst_cm;
};
EdgeError edge_error(const std::vector<EdgeMatch>& sections);

/// Standard deviation (n - 1) of the change of an edge's error from one step to the next, cm, over all edges and pairs of steps; 0 where
/// all errors stay as they are. Steps are compared where both have the same true edges, by number and direction, and of them those drawn in
/// both. nullopt for fewer than two changes.
std::optional<double> shadow_crawl_cm(const std::vector<EdgeMatch>& steps);

struct ShadowSpots {
    std::size_t acne = 0, acne_px = 0;   ///< connected spots drawn dark in the light, and their pixels
    std::size_t leaks = 0, leaks_px = 0; ///< drawn lit in the shadow
    std::size_t sure_px = 0;             ///< pixels beyond doubt

    ShadowSpots& operator+=(const ShadowSpots& other);
    bool operator==(const ShadowSpots&) const = default;
};

/// Beyond doubt is a pixel that counts, truly lit or shadowed by at least 90 %, whose neighbours within `doubt_px` (Chebyshev's distance: a
/// square) all count and are so by the same; it is wrong where it is drawn on the other side of 50 %. Connected are wrong pixels of one
/// kind that touch by edge or corner. Throws std::invalid_argument for images of different sizes and doubt_px < 0.
ShadowSpots shadow_spots(const ShadowImages& images, int doubt_px, double floor_lx = shadow_floor_lx);

} // namespace fernlicht
