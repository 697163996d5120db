/* Example of a control law in C: bend light by yaw rate, smoothed, the lamps looking to where the car will be in a given time. */
#include "scenarios/control/fernlicht_control.h"

#include <math.h>
#include <stdlib.h>

typedef struct bend_state {
    double preview_s;
    double angle_rad;
} bend_state;

/* Parameters: the preview in seconds, "1.5". */
static void* create(const char* parameters) {
    bend_state* state = malloc(sizeof *state);
    if (!state)
        return NULL;
    const double preview_s = strtod(parameters, NULL);
    state->preview_s = preview_s > 0.0 ? preview_s : 1.5;
    state->angle_rad = 0.0;
    return state;
}

static int step(void* opaque, const fernlicht_control_input* in, fernlicht_control_output* out) {
    bend_state* state = opaque;
    if (!state)
        return 1;
    double wanted_rad = 0.5 * in->ego.yaw_rate_rad_s * state->preview_s;
    if (!isfinite(wanted_rad) || in->ego.speed_mps < 2.0)
        wanted_rad = 0.0;
    const double share = in->dt_s > 0.0 ? -expm1(-in->dt_s / 0.1) : 1.0;
    state->angle_rad += share * (wanted_rad - state->angle_rad);
    for (size_t i = 0; i < out->lamp_count; ++i)
        if (in->lamps[i].may_move)
            out->lamps[i].swivel_rad = state->angle_rad;
    return 0;
}

static void destroy(void* state) { free(state); }

const fernlicht_control_plugin_info* fernlicht_control_plugin(void) {
    static const fernlicht_control_plugin_info info = {
        FERNLICHT_CONTROL_VERSION, sizeof(fernlicht_control_plugin_info), "bend light by yaw rate (example)", create, step, destroy};
    return &info;
}
