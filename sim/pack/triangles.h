// Strips and fans taken apart into triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace usuzumi::sim {

enum class Assembly { kList, kStrip, kFan };

/// Three vertex numbers per face, wound as glTF 2.0 section 3.7.2.1 says. Faces that repeat a vertex, which only join
/// runs of a strip, are left out; so is an unfinished last triangle.
inline std::vector<std::uint32_t> assemble(Assembly assembly, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> faces;
  auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a == b || b == c || c == a) return;
    faces.insert(faces.end(), {a, b, c});
  };
  switch (assembly) {
    case Assembly::kList:
      faces.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(order.size() / 3 * 3));
      break;
    case Assembly::kStrip:
      for (std::size_t i = 0; i + 2 < order.size(); ++i) add(order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]);
      break;
    case Assembly::kFan:
      for (std::size_t i = 1; i + 1 < order.size(); ++i) add(order[0], order[i], order[i + 1]);
      break;
  }
  return faces;
}

}  // namespace usuzumi::sim
