#include "scenarios/vehicle/car_validity.h"

#include "scenarios/values/pose.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace fernlicht {
namespace {

/// One axle's times in the air.
struct Hops {
    const char* axle;
    bool in_the_air = false;
    double since_s = 0.0;

    void look(double load_n, double time_s, CarValidity& validity) {
        if (load_n > 0.0) {
            in_the_air = false;
            return;
        }
        if (!in_the_air) {
            ++validity.hops;
            since_s = time_s;
        }
        in_the_air = true;
        const double hop_s = time_s - since_s;
        if (hop_s > longest_hop_s)
            validity.beyond = {
                fmt::format("the {} wheels are off the road for more than {:g} s from {:.3g} s on", axle, longest_hop_s, since_s),
                "a car that keeps its wheels on the road (a lower centre_of_gravity_height_m, milder braking and "
                "accelerating, lower road_steps)"};
        else
            validity.longest_hop_s = std::max(validity.longest_hop_s, hop_s);
    }
};

void look_at_pitch(double pitch_rad, double time_s, CarValidity& validity) {
    if (std::abs(pitch_rad) > greatest_pitch_rad)
        validity.beyond = {fmt::format("the body is pitched by {:.3g} degrees against the road at {:.3g} s", degrees(pitch_rad), time_s),
                           fmt::format("at most {:.2g} degrees, up to which the equations' small angles hold (a lower "
                                       "centre_of_gravity_height_m, stiffer springs, milder braking and accelerating, lower road_steps)",
                                       degrees(greatest_pitch_rad))};
}

} // namespace

double deflection_at_rest_m(const VehicleParameters& car, const AxleParameters& axle, double part_of_load) {
    return gravity_mps2 * (car.mass_kg * part_of_load - axle.unsprung_mass_kg) / axle.spring_n_per_m;
}

CarValidity car_validity(const CarRun& run, double end_s) {
    CarValidity validity;
    Hops front{"front"}, rear{"rear"};
    double start_s = run.path().start_s();
    for (std::size_t step = 0; step < run.path().steps() && start_s < end_s; ++step) {
        const double step_end_s = run.path().step_end_s(step);
        for (std::size_t node = step == 0 ? 0 : 1; node < DensePath::nodes; ++node) {
            const double time_s = start_s + (step_end_s - start_s) * static_cast<double>(node) / (DensePath::nodes - 1);
            if (time_s > end_s)
                break;
            const CarPlace place = run.at(time_s);
            look_at_pitch(place.pitch_rad, time_s, validity);
            front.look(place.front_load_n, time_s, validity);
            rear.look(place.rear_load_n, time_s, validity);
            if (validity.beyond)
                return validity;
        }
        start_s = step_end_s;
    }
    return validity;
}

} // namespace fernlicht
