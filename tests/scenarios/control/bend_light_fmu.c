/* The example's law as an FMU, of FMI 2.0 and 3.0 at once: one source for plug-in and FMU. Values lie in one array, by reference; `fault`
 * asks for what an FMU should not do. */
#include "scenarios/control/examples/bend_light.c"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { yaw_rate, speed, swivel, fault, echo_from, echo_to = 64, preview = 127, handed = 128, values = 192 };
enum { fault_nan = 1, fault_status_from = 10, fault_crash = 20, fault_text = 21 };

typedef void (*logs2)(void*, const char*, int, const char*, const char*, ...);
typedef void (*logs3)(void*, int, const char*, const char*);

typedef struct instance {
    double value[values];
    void* law;
    void* environment;
    logs2 log2;
    logs3 log3;
    char text[64];
} instance;

static instance* made(const char* token) {
    instance* of = strcmp(token, "bend-light") == 0 ? calloc(1, sizeof *of) : NULL;
    if (of)
        of->value[preview] = 1.5;
    return of;
}

/* What it computes at a time is there at once; what comes in at echo_from + i goes out at echo_to + i. */
static int moved(instance* of, double dt_s) {
    fernlicht_lamp lamp = {.name = "any", .may_move = 1};
    fernlicht_lamp_command command = {0};
    fernlicht_control_input in = {.size = sizeof in, .dt_s = dt_s, .lamp_count = 1, .lamps = &lamp};
    fernlicht_control_output out = {sizeof out, 1, &command};
    in.ego.yaw_rate_rad_s = of->value[yaw_rate];
    in.ego.speed_mps = of->value[speed];
    step(of->law, &in, &out);
    of->value[swivel] = of->value[fault] == fault_nan ? NAN : command.swivel_rad;
    if (of->value[fault] == fault_text)
        of->value[swivel] = strcmp(of->text, "said") == 0 ? 0.25 : 0.0;
    memcpy(of->value + echo_to, of->value + echo_from, sizeof(double) * (echo_to - echo_from));
    return 0;
}

static int entered(instance* of) {
    char text[32];
    snprintf(text, sizeof text, "%.17g", of->value[preview]);
    of->law = create(text);
    return 0;
}

static int stepped(instance* of, double dt_s) {
    const int status = (int)of->value[fault] - fault_status_from;
    if (of->value[fault] == fault_crash)
        *(volatile int*)0 = 1;
    if (status > 0 && status < 6) {
        if (of->log2)
            of->log2(of->environment, "bend", status, "all", "no step of %g ms", 1e3 * dt_s);
        if (of->log3)
            of->log3(of->environment, status, "all", "no step of 20 ms");
        return status;
    }
    return moved(of, dt_s);
}

static void freed(void* of) {
    destroy(((instance*)of)->law);
    free(of);
}

#define API __attribute__((visibility("default")))

/* FMI 2.0 */
typedef struct callbacks2 {
    logs2 log;
    void* (*allocate)(size_t, size_t);
    void (*release)(void*);
    void (*finished)(void*, int);
    void* environment;
} callbacks2;

API void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources, const callbacks2* with, int visible,
                          int logs) {
    instance* of = type == 1 && strncmp(resources, "file:///", 8) == 0 && !visible && logs ? made(guid) : NULL;
    (void)name;
    if (of) {
        of->log2 = with->log;
        of->environment = with->environment;
    } else {
        with->log(with->environment, "bend", 3, "all", "not the FMU of %s", guid);
    }
    return of;
}
API int fmi2SetupExperiment(void* of, int has_tolerance, double tolerance, double start, int has_stop, double stop) {
    return of && !has_tolerance && tolerance == 0.0 && start == 0.0 && !has_stop && stop == 0.0 ? 0 : 3;
}
API int fmi2EnterInitializationMode(void* of) { return entered(of); }
API int fmi2ExitInitializationMode(void* of) { return moved(of, 0.0); }
API int fmi2DoStep(void* of, double at, double dt, int no_way_back) { return at >= 0.0 && no_way_back ? stepped(of, dt) : 3; }
API int fmi2Terminate(void* of) { return of ? 0 : 3; }
API void fmi2FreeInstance(void* of) { freed(of); }

