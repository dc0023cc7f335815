// What a level-3 method did, step by step, so that every state between can be reached again without searching.
//
// A method that is given a log (SimplifyOptions::log) tells it, for each collapse or deletion,
//     begin_step(); change(...)*; (succeed(...) | follow(...))*; remove_face(...)*; end_step();
// in the numbers of the mesh AS GIVEN: corner 3 * face + k, and store vertices. A store vertex is an entry of the
// vertex arrays as given, or one that the method made and handed to add_vertex(): methods that move a vertex add one
// for each wedge of the vertex that stays, methods that do not add none. Corners begin at the vertices that the given
// indices name; a wedge that welding (weld.h) made another's equal is told of under the number it was welded to.
#pragma once

#include <cstdint>
#include <span>

#include "hal/vec.h"

namespace usuzumi::firmware {

/// Corner `corner` named the store vertex `from` and names `to` from this step on.
struct CornerChange {
  std::uint32_t corner = 0, from = 0, to = 0;
};

/// The store vertex `from` is gone after this step; what it stood for is closest to `to`: where it moves to when a
/// middle layer is drawn.
struct Succession {
  std::uint32_t from = 0;
  std::uint32_t to : 31 = 0;
  /// No face that outlives the step named it, and `to` is another wedge of where its faces have gone: it goes to that
  /// place, but is not to take over a piece of texture that has nothing to do with it.
  std::uint32_t place_only : 1 = 0;
};
static_assert(sizeof(Succession) == 8);

/// Everything a step changed: entries from the ends of the step before to these.
struct CollapseStep {
  std::uint32_t change_end = 0;
  std::uint32_t succession_end = 0;
  std::uint32_t faces_after = 0;
};

/// A vertex that a method made, in model units. Attributes that the mesh has not are default.
struct StoreVertex {
  Vec3 position;
  PackedNormal normal;
  Rgba8 colour;
  TexCoord texture_coordinate;
};

class CollapseLog {
 public:
  static constexpr std::uint32_t kNeverRemoved = 0xFFFFFFFFu;

  /// Of the caller; what does not fit makes the log full, and the method stops with kResourceExhausted.
  struct Memory {
    std::span<CollapseStep> steps;
    std::span<CornerChange> changes;
    std::span<Succession> successions;
    std::span<std::uint32_t> removed_at;  // face_count: the step that removed the face, or kNeverRemoved
    std::span<StoreVertex> added;
    std::span<std::uint32_t> store_of_wedge;  // vertex_count: what a wedge's entry holds now; see current()
  };

  /// `vertex_count` and `face_count` are those of the mesh as given.
  CollapseLog(const Memory& memory, std::uint32_t vertex_count, std::uint32_t face_count);

  void begin_step() {}
  void change(std::uint32_t corner, std::uint32_t from, std::uint32_t to);
  void succeed(std::uint32_t from, std::uint32_t to) { follow(from, to, true); }
  /// `whole` is false where the place alone is followed (Succession::place_only).
  void follow(std::uint32_t from, std::uint32_t to, bool whole);
  void remove_face(std::uint32_t face);
  void end_step();

  /// The new store vertex's number.
  std::uint32_t add_vertex(const StoreVertex& vertex);
  /// For methods that keep a vertex's entry and change what is in it: the store vertex that wedge `w` holds now.
  std::uint32_t current(std::uint32_t w) const { return memory_.store_of_wedge[w]; }
  void set_current(std::uint32_t w, std::uint32_t store) { memory_.store_of_wedge[w] = store; }

  bool full() const { return full_; }
  std::span<const CollapseStep> steps() const { return memory_.steps.first(step_count_); }
  std::span<const CornerChange> changes() const { return memory_.changes.first(change_count_); }
  std::span<const Succession> successions() const { return memory_.successions.first(succession_count_); }
  std::span<const std::uint32_t> removed_at() const { return memory_.removed_at; }
  std::span<const StoreVertex> added() const { return memory_.added.first(added_count_); }

 private:
  Memory memory_;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t faces_ = 0;  // of the mesh as given, less those removed
  std::uint32_t step_count_ = 0, change_count_ = 0, succession_count_ = 0, added_count_ = 0;
  bool full_ = false;
};

}  // namespace usuzumi::firmware
