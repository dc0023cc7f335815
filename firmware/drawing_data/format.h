// The two formats of drawing data, word by word. The page beside this file (README.md) has the byte tables.
//
// Bare (JP2015-22462A [0029-0031], fig. 3): mesh-max, then per mesh: vertex count, thinning level, X Y Z per vertex.
// 32-bit little-endian words, IEEE singles; vertex order is a triangle strip.
// Container: a header and a section table around the same records, for what the patent's layout has no room for.
#pragma once

#include <cstdint>

#include "firmware/simplify/bounds.h"

namespace usuzumi::firmware::format {

inline constexpr std::uint32_t kMagic = 0x315A5355;      // "USZ1"
inline constexpr std::uint32_t kByteOrderMark = 0x01020304;
inline constexpr std::uint16_t kVersionMajor = 1, kVersionMinor = 1;
inline constexpr std::uint32_t kAbsent = 0xFFFFFFFF;     // an offset or number that is not there
/// Bounds of the format; a file beyond them is refused.
inline constexpr std::uint32_t kMaxFileBytes = 0x40000000;
inline constexpr std::uint32_t kMaxMeshes = 65535;
inline constexpr std::uint32_t kMaxTextureSize = 4096;   // texels each way

struct Header {                    // 32 bytes at offset 0
  std::uint32_t magic = kMagic;
  std::uint32_t byte_order = kByteOrderMark;
  std::uint16_t version_minor = kVersionMinor, version_major = kVersionMajor;  // another major is refused
  std::uint32_t flags = 0;         // none defined; must be 0
  std::uint32_t file_bytes = 0;    // of the whole file, header included; a multiple of 4
  std::uint32_t crc32 = 0;         // CRC-32/ISO-HDLC of bytes 24 .. file_bytes-1
  std::uint32_t section_count = 0;
  std::uint32_t reserved = 0;
};
static_assert(sizeof(Header) == 32);

enum class SectionType : std::uint32_t {  // four letters, first in the low byte
  kRecords = 0x44434552,                  // "RECD": the bare layout, mesh-max first
  kMeshes = 0x4448534D,                   // "MSHD": one MeshDescriptor per record, same order
  kIndices = 0x58444E49,                  // "INDX"
  kNormals = 0x4C4D524E,                  // "NRML"
  kColours = 0x524C4F43,                  // "COLR"
  kNames = 0x454D414E,                    // "NAME"
  kBoard = 0x44524F42,                    // "BORD": the name of the only board it is for, padded with zeros
  // Since 1.1:
  kTextureCoordinates = 0x4F435854,       // "TXCO": TexCoord per vertex
  kMaterials = 0x4C54414D,                // "MATL": Material after Material
  kTextures = 0x54584554,                 // "TEXT": Texture after Texture
  kTexels = 0x4C455854,                   // "TXEL": the textures' images
  kMethods = 0x4854454D,                  // "METH": settings of thinning methods
  kEdgeValues = 0x56474445,               // "EDGV": f32 per vertex
  kLayers = 0x5259414C,                   // "LAYR": chains of layers
  kGroups = 0x50555247,                   // "GRUP": materials of meshes that have several
  kSolids = 0x444C4F53,                   // "SOLD": solids (firmware/solids/solid_format.h)
};

struct Section {                   // 16 bytes each, from offset 32
  SectionType type{};
  std::uint32_t offset = 0;        // from the file's start; a multiple of 4
  std::uint32_t bytes = 0;         // a multiple of 4
  std::uint32_t reserved = 0;
};
static_assert(sizeof(Section) == 16);

enum class Topology : std::uint32_t { kStrip = 0, kList = 1, kFan = 2, kIndexed = 3 };
/// kMillionths: of the mesh's own faces.
enum class QuotaKind : std::uint32_t { kNone = 0, kFaces = 1, kMillionths = 2 };
/// The numbers of firmware::Method (simplify.h).
enum class Method : std::uint32_t { kQem = 0, kEdgeRemoval = 1, kHalfEdge = 2, kVertexDeletion = 3 };

inline constexpr std::uint32_t kFlagTelltale = 1;  // never dropped, whatever memory or policy say
inline constexpr std::uint32_t kFlagTwoSided = 2;  // drawn without culling
inline constexpr std::uint32_t kFlagGroups = 4;    // several materials, see MeshDescriptor::material; since 1.1

struct MeshDescriptor {            // 80 bytes
  std::uint32_t record_offset = 0; // of the record's vertex-count word, from the file's start
  Topology topology = Topology::kIndexed;
  std::uint32_t index_offset = kAbsent;   // from the file's start; kIndexed only
  std::uint32_t index_count = 0;          // 3 per face
  std::uint32_t index_bytes = 0;          // 2 or 4
  std::uint32_t normal_offset = kAbsent;  // PackedNormal per vertex
  std::uint32_t colour_offset = kAbsent;  // Rgba8 per vertex
  std::uint32_t base_colour = 0xFFFFFFFF; // Rgba8, where there are no vertex colours
  QuotaKind quota_kind = QuotaKind::kNone;
  std::uint32_t quota = 0;
  float area_threshold_px = -1;           // < 0: none
  Method method = Method::kQem;
  std::uint32_t flags = 0;
  std::uint32_t name_offset = kAbsent;    // into section NAME, from the file's start; UTF-8, no terminator
  std::uint32_t name_bytes = 0;
  std::uint32_t texture_coordinate_offset = kAbsent;  // TexCoord per vertex
  // Number in section MATL; with kFlagGroups, offset in section GRUP of the number of groups and the FaceGroups.
  std::uint32_t material = kAbsent;
  // Since 1.1; 0 where absent, as it stands in files of 1.0.
  std::uint32_t method_settings_offset = 0;  // the 40 bytes of the method's settings (simplify.h), in section METH
  std::uint32_t edge_value_offset = 0;       // f32 per vertex, in section EDGV; see EdgeRemovalSettings in simplify.h
  std::uint32_t layer_offset = 0;            // the mesh's chain of layers, in section LAYR
};
static_assert(sizeof(MeshDescriptor) == 80);

/// kOpaque: alpha is ignored. kMask: drawn where alpha reaches the reference. kBlend: laid over what is there; such
/// meshes are drawn after all others.
enum class AlphaMode : std::uint32_t { kOpaque = 0, kMask = 1, kBlend = 2 };

struct Material {                          // 32 bytes; the base colour is the mesh descriptor's
  std::uint32_t texture = kAbsent;         // number in section TEXT
  std::uint32_t filter = 1;                // numbers of command::TextureFilter
  std::uint32_t wrap_s = 0, wrap_t = 0;    // numbers of command::TextureWrap
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  std::uint32_t alpha_reference = 128;     // 0..255, kMask
  std::uint32_t reserved[2] = {};          // must be 0
};
static_assert(sizeof(Material) == 32);

/// One of several materials on one kIndexed mesh: faces and vertices from the ends of the group before to these. Groups
/// share no vertex; the last ends at the mesh's counts.
struct FaceGroup {                         // 16 bytes
  std::uint32_t face_end = 0;
  std::uint32_t vertex_end = 0;
  std::uint32_t material = kAbsent;        // number in section MATL
  std::uint32_t base_colour = 0xFFFFFFFF;  // Rgba8, in place of the descriptor's
};
static_assert(sizeof(FaceGroup) == 16);

struct Texture {                           // 32 bytes; read as command::SetTexture says
  std::uint32_t texel_offset = 0;          // from the file's start, in section TXEL; a multiple of 4
  std::uint32_t format = 0;                // numbers of command::TextureFormat, not kNone
  std::uint32_t width = 0, height = 0;     // 1..4096
  std::uint32_t level_count = 1;
  std::uint32_t name_offset = kAbsent;     // into section NAME
  std::uint32_t name_bytes = 0;
  std::uint32_t reserved = 0;              // must be 0
};
static_assert(sizeof(Texture) == 32);

}  // namespace usuzumi::firmware::format
