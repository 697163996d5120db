// What decides the figures of a cell, each with the hash of its content: why it was played, and what changed between two nights.
#pragma once

#include "runner/files/described_json.h"

#include <compare>
#include <string>
#include <string_view>
#include <vector>

namespace fernlicht {

/// Whose change a change of an input is.
enum class InputKind { drive, road, lamp, model, setting, program, library, device };

struct CellInput {
    InputKind kind = InputKind::drive;
    std::string name; ///< for people: "halogen-low.ies", "straight.yaml: weather" (of a drive: its key), "renderer" (of the program: its
                      ///< folder), "OpenCV"
    std::string hash; ///< of the content, 32 hexadecimal digits; of libraries and devices what they call themselves
    auto operator<=>(const CellInput&) const = default;
};
using CellInputs = std::vector<CellInput>;

/// "drive", "road", ...
const char* input_kind_name(InputKind kind);

JsonMembers cell_input_members(CellInput& input);

/// A drive is an input as a whole, by its file's name, and key by key, which tell what of it changed: "straight.yaml: weather".
inline constexpr std::string_view before_key = ": ";
inline bool is_key(const CellInput& input) { return input.kind == InputKind::drive && input.name.find(before_key) != std::string::npos; }

/// One input that differs.
struct InputChange {
    InputKind kind = InputKind::drive;
    std::string name;        ///< of drives with all keys that differ: "straight.yaml (start, weather)"
    std::string before, now; ///< hash or version, of drives "changed"; "" where it was not there
    auto operator<=>(const InputChange&) const = default;
};
using InputChanges = std::vector<InputChange>;

/// In the order of kinds and names. What changed in a drive is told as one change: it differs from lamp to lamp, so that each key would be
/// several.
InputChanges changed_inputs(const CellInputs& before, const CellInputs& now);

/// What differs, one phrase each: "lamp low-beam.ies changed (bytes of its file)", "program changed: renderer", "device changed: renderer
/// llvmpipe (LLVM 15.0.6, 256 bits) -> llvmpipe (LLVM 19.1.7, 256 bits)", "lamp high-beam.ies is new". Empty where nothing does.
std::vector<std::string> input_changes(const CellInputs& before, const CellInputs& now);

} // namespace fernlicht
