// The ways to light a scene, as rows of one table. A row says what is computed; the shaders follow from it and from what the scene needs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace fernlicht {

/// as_published: the founding thesis's configurations with its misprints repaired. as_printed: misprints and all. known: other ways in
/// the literature. ours: the technique of this program.
enum class TechniqueKind { as_published, as_printed, known, ours };

struct Technique {
    std::string_view name; ///< as typed: "full"
    TechniqueKind kind = TechniqueKind::ours;
    int thesis_row = 0;          ///< of Table 6.1, 1 to 11; 0: not in it
    std::string_view thesis_fps; ///< as the table gives it: "~22"; "" where it is not in it
    std::string_view origin;     ///< where it comes from
    std::string_view computes;
    std::string_view ignores;
    int passes = 1;            ///< times the scene is drawn for one view, shadow maps apart
    bool illuminance = false;  ///< believes in an illuminance, which it can draw as a lux image
    bool target = false;       ///< and in that of a target standing in the scene
    bool luminance = false;    ///< and in a luminance towards the eye
    std::string_view features; ///< what the published techniques' shader is compiled with, "NAME=VALUE ..."; "" for ours
};

/// All of them, in the order of the thesis's table and then of the list in the documents.
std::span<const Technique> techniques();
/// Throws InputError naming the nearest name.
const Technique& technique_named(std::string_view name, const std::filesystem::path& asked_in = {}, const std::string& key = "technique");

} // namespace fernlicht