/* FMI 3.0 */
API void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, _Bool visible, _Bool logs, _Bool events,
                                      _Bool early, const uint32_t* of_update, size_t count, void* environment, logs3 log, void* update) {
    instance* of = !visible && logs && !events && !early && !of_update && !count && !update && resources[strlen(resources) - 1] == '/'
                       ? made(token)
                       : NULL;
    (void)name;
    if (of) {
        of->log3 = log;
        of->environment = environment;
        memcpy(of->value + handed, &environment, sizeof environment);
        memcpy(of->value + handed + 1, &log, sizeof log);
    } else {
        log(environment, 3, "all", "not this FMU");
    }
    return of;
}
API int fmi3EnterInitializationMode(void* of, _Bool has_tolerance, double tolerance, double start, _Bool has_stop, double stop) {
    return !has_tolerance && tolerance == 0.0 && start == 0.0 && !has_stop && stop == 0.0 ? entered(of) : 3;
}
API int fmi3ExitInitializationMode(void* of) { return moved(of, 0.0); }
API int fmi3DoStep(void* of, double at, double dt, _Bool no_way_back, _Bool* event, _Bool* ends, _Bool* early, double* until) {
    *event = *ends = *early = 0;
    *until = at + dt;
    return no_way_back ? stepped(of, dt) : 3;
}
API int fmi3Terminate(void* of) { return of ? 0 : 3; }
API void fmi3FreeInstance(void* of) { freed(of); }

#define ACCESS2(Type, c_type)                                                                                                              \
    API int fmi2Set##Type(void* of, const uint32_t* at, size_t count, const c_type* from) {                                                \
        for (size_t i = 0; i < count; ++i)                                                                                                 \
            ((instance*)of)->value[at[i]] = (double)from[i];                                                                               \
        return 0;                                                                                                                          \
    }                                                                                                                                      \
    API int fmi2Get##Type(void* of, const uint32_t* at, size_t count, c_type* to) {                                                        \
        for (size_t i = 0; i < count; ++i)                                                                                                 \
            to[i] = (c_type)((instance*)of)->value[at[i]];                                                                                 \
        return 0;                                                                                                                          \
    }
/* Arrays lie from their reference on. */
#define ACCESS3(Type, c_type)                                                                                                              \
    API int fmi3Set##Type(void* of, const uint32_t* at, size_t count, const c_type* from, size_t all) {                                    \
        for (size_t i = 0; count == 1 && i < all; ++i)                                                                                     \
            ((instance*)of)->value[at[0] + i] = (double)from[i];                                                                           \
        return count == 1 ? 0 : 3;                                                                                                         \
    }                                                                                                                                      \
    API int fmi3Get##Type(void* of, const uint32_t* at, size_t count, c_type* to, size_t all) {                                            \
        for (size_t i = 0; count == 1 && i < all; ++i)                                                                                     \
            to[i] = (c_type)((instance*)of)->value[at[0] + i];                                                                             \
        return count == 1 ? 0 : 3;                                                                                                         \
    }
ACCESS2(Real, double)
ACCESS2(Integer, int32_t)
ACCESS2(Boolean, int32_t)
ACCESS3(Float64, double)
ACCESS3(Float32, float)
ACCESS3(Int8, int8_t)
ACCESS3(UInt16, uint16_t)
ACCESS3(Int64, int64_t)
ACCESS3(Boolean, _Bool)
API int fmi2SetString(void* of, const uint32_t* at, size_t count, const char* const* from) {
    (void)at;
    snprintf(((instance*)of)->text, sizeof((instance*)of)->text, "%s", from[0]);
    return count == 1 ? 0 : 3;
}
API int fmi3SetString(void* of, const uint32_t* at, size_t count, const char* const* from, size_t all) {
    return all == count ? fmi2SetString(of, at, count, from) : 3;
}
