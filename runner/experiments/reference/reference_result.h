// What `fernlicht reference` made, as plain values.
#pragma once

#include "renderer/reference/reference.h"
#include "runner/findings/document.h"
#include "runner/findings/findings.h"

#include <optional>

namespace fernlicht {

/// How near a result came to the error that was wanted: relative standard errors, of max(mean, floor), over the lit pixels, those whose
/// mean is above 0. Where no sample saw light (the sky, the back of a hill) the error is 0 and would say nothing but how many they are.
struct ErrorReached {
    std::size_t lit_pixels = 0;
    double median = 0.0, p95 = 0.0, worst = 0.0;
    double share_reached = 0.0; ///< of lit pixels whose error is at most the target
};
/// nullopt where the result was not wanted or no pixel that is drawn is lit.
std::optional<ErrorReached> error_reached(const Estimate& estimate, const Image<std::uint32_t>& samples, double target_error, double floor);

/// Its context has no device: no backend.
struct ReferenceResult : Findings {
    std::string drive, title, lamp_set;
    Moment moment;
    View view;
    FrameOutputs outputs;
    ReferenceSettings settings;
    ReferenceImage image;
    std::size_t triangles = 0;
    std::string inputs;      ///< everything that decides the picture (checkpoint.h)
    std::string inputs_hash; ///< 32 hexadecimal digits over them

    std::optional<ErrorReached> illuminance() const;
    std::optional<ErrorReached> target() const;
    std::optional<ErrorReached> luminance() const;
};

std::string integrator_name(Integrator integrator);
/// nullopt for a name that no integrator has.
std::optional<Integrator> integrator_of(const std::string& name);

/// reference.exr (mean and variance), reference.json, and of perspective views reference.png for eyes. Throws DeviceError.
void write_reference(const ReferenceResult& result, const ToneMapper& tone_mapper, const std::filesystem::path& folder);
std::string reference_json_schema();

/// How exact it is and what it took.
Document document(const ReferenceResult& result);
/// Illuminance and its standard error.
std::vector<Plot> false_colours(const ReferenceResult& result);

} // namespace fernlicht
