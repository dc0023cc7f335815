// glTF accessors, sections 3.6.2 and 5.1: typed arrays in buffers, read with every range checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/pack/tinygltf.h"

namespace usuzumi::sim {

/// Numbers of an accessor, `components` to the element.
struct Elements {
  std::vector<float> values;
  std::size_t components = 0;
  std::size_t count() const { return components == 0 ? 0 : values.size() / components; }
  const float* at(std::size_t i) const { return values.data() + i * components; }
};

class AccessorReader {
 public:
  /// `where` is the file's name; both must outlive the reader.
  AccessorReader(const tinygltf::Model& model, const std::string& where) : model_(model), where_(where) {}

  /// Accessor `index` as floats, normalized integers scaled (section 3.11), sparse elements substituted. It must have
  /// `least` to `most` components. `what` ("POSITION of mesh Wheel") begins the error. Throws Error kBadInput.
  Elements floats(int index, std::size_t least, std::size_t most, const std::string& what) const;
  /// Accessor `index` as vertex numbers: scalar, unsigned bytes, shorts or ints.
  std::vector<std::uint32_t> indices(int index, const std::string& what) const;

 private:
  const tinygltf::Model& model_;
  const std::string& where_;
};

}  // namespace usuzumi::sim
