// What the lamps do to the eyes of others over a drive: an oncoming driver who stands still, and a driver ahead through the mirrors. From
// the lamps' tables in double. A crest of the road between lamp and eye hides the lamp; nothing else does.
// Glare through the mirrors of a car ahead in the own lane, at fixed gaps: what this car's driver has from a follower with the same lamps.
// Glare from other road users in the own driver's eyes, folded over the drive.
#pragma once

#include "metrics/folds/seeing_series.h"
#include "metrics/glare/glare.h"
#include "metrics/readings/readings.h"
#include "metrics/road/lit_line.h"

namespace fernlicht {

/// What a set of sources does to one eye.
struct GlareFigures {
    double facing_lx = 0.0; ///< sum of I / d^2
    double eye_lx = 0.0;    ///< across the line of sight
    Value veiling_cdm2, increment_percent, de_boer;
};
GlareFigures glare_figures(const std::vector<GlareSource>& sources, double facing_lx, const GlareParameters& parameters);

/// Figures of one eye over the moments.
struct GlareFollowed {
    std::vector<int> ticks;
    Approach facing, eye_lx, veiling, increment, de_boer;
    std::vector<std::vector<double>> theta_deg;       ///< by lamp
    std::string no_veiling, no_increment, no_de_boer; ///< why it was not measured in some moment; "" where it was in all

    void add(const Moment& moment, double to_go_m, const std::vector<GlareSource>& sources, const GlareFigures& figures);
    /// Figures over the drive, under the eye's key: largest illuminances, veiling luminance and threshold increment, smallest rating; times
    /// and metres beyond the limits.
    void say(Readings& readings, const ReadingKey& eye, const std::string& where, const std::string& why_none,
             const GlareParameters& parameters) const;
    SeeingSeries series(const ReadingKey& eye, const std::string& title, const std::string& over,
                        const std::vector<std::string>& lamps) const;
};

class OncomingFold {
  public:
    /// The drive must ask for glare. Drive and route must outlive the fold.
    OncomingFold(const Drive& drive, const Route& route);
    void add(const Moment& moment);
    Readings readings() const;
    std::vector<SeeingSeries> series() const;

  private:
    struct Eye {
        std::optional<glm::dvec3> place_m; ///< nullopt: there is no oncoming lane
        glm::dvec3 gaze{0.0};
        GlareFollowed followed;
        bool passed = false; ///< some moment is beyond it
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Eye> eyes_;
    std::vector<std::string> lamps_;
};

class MirrorFold {
  public:
    /// The drive must ask for glare in mirrors. Drive and route must outlive the fold.
    MirrorFold(const Drive& drive, const Route& route);
    void add(const Moment& moment);
    /// Per gap of 15 m: mirror_NAME_at_15m_lx and _max_lx, median and largest illuminance on the mirror facing the lamps; and of the eye,
    /// through all mirrors together, glare_mirrors_15m_... as of an oncoming driver.
    Readings readings() const;
    /// Over the distance along the route.
    std::vector<SeeingSeries> series() const;

  private:
    struct Gap {
        std::vector<std::vector<double>> mirror_lx; ///< by mirror
        GlareFollowed eye;
    };
    const Drive& drive_;
    const Route& route_;
    std::vector<Gap> gaps_;
    std::vector<std::string> sources_; ///< "left_in_inside": each lamp in each mirror
};

class TrafficFold {
  public:
    /// The drive must ask for glare and have traffic. It must outlive the fold.
    explicit TrafficFold(const Drive& drive);
    void add(const Moment& moment);
    /// glare_own_...: of the driver's eye, where the first view that is no map has it, looking along the car; as of an oncoming driver.
    Readings readings() const;

  private:
    const Drive& drive_;
    std::vector<BodyBox> boxes_;
    GlareFollowed eye_;
};

} // namespace fernlicht
