#include "firmware/simplify/log_recorder.h"

namespace usuzumi::firmware {

void LogRecorder::begin() {
  if (log_ == nullptr) return;
  for (std::uint32_t face = 0; face < working_.surface.face_count; ++face)
    if (working_.surface.is_dead(face)) log_->remove_face(face);
}

// A new store vertex for what wedge `wedge` holds now, in the place of the one that it held.
std::uint32_t LogRecorder::add_moved(std::uint32_t wedge, Vec3 position) {
  const WedgeAttributes& attributes = working_.attributes;
  StoreVertex vertex{.position = position, .normal = {}, .colour = {}, .texture_coordinate = {}};
  if (attributes.normals != nullptr) vertex.normal = attributes.normals[wedge];
  if (attributes.colours != nullptr) vertex.colour = attributes.colours[wedge];
  if (attributes.texture_coordinates != nullptr) vertex.texture_coordinate = attributes.texture_coordinates[wedge];
  const std::uint32_t store = log_->add_vertex(vertex);
  log_->succeed(log_->current(wedge), store);
  log_->set_current(wedge, store);
  return store;
}

StandingWedge LogRecorder::standing(std::uint32_t v, std::uint32_t wedge) const {
  return standing_wedge(working_.surface, working_.attributes.texture_coordinates, v, wedge);
}

// A wedge that no face names any more goes where its vertex goes: while a middle layer is drawn, its faces are still
// there.
void LogRecorder::leave_apex(const RemovedFace& removed, std::uint32_t first_store) {
  const StandingWedge stands = standing(removed.apex, removed.apex_wedge);
  if (stands.wedge == removed.apex_wedge) return;
  const std::uint32_t to = stands.wedge == kNoWedge ? first_store : log_->current(stands.wedge);
  if (log_->current(removed.apex_wedge) == to) return;  // told of by another face
  log_->follow(log_->current(removed.apex_wedge), to, stands.same_texture);
  log_->set_current(removed.apex_wedge, to);
}

void LogRecorder::record(const CollapsedEdge& collapsed) {
  if (log_ == nullptr || log_->full()) return;
  const Surface& s = working_.surface;
  const Vec3 position = s.position(collapsed.vertex) * (1.0f / working_.scale);
  log_->begin_step();

  // Each wedge that a face still names, once. The successions told here come in the order of the new numbers, so that
  // the number before is found again from the number after.
  const std::size_t first_succession = log_->successions().size();
  std::uint32_t first_store = 0;
  bool any = false;
  for (Corner c = s.first_corner(collapsed.vertex); c != kNoCorner; c = s.next_corner_of(c)) {
    const std::uint32_t wedge = s.indices[corner_index(c)];
    if (any && log_->current(wedge) >= first_store) continue;
    const std::uint32_t store = add_moved(wedge, position);
    if (!any) first_store = store;
    any = true;
  }
  if (log_->full() || !any) return;

  for (Corner c = s.first_corner(collapsed.vertex), from_removed = kNoCorner; c != kNoCorner;
       c = s.next_corner_of(c)) {
    if (c == collapsed.first_from_removed) from_removed = c;
    const std::uint32_t wedge = s.indices[corner_index(c)];
    const std::uint32_t before = from_removed == kNoCorner ? wedge : collapsed.pairs.predecessor(wedge);
    const std::uint32_t to = log_->current(wedge);
    const std::uint32_t from =
        before == wedge ? log_->successions()[first_succession + (to - first_store)].from : log_->current(before);
    log_->change(static_cast<std::uint32_t>(corner_index(c)), from, to);
  }

  // Wedges that only removed faces named, and those that another stands for now. Of a face's two either follows the
  // other where faces still name that one, else both the same third: told first, neither counts as standing.
  const auto leave = [&](std::uint32_t wedge, const StandingWedge& stands) {
    if (log_->current(wedge) >= first_store) return;  // it stays, or was told of
    const std::uint32_t to = log_->current(stands.wedge);
    log_->follow(log_->current(wedge), to, stands.same_texture);
    log_->set_current(wedge, to);
  };
  for (std::uint32_t i = 0; i < collapsed.faces_removed; ++i) {
    const RemovedFace& removed = collapsed.removed[i];
    StandingWedge stands = standing(collapsed.vertex, removed.kept_wedge);
    if (stands.wedge != removed.kept_wedge) {
      const StandingWedge other = standing(collapsed.vertex, removed.removed_wedge);
      if (other.wedge == removed.removed_wedge) stands = other;
    }
    leave(removed.removed_wedge, stands);
    leave(removed.kept_wedge, stands);
    leave_apex(removed, first_store);
    log_->remove_face(removed.face);
  }
  log_->end_step();
}

}  // namespace usuzumi::firmware
