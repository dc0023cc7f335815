#include "firmware/simplify/simplify.h"

#include "firmware/simplify/edge_removal/edge_removal.h"
#include "firmware/simplify/half_edge/half_edge.h"
#include "firmware/simplify/qem/qem.h"
#include "firmware/simplify/surface.h"
#include "firmware/simplify/vertex_deletion/vertex_deletion.h"

namespace usuzumi::firmware {

Result<SimplifyOutcome> simplify(WorkingMesh& mesh, const SimplifyOptions& options, Arena& scratch) {
  if (mesh.face_count > kMostFaces)
    return Status{StatusCode::kUnsupported, "a mesh has more faces than simplify can number; split it",
                  mesh.face_count};
  switch (options.method) {
    case Method::kQem: return simplify_qem(mesh, options, scratch);
    case Method::kEdgeRemoval: return simplify_edge_removal(mesh, options, scratch);
    case Method::kHalfEdge: return simplify_half_edge(mesh, options, scratch);
    case Method::kVertexDeletion: return simplify_vertex_deletion(mesh, options, scratch);
  }
  return Status{StatusCode::kUnsupported, "no such thinning method",
                static_cast<std::uint32_t>(options.method)};
}

std::uint64_t simplify_scratch_bytes(Method method, std::uint32_t vertex_count, std::uint32_t face_count,
                                     bool has_texture_coordinates) {
  switch (method) {
    case Method::kQem: return qem_scratch_bytes(vertex_count, face_count, has_texture_coordinates);
    case Method::kEdgeRemoval: return edge_removal_scratch_bytes(vertex_count, face_count);
    case Method::kHalfEdge: return half_edge_scratch_bytes(vertex_count, face_count);
    case Method::kVertexDeletion: return vertex_deletion_scratch_bytes(vertex_count, face_count);
  }
  return 0;
}

}  // namespace usuzumi::firmware
