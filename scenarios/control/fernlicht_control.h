/* Lamp control laws of your own: the interface between fernlicht and a shared library that a drive names under control.plugins.
 *
 * C99 and C++. Copy this one file. A library exports one function, fernlicht_control_plugin(), which returns what it is and can do.
 * docs/control.md tells how to build and name a library. Everything that a law is handed belongs to fernlicht and holds during the call.
 *
 * Conventions: SI, radians, the car's frame: on the road under the rear axle, x forward, y left, z up. Angles: left and up positive.
 * Windows of a lamp in segments are in degrees of the goniometer, right positive. A value that is not a number says that a signal is lost;
 * infinity is a distance to nothing.
 *
 * Compatibility: structs only grow at their ends, and `size` says how far whoever filled it knows it. FERNLICHT_CONTROL_VERSION changes
 * when that would not do. */
#ifndef FERNLICHT_CONTROL_H
#define FERNLICHT_CONTROL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FERNLICHT_CONTROL_VERSION 1

typedef struct fernlicht_ego {
    double distance_m;        /* of the rear axle along the route */
    double speed_mps;         /* below 0: backwards */
    double acceleration_mps2; /* along the car */
    double yaw_rate_rad_s, steering_rad;
    double pitch_rad; /* of the body as its springs show it, load included; nose up positive */
} fernlicht_ego;

/* Of the own lane's centre, every 5 m from the car to 200 m ahead. */
typedef struct fernlicht_road_point {
    double along_m;         /* from the rear axle along the lane */
    double x_m, y_m;        /* in the car's frame */
    double curvature_per_m; /* left bends positive */
} fernlicht_road_point;

typedef struct fernlicht_other {
    double x_m, y_m;    /* of the middle of its nearer end, in the car's frame */
    double heading_rad; /* against the own car's: 0 the same way, pi towards it */
    double speed_mps, width_m, height_m;
    int lamps_on;
} fernlicht_other;

typedef struct fernlicht_lamp {
    const char* name;
    double x_m, y_m, z_m;           /* in the car's frame */
    double aim_rad;                 /* yaw without swivel */
    double swivel_rad, pitch_rad;   /* where its actuators are now */
    int may_move;                   /* 0: the drive does not let this library move it */
    size_t segment_count;           /* 0: not in segments */
    const double* segment_from_deg; /* segment_count edges of windows */
    const double* segment_to_deg;
} fernlicht_lamp;

typedef struct fernlicht_control_input {
    size_t size; /* sizeof(fernlicht_control_input) */
    double time_s;
    double dt_s; /* since the last call; 0 at the first */
    fernlicht_ego ego;
    double illuminance_lx; /* horizontal, of the sky and street lamps */
    double wetness;        /* 0 to 1 */
    size_t road_count, other_count, lamp_count, signal_count;
    const fernlicht_road_point* road;
    const fernlicht_other* others;
    const fernlicht_lamp* lamps;
    const char* const* signal_names; /* as `fernlicht signals` lists them */
    const double* signal_values;
} fernlicht_control_input;

/* One per lamp, filled with what the laws before decided; change what you mean to. Lamps that may not be moved are not read back. */
typedef struct fernlicht_lamp_command {
    double swivel_rad; /* -1.6 .. 1.6; the actuator has limits of its own */
    double pitch_rad;  /* -0.3 .. 0.3 */
    double level;      /* 0 .. 1, times the level that the drive gives */
    double* segments;  /* segment_count levels, 0 .. 1 */
} fernlicht_lamp_command;

typedef struct fernlicht_control_output {
    size_t size; /* sizeof(fernlicht_control_output) */
    size_t lamp_count;
    fernlicht_lamp_command* lamps;
} fernlicht_control_output;

typedef struct fernlicht_control_plugin_info {
    int version; /* FERNLICHT_CONTROL_VERSION */
    size_t size; /* sizeof(fernlicht_control_plugin_info) */
    const char* name;
    /* State of a law for one lamp set; NULL: it needs none. `parameters`: the drive's text, "" where it has none. */
    void* (*create)(const char* parameters);
    /* 0: done. Anything else ends the run. Same inputs and state must give the same outputs: no clock, no chance. */
    int (*step)(void* state, const fernlicht_control_input* input, fernlicht_control_output* output);
    void (*destroy)(void* state); /* NULL: nothing to do */
} fernlicht_control_plugin_info;

/* The one function that the library exports. */
#if defined(_WIN32)
__declspec(dllexport)
#elif defined(__GNUC__)
__attribute__((visibility("default")))
#endif
    const fernlicht_control_plugin_info* fernlicht_control_plugin(void);

#ifdef __cplusplus
}
#endif

#endif
