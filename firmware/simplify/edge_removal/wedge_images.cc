#include "firmware/simplify/edge_removal/wedge_images.h"

namespace usuzumi::firmware {

bool WedgeImages::plan(const Surface& surface, const Images& images, const Neighbourhood& n, float t) {
  images_ = &images;
  a_ = n.a;
  b_ = n.b;
  count_ = 0;
  for (Corner c = surface.first_corner(a_); c != kNoCorner; c = surface.next_corner_of(c)) {
    const Corner out = next_in_face(c), in = previous_in_face(c);
    const Corner at_b = surface.vertex_at(out) == b_ ? out : in;
    if (surface.vertex_at(at_b) != b_) continue;
    Pair pair;
    pair.a = surface.indices[corner_index(c)];
    pair.b = surface.indices[corner_index(at_b)];
    for (std::uint32_t i = 0; i < count_; ++i) {
      const bool same_a = images.same(pairs_[i].a, pair.a), same_b = images.same(pairs_[i].b, pair.b);
      if (same_a && !same_b && t != 0) return false;
      if (same_b && !same_a && t != 1) return false;
    }
    if (images.texture_coordinates != nullptr) {
      pair.old_a = images.texture_coordinates[pair.a];
      pair.old_b = images.texture_coordinates[pair.b];
      // An end's own are kept to the bit.
      pair.texture_coordinate = t == 1 ? pair.old_b : mixed(pair.old_a, pair.old_b, t);
    }
    if (images.colours != nullptr) {
      pair.old_colour_a = images.colours[pair.a];
      pair.old_colour_b = images.colours[pair.b];
      pair.colour = mixed(pair.old_colour_a, pair.old_colour_b, t);
    }
    pairs_[count_++] = pair;
  }
  return (t == 0 || end_has_images(surface, images, a_, true)) &&
         (t == 1 || end_has_images(surface, images, b_, false));
}

bool WedgeImages::end_has_images(const Surface& surface, const Images& images, std::uint32_t v, bool is_a) const {
  for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
    const std::uint32_t wedge = surface.indices[corner_index(c)];
    std::uint32_t i = 0;
    while (i < count_ && !images.same(is_a ? pairs_[i].a : pairs_[i].b, wedge)) ++i;
    if (i == count_) return false;
  }
  return true;
}

// The pair whose wedge at the same end shows what `wedge` does. Wedges may have been given their new images already, so
// the pairs' old ones are compared.
const WedgeImages::Pair* WedgeImages::pair_of(std::uint32_t wedge, bool is_a) const {
  for (std::uint32_t i = 0; i < count_; ++i) {
    const Pair& pair = pairs_[i];
    const std::uint32_t paired = is_a ? pair.a : pair.b;
    if (paired == wedge) return &pair;
    if (images_->texture_coordinates != nullptr &&
        !((is_a ? pair.old_a : pair.old_b) == images_->texture_coordinates[wedge]))
      continue;
    if (images_->colours != nullptr &&
        !((is_a ? pair.old_colour_a : pair.old_colour_b) == images_->colours[wedge]))
      continue;
    if (images_->groups.size() > 1 && images_->group_of(paired) != images_->group_of(wedge)) continue;
    return &pair;
  }
  return nullptr;
}

void WedgeImages::apply(Surface& surface, const WedgeAttributes& attributes) const {
  if (attributes.texture_coordinates == nullptr && attributes.colours == nullptr) return;
  constexpr std::uint32_t kDone = 1;
  const auto set_marks = [&](std::uint32_t mark) {
    for (const std::uint32_t v : {a_, b_}) {
      for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
        std::uint32_t& flags = surface.places[surface.indices[corner_index(c)]].mark;
        flags = (flags & kPlaceFlags) | mark;
      }
    }
  };
  set_marks(0);
  for (const std::uint32_t v : {a_, b_}) {
    for (Corner c = surface.first_corner(v); c != kNoCorner; c = surface.next_corner_of(c)) {
      const std::uint32_t wedge = surface.indices[corner_index(c)];
      std::uint32_t& mark = surface.places[wedge].mark;
      if ((mark & ~kPlaceFlags) == kDone) continue;
      mark |= kDone;
      const Pair* pair = pair_of(wedge, v == a_);
      if (pair == nullptr) continue;  // of an end that stays where it is
      if (attributes.texture_coordinates != nullptr)
        attributes.texture_coordinates[wedge] = pair->texture_coordinate;
      if (attributes.colours != nullptr) attributes.colours[wedge] = pair->colour;
    }
  }
  set_marks(0);
}

}  // namespace usuzumi::firmware
