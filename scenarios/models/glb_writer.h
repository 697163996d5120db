// A model as a glTF 2.0 file in one piece.
#pragma once

#include "scenarios/models/model.h"

namespace fernlicht {

/// A .glb that read_model reads back to the same triangles, colours, retroreflection and mounts. Pictures are written as they are given:
/// `pictures[i]` is the PNG or JPEG of Model::textures[i], empty to leave it out; fewer may be given than there are textures.
std::string glb_of(const Model& model, const std::vector<std::string>& pictures = {});

} // namespace fernlicht
