// The figures of our own lamps. Chosen by hand so that the sampled tables meet their regulation rows with the margins of production lamps
// and have the flux and the maxima of common ones; tests/scenarios/lamps/lamp_model_test.cpp holds them to that.
#include "scenarios/lamps/lamp_model.h"

namespace fernlicht {
namespace {

constexpr double tan_15_deg = 0.2679491924311227;

LampModel halogen_low() {
    return {.name = "halogen-low",
            .title = "halogen low beam (model)",
            .meets = "UN R112 class B passing beam rows, right-hand traffic",
            .parts =
                {{.peak_cd = 15000,
                  .h_deg = 1.6,
                  .left_deg = 2.4,
                  .right_deg = 2.6,
                  .depth_deg = 0.65,
                  .above_deg = 0.9,
                  .below_deg = 0.7,
                  .follows_rise = 1.0},
                 {.peak_cd = 8000,
                  .h_deg = 0.6,
                  .left_deg = 6.5,
                  .right_deg = 7.0,
                  .depth_deg = 0.9,
                  .above_deg = 1.2,
                  .below_deg = 1.1,
                  .follows_rise = 0.5},
                 {.peak_cd = 2600, .h_deg = 0.0, .left_deg = 16.0, .right_deg = 17.0, .depth_deg = 1.8, .above_deg = 1.8, .below_deg = 2.4},
                 {.peak_cd = 900, .h_deg = 0.0, .left_deg = 20.0, .right_deg = 21.0, .depth_deg = 6.0, .above_deg = 3.0, .below_deg = 4.5}},
            .cut_off = CutOff{.level_deg = -0.57,
                              .rise_slope = tan_15_deg,
                              .rise_ends_h_deg = 7.0,
                              .top_deg = 1.0,
                              .softness_deg = 0.16,
                              .glow_cd = 270.0,
                              .glow_h_deg = 13.0,
                              .glow_v_deg = 3.5}};
}

LampModel xenon_low() {
    return {
        .name = "xenon-low",
        .title = "xenon low beam (model)",
        .meets = "UN R98 (R149 00 series class D) passing beam rows, right-hand traffic",
        .parts =
            {{.peak_cd = 27000,
              .h_deg = 2.2,
              .left_deg = 1.8,
              .right_deg = 2.8,
              .depth_deg = 0.6,
              .above_deg = 0.9,
              .below_deg = 0.75,
              .follows_rise = 1.0},
             {.peak_cd = 11500,
              .h_deg = 1.2,
              .left_deg = 7.0,
              .right_deg = 8.0,
              .depth_deg = 0.9,
              .above_deg = 1.2,
              .below_deg = 1.1,
              .follows_rise = 0.5},
             {.peak_cd = 5800, .h_deg = 0.0, .left_deg = 20.0, .right_deg = 21.0, .depth_deg = 1.8, .above_deg = 1.8, .below_deg = 2.4},
             {.peak_cd = 1700, .h_deg = 0.0, .left_deg = 24.0, .right_deg = 25.0, .depth_deg = 6.0, .above_deg = 3.0, .below_deg = 4.5}},
        .cut_off = CutOff{.level_deg = -0.57,
                          .rise_slope = tan_15_deg,
                          .rise_ends_h_deg = 7.0,
                          .top_deg = 1.05,
                          .softness_deg = 0.125,
                          .glow_cd = 270.0,
                          .glow_h_deg = 14.0,
                          .glow_v_deg = 3.5}};
}

LampModel halogen_high() {
    return {.name = "halogen-high",
            .title = "halogen high beam (model)",
            .meets = "UN R112 class B driving beam rows",
            .parts = {{.peak_cd = 38000, .left_deg = 2.3, .right_deg = 2.3, .above_deg = 1.1, .below_deg = 1.2},
                      {.peak_cd = 11000, .left_deg = 5.0, .right_deg = 5.0, .depth_deg = 0.2, .above_deg = 1.5, .below_deg = 1.8},
                      {.peak_cd = 2200, .left_deg = 14.0, .right_deg = 14.0, .depth_deg = 1.2, .above_deg = 2.6, .below_deg = 3.2},
                      {.peak_cd = 500, .left_deg = 18.0, .right_deg = 18.0, .depth_deg = 5.0, .above_deg = 4.0, .below_deg = 4.5}},
            .cut_off = std::nullopt};
}

LampModel xenon_high() {
    return {.name = "xenon-high",
            .title = "xenon high beam (model)",
            .meets = "UN R98 (R149 00 series class D) driving beam rows",
            .parts = {{.peak_cd = 68000, .left_deg = 2.4, .right_deg = 2.4, .above_deg = 1.1, .below_deg = 1.2},
                      {.peak_cd = 19000, .left_deg = 5.0, .right_deg = 5.0, .depth_deg = 0.2, .above_deg = 1.6, .below_deg = 1.9},
                      {.peak_cd = 3500, .left_deg = 17.0, .right_deg = 17.0, .depth_deg = 1.2, .above_deg = 2.6, .below_deg = 3.2},
                      {.peak_cd = 800, .left_deg = 22.0, .right_deg = 22.0, .depth_deg = 5.0, .above_deg = 4.0, .below_deg = 4.5}},
            .cut_off = std::nullopt};
}

} // namespace

const std::vector<LampModel>& lamp_models() {
    static const std::vector<LampModel> models{halogen_low(), halogen_high(), xenon_low(), xenon_high()};
    return models;
}

} // namespace fernlicht
