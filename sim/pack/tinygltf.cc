#define TINYGLTF_IMPLEMENTATION
#include "sim/pack/tinygltf.h"
