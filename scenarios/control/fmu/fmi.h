// The C interfaces of FMI 2.0 and FMI 3.0 as far as an importer of co-simulation needs them: values, and functions by their types.
// Source: the standards, fmi-standard.org (2.0.4, chapters 2.1 and 4.2; 3.0.1, chapters 2.2 and 4.2).
#pragma once

#include <cstddef>
#include <cstdint>

namespace fernlicht::fmi {

using Instance = void*;
using Environment = void*;
using Reference = std::uint32_t; ///< of a variable: unsigned int in 2.0

enum Status : int { ok, warning, discard, error, fatal, pending }; ///< `pending`: 2.0 alone

/// Both standards alike; in 2.0 the value is a pointer to as many as there are references.
using Plain = int(Instance);

namespace v2 {
using Text = const char*;
using Flag = int;
inline constexpr int co_simulation = 1;

extern "C" struct Callbacks {
    void (*log)(Environment, Text instance, int status, Text category, Text message, ...);
    void* (*allocate)(std::size_t count, std::size_t bytes);
    void (*free)(void*);
    void (*step_finished)(Environment, int status);
    Environment environment;
};

using Instantiate = Instance(Text name, int type, Text guid, Text resources, const Callbacks*, Flag visible, Flag logging);
using SetupExperiment = int(Instance, Flag has_tolerance, double tolerance, double start_s, Flag has_stop, double stop_s);
using DoStep = int(Instance, double at_s, double step_s, Flag no_way_back);
template <class T> using Set = int(Instance, const Reference*, std::size_t references, const T*);
template <class T> using Get = int(Instance, const Reference*, std::size_t references, T*);
} // namespace v2

namespace v3 {
using Text = const char*;
using Log = void(Environment, int status, Text category, Text message);
using Update = void(Environment, double at_s, bool may_set, bool may_get, bool step_finished, bool may_return, bool* returns,
                    double* returns_at_s);
using Instantiate = Instance(Text name, Text token, Text resources, bool visible, bool logging, bool events, bool early_return,
                             const Reference* intermediate, std::size_t intermediates, Environment, Log*, Update*);
using EnterInitialization = int(Instance, bool has_tolerance, double tolerance, double start_s, bool has_stop, double stop_s);
using DoStep = int(Instance, double at_s, double step_s, bool no_way_back, bool* event, bool* ends, bool* early_return, double* until_s);
template <class T> using Set = int(Instance, const Reference*, std::size_t references, const T*, std::size_t values);
template <class T> using Get = int(Instance, const Reference*, std::size_t references, T*, std::size_t values);
} // namespace v3

} // namespace fernlicht::fmi
