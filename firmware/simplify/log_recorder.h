// Telling the log of collapses that move a vertex (collapse_log.h), for every method that carries them out by
// collapse_edge().
#pragma once

#include <cstdint>

#include "firmware/simplify/collapse_log.h"
#include "firmware/simplify/edge_collapse.h"
#include "firmware/simplify/working_surface.h"

namespace usuzumi::firmware {

class LogRecorder {
 public:
  /// `log` may be null: then nothing is recorded. `working` outlives the recorder.
  LogRecorder(CollapseLog* log, const WorkingSurface& working) : log_(log), working_(working) {}

  /// After build_surface(), before the first collapse: faces that had no three vertices go with the first step.
  void begin();

  /// After a collapse, its vertex moved and its wedges' attributes final: one step. A store vertex is added for each
  /// wedge of the vertex that stays; wedges that are gone are succeeded by the one they became, or, where no face names
  /// that one any more, by another of the same vertex. So are wedges at the removed faces' third corners that no face
  /// names any more.
  void record(const CollapsedEdge& collapsed);

  /// True where the log has no room for what was recorded: the method stops with log_full_status().
  bool full() const { return log_ != nullptr && log_->full(); }

 private:
  std::uint32_t add_moved(std::uint32_t wedge, Vec3 position);
  StandingWedge standing(std::uint32_t v, std::uint32_t wedge) const;
  void leave_apex(const RemovedFace& removed, std::uint32_t first_store);

  CollapseLog* log_;
  const WorkingSurface& working_;
};

inline Status log_full_status() {
  return {StatusCode::kResourceExhausted, "the memory of the log of collapses is full; give it more, or ask for fewer",
          0};
}

}  // namespace usuzumi::firmware
