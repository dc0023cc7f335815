#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

std::uint32_t link_corners(Surface& surface) {
  for (std::uint32_t v = 0; v < surface.vertex_count; ++v) surface.vertices[v] = Vertex{};
  std::uint32_t live = 0;
  for (std::uint32_t face = surface.face_count; face-- > 0;) {
    const Corner corner = face * 4;
    surface.set_facing(corner, PackedNormal{0});
    const std::uint32_t v[3] = {surface.vertex_at(corner), surface.vertex_at(corner + 1),
                                surface.vertex_at(corner + 2)};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      surface.indices[corner_index(corner)] = kDeadFace;
      for (Corner c = corner; c < corner + 3; ++c) surface.links[c] = kNoCorner;
      continue;
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      surface.links[corner + k] = surface.vertices[v[k]].first_corner;
      surface.vertices[v[k]].first_corner = corner + k;
    }
    ++live;
  }
  return live;
}

void unlink_corner(Surface& surface, std::uint32_t v, Corner c) {
  const Corner after = surface.next_corner_of(c);
  Corner walk = surface.first_corner(v);
  if (walk == c) {
    surface.vertices[v].first_corner = after;
    return;
  }
  while (surface.next_corner_of(walk) != c) walk = surface.next_corner_of(walk);
  std::uint32_t& link = surface.links[walk];
  link = (link & ~kCornerMask) | after;
}

StandingWedge standing_wedge(const Surface& surface, const TexCoord* texture_coordinates, std::uint32_t v,
                             std::uint32_t wedge) {
  const auto same_texture = [&](std::uint32_t other) {
    return texture_coordinates == nullptr || texture_coordinates[other] == texture_coordinates[wedge];
  };
  StandingWedge found;
  for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
    const std::uint32_t named = surface.indices[corner_index(c)];
    if (named == wedge) return {wedge, true};
    if (found.wedge != kNoWedge && (found.same_texture || !same_texture(named))) continue;
    found = {named, same_texture(named)};
  }
  return found;
}

}  // namespace usuzumi::firmware
