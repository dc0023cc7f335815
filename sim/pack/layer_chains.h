// Chains of layers for section LAYR, made by the firmware's own code (firmware/drawing_data/mesh_layers.h).
#pragma once

#include "sim/pack/model.h"

namespace usuzumi::sim {

/// Sets layer_chain of every mesh that has Tags::layers; its level is 3 (apply_tags()). A chain is of one order of
/// vertices and faces: nothing may change those afterwards. A mesh of which none can be made goes without, and one
/// whose thinning ends before its last layer has a chain that ends there; notes say so.
void make_layer_chains(Model& model);

}  // namespace usuzumi::sim
