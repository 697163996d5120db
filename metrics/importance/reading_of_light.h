// A reading as a function of the light at places, and so of the lamps' candela tables: its value by the twin and its gradient.
//
// In a moment: an illuminance is sum of I f / d^2 itself; a reach or a width is where the light along a line passes the threshold
// (lit_line.h); light between samples runs as it does in measurements. Over the drive: a quantile takes the moments next to it with their
// weights, an extreme its moment, a figure at a distance the moments on both sides. All of it by the chain rule, in one pass, in double.
// Aim, control and whatever else may follow from a table stay as they are.
#pragma once

#include "metrics/importance/moment_figure.h"
#include "metrics/readings/readings.h"
#include "metrics/road/lit_line.h"
#include "scenarios/drives/drive.h"
#include "scenarios/light/light_gradient.h"
#include "scenarios/roads/route.h"

#include <functional>

namespace fernlicht {

/// What readings there are importances of, for people.
inline constexpr const char* importance_readings =
    "reach_*_m, width_*_m and area_*_m2 of a lane on road or target, sensor_*_reach_*_m, sensor_*_lx, glare_NAME_facing_*_lx, "
    "glare_NAME_eye_*_lx, glare_NAME_veiling_*_cdm2, glare_NAME_threshold_increment_*_percent and glare_NAME_de_boer_* of an oncoming "
    "driver, kerb_*_lx, mirror_*_lx, detection_*_m, visibility_level_*, "
    "gradient_*, foreground_* and uniformity_*";

/// Light at a place in a moment, and the most that it may be.
struct LimitedLight {
    std::size_t moment = 0;
    LightPlace place;
    double limit_lx = 1.0; ///< > 0
};

class ReadingOfLight {
  public:
    /// Of the twin, over these moments, which are the drive's in their order. Route outlives it. Throws InputError naming the flag that
    /// asks for a reading that is none of importance_readings, or of what the drive does not ask for. `lamp_set`: what a dazzled driver's
    /// own car has, too; nullptr: the drive's first.
    ReadingOfLight(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments,
                   std::string asked_by = "--reading", const LampSet* lamp_set = nullptr);

    /// The smallest share of a limit that is left, per cent; negative above one. At least one light.
    explicit ReadingOfLight(const std::vector<LimitedLight>& lights);

    ReadingOfLight(const ReadingOfLight&) = delete;
    ReadingOfLight& operator=(const ReadingOfLight&) = delete;

    /// One moment's part in the reading.
    struct Decider {
        std::size_t moment = 0; ///< among those given
        double share = 0.0;     ///< d reading / d figure of the moment
        Value figure;           ///< of the moment: as the reading; of a distance to a sensor the illuminance
    };

    /// With the moments' lamps as they are now: the same moments, perhaps with other tables.
    Value value(const std::vector<Moment>& moments) const;
    struct Found {
        Value value;
        std::vector<Decider> deciders; ///< by moment; none where the value is not a number
        BeamGradient gradient;         ///< of the reading; without its lamps where nothing decides it
    };
    Found gradient(const std::vector<Moment>& moments) const;
    /// What it takes for the reading to be at least, else at most, some bound: that each of these figures is. Of a quantile they are those
    /// of the moments on that side of it, as they stand now; of everything else it is the reading itself. Moments without a figure are
    /// left out.
    void each_side_figure(const std::vector<Moment>& moments, bool at_least,
                          const std::function<void(double figure, const BeamGradient& gradient)>& take) const;
    /// Of the mean over the moments whose figure is a number, in place of the reading: what each of them turns on. Nothing of an approach,
    /// whose moments are at all distances.
    BeamGradient mean_gradient(const std::vector<Moment>& moments) const;

  private:
    /// Light at a place between up to four points: two across, and the same a row farther on.
    struct Sample {
        double at_m = 0.0;
        bool there = true;
        std::vector<LightPlace> places = {}; ///< near right, near left, far right, far left, as far as they count
        double across = 0.0, along = 0.0;    ///< share of the way; 0: the first is all
        double column_lx(const Moment& moment, std::size_t side) const;
        double lx(const Moment& moment) const;
        void add_gradient(BeamGradient& gradient, const Moment& moment, double per_lx) const;
    };
    /// What a moment's figure follows from.
    struct InMoment {
        std::size_t moment = 0;
        double to_go_m = 0.0;
        std::vector<Sample> samples = {}; ///< of a line, or one place
        bool may_go_on = false;           ///< a line that ends lit says "at least", where it reaches so far:
        double whole_m = 0.0;             ///< a reach that is cut off nearer is no figure
        MomentFigurePointer of = {};      ///< in place of samples: all that is neither light at a place nor a line's
    };
    struct OverMoments {
        Value value;
        ValueShares shares; ///< by index into `figures`
    };
    using Fold = std::function<OverMoments(const std::vector<Value>& figures)>;

    [[noreturn]] void refuse(const ReadingKey& key, const std::string& expected) const;
    double share_of_statistic(const ReadingKey& key) const;
    void add_lines(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    /// One for each moment that has a figure.
    void add_figures(const std::vector<Moment>& moments, const std::function<MomentFigurePointer(const Moment&)>& figure_of);
    void add_area(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void add_evenness(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void add_sight(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void add_place(std::size_t moment, double to_go_m, LightPlace place);
    void add_sensor(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void add_eye(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments,
                 const LampSet& lamp_set);
    void add_kerb(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void add_mirror(const ReadingKey& key, const Drive& drive, const Route& route, const std::vector<Moment>& moments);
    void take_quantile(double share, const std::string& why_none = "not there in any moment");
    void take_median(bool everywhere, const std::string& why_not);
    Approach approach(const std::vector<Value>& figures) const;
    std::vector<LineSample> line(const InMoment& part, const Moment& moment) const;
    Value figure(const InMoment& part, const Moment& moment) const;
    std::vector<Value> figures(const std::vector<Moment>& moments) const;
    void add_gradient_of(BeamGradient& gradient, const InMoment& part, const Moment& moment, double weight) const;

    Quantity quantity_;
    std::string asked_by_;
    double threshold_lx_ = 0.0; ///< of reach and width
    std::vector<InMoment> parts_;
    std::optional<double> quantile_; ///< of the figures of parts that count, from 0 to 1; nullopt: it is none
    double counted_from_m_ = 0.0, counted_to_m_ = std::numeric_limits<double>::infinity(); ///< left to go
    bool passed_ = false;
    Fold over_moments_;
};

} // namespace fernlicht
