// A drive played by the recording of a bus: its signals at every control tick, and how they move the own car.
#pragma once

#include "scenarios/can/bus_signals.h"
#include "scenarios/control/control_loop.h"
#include "scenarios/drives/drive.h"

namespace fernlicht {

/// Speed is linear between the ticks of control, so that the way is its exact integral, as that of a drive's own speed is; or the bus says
/// the way too, which is linear between ticks then. A speed that stays the same makes no new point: a constant one is the same profile as
/// the drive's own.
class BusMotion {
  public:
    /// In order of time, the first at 0 s. `way_m`: always or never.
    void add(double time_s, double speed_mps, std::optional<double> route_distance_m = std::nullopt);

    /// Constant behind the last point.
    double speed_mps(double time_s) const;
    double route_distance_m(double time_s) const;
    std::vector<SpeedPoint> profile() const;

  private:
    struct Point {
        double time_s = 0.0, speed_mps = 0.0, route_distance_m = 0.0;
    };
    std::size_t point_at(double time_s) const;

    std::vector<Point> points_;
    bool way_told_ = false;
};

/// What a bus said over a drive.
struct BusPlay {
    std::vector<CanDatabase> databases; ///< as the mapping names them
    double period_s = 0.0;
    std::vector<std::vector<BusValue>> ticks; ///< by tick of control, in the order of the mapping's inputs
    std::vector<BusRecordOfInput> records;    ///< by input
    std::uint64_t frames = 0, read = 0;       ///< in the recording until the drive's end; of those that an input reads
    std::int64_t start_ns = 0;                ///< the stamp that is the drive's 0 s
    std::optional<double> first_s, last_s;    ///< of the recording's first and last frame, of the drive

    /// What held at that time: of the last tick until then.
    const std::vector<BusValue>& at(double time_s) const;
};

/// Frames of a recording in order of time, stamped from the drive's 0 s, which is `start_ns` in it. Throws InputError for one without
/// frames or without stamps, without a frame of the mapping's channel, and for one no frame of which gives an input a value.
std::vector<CanFrame> read_bus_recording(Drive& drive, const std::filesystem::path& log, std::int64_t& start_ns);

/// The control period of a drive with a bus: all its lamp sets have the same. Throws InputError where they have not.
double bus_period_s(const Drive& drive);

/// Time of a control tick as frames are stamped.
std::int64_t tick_ns(std::uint64_t tick, double period_s);

/// Moves the own car by the signals ego.speed_mps and ego.distance_m of a mapping.
class BusMover {
  public:
    /// Throws InputError for a mapping that moves a car which a storyboard moves, or gives places without speeds or to a vehicle.
    explicit BusMover(const Drive& drive);

    bool moves() const { return speed_.has_value(); }
    /// The speed at the tick; one that is lost is that of the tick before, at first the drive's own. Below 0 the car stands.
    void add(double time_s, const std::vector<BusValue>& values, BusMotion& motion);
    std::vector<std::string> notes() const;

  private:
    const Drive& drive_;
    std::optional<std::size_t> speed_, way_; ///< inputs
    std::optional<double> last_mps_, last_m_;
    std::uint64_t lost_ = 0, backwards_ = 0;
};

/// The drive ends before the moment at which the bumper is beyond the route; looks at moments from `tick` on until then, and moves it on.
void end_with_route(Drive& drive, const Route& route, int& tick, double until_s);

/// Signals of lists (signals.h) that the mapping names: what signal tables of its drive have beside the usual ones.
std::vector<std::string> listed_names(const BusMapping& mapping);

/// Inputs by their places in the signal table of a lamp set's lamps.
class BusWriter {
  public:
    /// Throws InputError with the mapping's place for a lamp that is not there.
    BusWriter(const BusMapping& mapping, const std::vector<std::string>& lamps);

    const std::vector<std::string>& names() const { return names_; } ///< of all signals that are written
    std::vector<WrittenSignal> at(const std::vector<BusValue>& values) const;

  private:
    std::vector<std::string> names_;
    std::vector<std::pair<std::size_t, std::size_t>> places_; ///< input, place in the table
};

/// Reads the recording that the drive's `can` names and takes its signals at each control tick; a speed or a place among them moves the own
/// car from then on, and the drive ends where its route does. Notes what was odd. Nothing for a drive without `can`, for one that is live
/// and for one that is to be played without a recording. Throws InputError for what databases, recording and mapping lack.
void simulate_bus(Drive& drive, const Route& route);

} // namespace fernlicht
