// Text grids and the recipes that they are read by, as the tests write them.
#pragma once

#include "scenarios/lamps/grid_recipe.h"
#include "tests/scenarios/lamps/lamp_trial.h"

namespace fernlicht {

class RecipeTrial : public LampTrial {
  protected:
    static std::string recipe_text(const std::string& keys) { return "fernlicht_recipe: 1\n" + keys; }
    LampReadOptions by(const std::string& keys) const { return {.recipe = write("recipe.yaml", recipe_text(keys))}; }
    LampFile read_by(const std::string& keys, const std::string& text) const { return read("lamp.txt", text, by(keys)); }
    CandelaTable table_by(const std::string& keys, const std::string& text) const { return read_by(keys, text).table; }
    /// "" when it reads.
    std::string refusal_by(const std::string& keys, const std::string& text) const { return refusal("lamp.txt", text, by(keys)); }
};

} // namespace fernlicht
