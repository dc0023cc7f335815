// A round: the draws and clears gathered from a command list until a table is full, the target changes or the list
// ends; then geometry jobs fill bins and workers rasterize tile by tile. Several rounds give the same bytes as one.
#pragma once

#include "gfx_subsystem/engine_soft/binner.h"
#include "gfx_subsystem/engine_soft/draw_setup.h"

namespace usuzumi::gfx::soft {

/// Where a round's pixels go.
struct RoundTarget {
  std::byte* colour = nullptr;
  std::uint32_t colour_stride = 0;
  std::int32_t width = 0, height = 0;
  bool rgb565 = false;
  std::byte* depth = nullptr;  // nullptr: none
  std::uint32_t depth_stride = 0;
  bool depth16 = false;
  /// Pixels of 4 bytes are stored past the caches. A finished tile is not needed again, and fetching its lines only to
  /// overwrite them would take longer than drawing it. Only where the planes' rows begin and end at cache lines: half a
  /// line streamed costs more than a line fetched.
  bool streaming = false;
  friend bool operator==(const RoundTarget&, const RoundTarget&) = default;
};

struct ClearOperation {
  PixelRect rect;              // not empty
  bool colour, depth;
  std::uint32_t pixel, depth_value;
};

/// A run of one draw's primitives, or a clear; in list order.
struct WorkItem {
  bool is_clear;
  std::uint32_t index;         // of the draw or of the clear
  std::uint32_t first, count;  // primitives
};

/// How far a job has come.
struct JobPosition {
  std::uint32_t item;       // next item
  std::uint32_t primitive;  // done already of that item
  std::uint32_t piece;      // binned already of that primitive
  friend bool operator==(const JobPosition&, const JobPosition&) = default;
};

/// Items in a row that one thread bins into one set of lists.
struct Job {
  JobPosition next;
  std::uint32_t end_item;
  bool complete;
  std::uint64_t faces_drawn;  // in this round
  TileList* lists;
};

/// What one thread needs for itself.
struct Worker {
  Vertex* vertices = nullptr;
  std::uint32_t vertex_capacity = 0;
  std::uint32_t* colour = nullptr;  // kTilePixels each, in blocks
  std::uint32_t* depth = nullptr;
  std::uint64_t pixels_tested = 0;
  std::uint64_t texels_fetched = 0;
  std::uint64_t pixels_blended = 0;
};

/// A worker's vertices as one draw uses them: where it makes fragments, fewer, with their extras behind.
struct VertexStore {
  Vertex* vertices;
  VertexExtra* extras;  // nullptr: none
  std::uint32_t capacity;

  VertexStore(const DrawSetup& draw, const Worker& worker)
      : vertices(worker.vertices), extras(nullptr), capacity(worker.vertex_capacity) {
    if (!draw.fragments) return;
    capacity = static_cast<std::uint32_t>(std::size_t{capacity} * sizeof(Vertex) /
                                          (sizeof(Vertex) + sizeof(VertexExtra)));
    extras = reinterpret_cast<VertexExtra*>(vertices + capacity);
  }

  /// Of a vertex here or of a PlacedVertex.
  const VertexExtra& extra_of(const Vertex& v) const {
    const auto offset = reinterpret_cast<std::uintptr_t>(&v) - reinterpret_cast<std::uintptr_t>(vertices);
    const std::size_t place = offset / sizeof(Vertex);
    return place < capacity ? extras[place] : reinterpret_cast<const PlacedVertex&>(v).extra;
  }
};

struct Round {
  RoundTarget target;
  TileGrid grid;
  const DrawSetup* draws = nullptr;
  const ClearOperation* clears = nullptr;
  std::uint32_t clear_count = 0;
  const WorkItem* items = nullptr;
  Job* jobs = nullptr;
  SlotPool* pool = nullptr;
  bool uses_depth = false;  // any item reads or writes depth
};

/// Targets of fewer bytes are not streamed: they stay in a host's last cache until the display reads them and the next
/// frame overwrites them, and several cores store there faster than into memory. 800x480 with depth is 3 MB, 1920x720
/// is 11 MB; by measuring, no byte depends on it.
inline constexpr std::size_t kStreamingBytes = 8u << 20;

inline constexpr std::uint32_t kMaxDraws = 256;       // fits the 15 bits of SmallTriangle::draw
inline constexpr std::uint32_t kMaxVertexPerPrimitive = 3;
inline constexpr std::uint32_t kMinVertexCapacity = 64;

/// Entry points of one compiled variant of the kernels.
struct Kernels {
  const char* name;
  bool (*supported)();
  /// Runs the job until it is complete or the pool is exhausted.
  void (*run_geometry)(const Round& round, Job& job, Worker& worker);
  /// Rasterizes a tile from the lists of the first `jobs` jobs.
  void (*run_tile)(const Round& round, Worker& worker, std::uint32_t tile, std::uint32_t jobs);
  /// Clears a row of tiles when the round holds nothing but clears.
  void (*run_clears)(const Round& round, std::uint32_t tile_row);
};

/// Variants in rising order of preference; the first runs everywhere. Their results are the same bytes.
std::span<const Kernels* const> all_kernels();

}  // namespace usuzumi::gfx::soft
