// The cross-section of a road between two stations: strips of one material each, side by side, without gap or overlap.
// Painted stripes of a lane's edge: which are there at s, where their dashes begin and end.
#pragma once

#include "scenarios/roads/mesh/mesh_materials.h"

#include <vector>

namespace fernlicht {

/// One painted line beside a lane's outer edge, on a stretch of road.
struct Stripe {
    double from_s_m = 0.0, to_s_m = 0.0; ///< along the road
    double t_m = 0.0;                    ///< of its middle from the lane's edge, left positive
    double width_m = 0.0;
    double first_dash_m = 0.0; ///< s of the first dash
    double dash_m = 0.0;
    double period_m = 0.0; ///< dash and gap; 0: solid
    RoadMaterial material = RoadMaterial::marking_white;

    bool painted_at(double s_m) const;
    /// s of each dash's start and end within the stripe.
    void append_ends(std::vector<double>& stations) const;
};

/// Heights are above the road's plane (OpenDRIVE lane height), t left positive; right_t <= left_t.
struct Strip {
    double right_t_m = 0.0, left_t_m = 0.0;
    double right_h_m = 0.0, left_h_m = 0.0;
    RoadMaterial material = RoadMaterial::asphalt;
    bool kerb_face = false; ///< vertical: both t are equal, the heights differ
    bool paved = false;     ///< driving lanes and what vehicles may use beside them

    double height_at(double t_m) const;
};

/// A lane section with its marks placed: ready to be cut anywhere.
class SectionProfile {
  public:
    SectionProfile(const Road& road, const LaneSection& section, bool wheel_tracks = false);

    const LaneSection& section() const { return *section_; }
    bool has_heights() const { return has_heights_; }
    /// From right to left at s. Which strips there are is decided by `layout_s_m` (inside the stretch between two stations), so
    /// that both ends of a stretch have the same strips, of no width where a lane tapers out.
    std::vector<Strip> strips(double layout_s_m, double s_m) const;
    /// Every s at which the strips change in number or kind, or a width or height has a knot. Unsorted.
    void append_stations(std::vector<double>& stations) const;
    double rightmost_t(double s_m) const;

  private:
    struct Edge { ///< between two lanes, or outside the last: from right to left, one more than there are lanes with width
        const Lane* right = nullptr;
        const Lane* left = nullptr;
        std::vector<Stripe> stripes;
        bool only_right = false, only_left = false; ///< paint must stay on that side
        double shift_m = 0.0;                       ///< moves all stripes, left positive
    };
    static void keep_on_one_side(Edge& edge, const Lane* owner);
    struct Span {
        double right_t_m, left_t_m;
    };
    Span span(const Lane& lane, double s_m) const;
    Strip whole_lane(const Lane& lane, double s_m) const;
    /// Where the painted stripes of `edge` lie, cut to half of the lanes on both sides; right to left.
    struct Paint {
        double right_t_m, left_t_m;
        RoadMaterial material;
        bool reaches_right, reaches_left; ///< of the edge
    };
    std::vector<Paint> paint(const Edge& edge, double layout_s_m, double s_m) const;
    void append_lane(std::vector<Strip>& out, const Lane& lane, const std::vector<Paint>& right, const std::vector<Paint>& left,
                     double s_m) const;

    const Road* road_;
    const LaneSection* section_;
    std::vector<Edge> edges_;
    bool has_heights_ = false, wheel_tracks_ = false;
};

} // namespace fernlicht
