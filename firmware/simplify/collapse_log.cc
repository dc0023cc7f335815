#include "firmware/simplify/collapse_log.h"

namespace usuzumi::firmware {

CollapseLog::CollapseLog(const Memory& memory, std::uint32_t vertex_count, std::uint32_t face_count)
    : memory_(memory), vertex_count_(vertex_count), faces_(face_count) {
  full_ = memory_.removed_at.size() < face_count || memory_.store_of_wedge.size() < vertex_count;
  if (full_) return;
  memory_.removed_at = memory_.removed_at.first(face_count);
  for (std::uint32_t& step : memory_.removed_at) step = kNeverRemoved;
  for (std::uint32_t w = 0; w < vertex_count; ++w) memory_.store_of_wedge[w] = w;
}

void CollapseLog::change(std::uint32_t corner, std::uint32_t from, std::uint32_t to) {
  if (change_count_ == memory_.changes.size()) {
    full_ = true;
    return;
  }
  memory_.changes[change_count_++] = {corner, from, to};
}

void CollapseLog::follow(std::uint32_t from, std::uint32_t to, bool whole) {
  if (succession_count_ == memory_.successions.size()) {
    full_ = true;
    return;
  }
  memory_.successions[succession_count_++] = {from, to & 0x7FFFFFFFu, whole ? 0u : 1u};
}

void CollapseLog::remove_face(std::uint32_t face) {
  if (face >= memory_.removed_at.size()) return;
  memory_.removed_at[face] = step_count_;
  --faces_;
}

void CollapseLog::end_step() {
  if (step_count_ == memory_.steps.size()) {
    full_ = true;
    return;
  }
  memory_.steps[step_count_++] = {change_count_, succession_count_, faces_};
}

std::uint32_t CollapseLog::add_vertex(const StoreVertex& vertex) {
  const std::uint32_t number = vertex_count_ + added_count_;
  if (added_count_ == memory_.added.size()) full_ = true;
  else memory_.added[added_count_++] = vertex;
  return number;
}

}  // namespace usuzumi::firmware
