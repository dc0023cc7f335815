// From a working mesh to the connectivity that a method works on, and back: the same for every method.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/simplify/attributes.h"
#include "firmware/simplify/scratch_layout.h"
#include "firmware/simplify/simplify.h"
#include "firmware/simplify/surface.h"

namespace usuzumi::firmware {

/// What build_surface() fills. Vertex arrays have vertex_count entries.
struct SurfaceMemory {
  std::span<std::uint32_t> vertex_of_wedge;
  std::span<std::uint32_t> weld_table;  // weld_table_slots(); may lie where `links` and whatever is used later lie
  std::span<Place> places;
  std::span<Vertex> vertices;
  std::span<std::uint32_t> links;       // 4 per face
  std::span<std::uint32_t> texture_places = {};  // see find_texture_places() (weld.h); empty where nobody asks
};

inline constexpr std::size_t kScratchAlignment = 16;  // of each array, by the methods that ask for no more

/// vertex_of_wedge, places and vertices.
void lay_out_vertices(ScratchLayout& layout, std::uint32_t vertex_count, SurfaceMemory& memory);

/// weld_table, and in its place links and all that `layout` is given after: of use when the surface is built.
void lay_out_links(ScratchLayout& layout, std::uint32_t vertex_count, std::uint32_t face_count, SurfaceMemory& memory);

struct WorkingSurface {
  Surface surface;
  WedgeAttributes attributes;
  std::uint32_t* seam_map = nullptr;  // vertex_of_wedge where some vertex has several wedges
  std::uint32_t live_faces = 0;
  bool positions_kept = false;  // no vertex was moved: write_surface() keeps the mesh's own positions, to the bit
  float scale = 1;  // from model units to those of `places`: a power of two that brings the mesh's extent near 4096
};

/// Welds the mesh's vertices, links the corners and sets the places, marks zero. Quadrics are zero.
void build_surface(WorkingMesh& mesh, const SurfaceMemory& memory, WorkingSurface& out);

/// Moves what is left to the front of the mesh's arrays, in its old order. Spends the marks.
void write_surface(WorkingMesh& mesh, WorkingSurface& surface);

}  // namespace usuzumi::firmware
