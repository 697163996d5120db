// What decides the figures of a cell, each with the hash of its content: why it was played, and what changed between two nights.
#pragma once

#include "runner/files/described_json.h"

#include <compare>
#include <string>
#include <vector>

namespace fernlicht {

/// Whose change a change of an input is.
enum class InputKind { drive, road, lamp, model, setting, program, library, device };

struct CellInput {
    InputKind kind = InputKind::drive;
    std::string name; ///< for people: "halogen-low.ies", "renderer" (of the program: its folder), "OpenCV"
    std::string hash; ///< of the content, 32 hexadecimal digits; of libraries and devices what they call themselves
    auto operator<=>(const CellInput&) const = default;
};
using CellInputs = std::vector<CellInput>;

/// "drive", "road", ...
const char* input_kind_name(InputKind kind);

JsonMembers cell_input_members(CellInput& input);

/// What differs, one phrase each: "lamp low-beam.ies changed (bytes of its file)", "program changed: renderer", "device changed: renderer
/// llvmpipe (LLVM 15.0.6, 256 bits) -> llvmpipe (LLVM 19.1.7, 256 bits)", "lamp high-beam.ies is new". Empty where nothing does.
std::vector<std::string> input_changes(const CellInputs& before, const CellInputs& now);

} // namespace fernlicht
