// What an FMU says of itself: modelDescription.xml of FMI 2.0 and 3.0, as far as co-simulation by inputs, outputs and parameters goes.
#pragma once

#include "scenarios/values/files.h"

#include <cstdint>
#include <optional>

namespace fernlicht {

/// In which C type a value goes in and out.
enum class FmuType : std::uint8_t { float64, float32, int8, uint8, int16, uint16, int32, uint32, int64, uint64, flag, text, none };

/// Base-unit value = factor * value + offset, as UnitDefinitions say; exponents of m, s, cd and rad, and whether there are others.
struct FmuUnit {
    std::string name;
    double factor = 1.0, offset = 0.0;
    int metres = 0, seconds = 0, candelas = 0, radians = 0;
    bool others = false, known = false; ///< `known`: UnitDefinitions have its base units

    bool is_base() const { return factor == 1.0 && offset == 0.0; } ///< then values go through as they are, to the bit
    double to_base(double value) const { return is_base() ? value : factor * value + offset; }
    double from_base(double value) const { return is_base() ? value : (value - offset) / factor; }
};

struct FmuVariable {
    std::string name;
    std::uint32_t reference = 0;
    std::string causality; ///< "input", "output", "parameter" ...
    std::string element;   ///< its type by the standard's name, which the functions carry: "Real", "Float64"
    FmuType type = FmuType::none;
    std::optional<std::size_t> count; ///< of an array's values
    FmuUnit unit;
};

struct FmuDescription {
    int version = 2;                ///< 2 or 3
    std::string name, model, token; ///< `model`: of its binary; `token`: its GUID
    std::vector<FmuVariable> variables;
};

/// `xml`: the content of `path`, which names it in messages alone. Throws InputError: no XML, another version, no co-simulation, one that
/// needs its tool, names that are missing or no names, start values of inputs and outputs that are none of their type, dimensions that
/// nothing gives.
FmuDescription read_fmu_description(const std::filesystem::path& path, const std::string& xml);

} // namespace fernlicht
