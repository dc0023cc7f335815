// tinygltf, built into this program under a namespace of its own.
//
// Debian's libdraco, which libassimp brings along, exports another version of tinygltf under the same names with
// another layout of its classes. Which one a program gets would hang on the order of libraries at link time, and the
// wrong one crashes. So the implementation in tinygltf's header is compiled here (tinygltf.cc) and libtinygltf is not
// linked.
#pragma once

#define tinygltf usuzumi_tinygltf

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON

#include <nlohmann/json.hpp>

#include <tiny_gltf.h>
