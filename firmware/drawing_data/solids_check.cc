#include "firmware/drawing_data/solids_check.h"

#include <cmath>
#include <cstddef>

#include "firmware/simplify/bounds.h"
#include "firmware/solids/solid_placement.h"

namespace usuzumi::firmware {
namespace {

using format::Solid;
using format::SolidsHeader;

constexpr auto kHeaderBytes = static_cast<std::uint32_t>(sizeof(SolidsHeader));
constexpr auto kSolidBytes = static_cast<std::uint32_t>(sizeof(Solid));
constexpr std::uint32_t kCandidateBytes = 12;

bool between(std::uint32_t n, std::uint32_t least, std::uint32_t most) { return n >= least && n <= most; }

bool detail_is_sound(const format::SolidDetail& d) {
  bool sound = true;
  for (std::uint32_t m = 0; m < format::kFacedMembers; ++m)
    sound = sound && between(d.sphere_around[m], 3, format::kMaxAround) &&
            between(d.sphere_rows[m], 2, format::kMaxRows) && between(d.hemisphere_around[m], 3, format::kMaxAround) &&
            between(d.hemisphere_rows[m], 1, format::kMaxRows) && between(d.round_sides[m], 3, format::kMaxAround);
  return sound;
}

Status check_solid(const Solid& solid, const Sections& sections, std::uint32_t at) {
  if (static_cast<std::uint32_t>(solid.kind) >= format::kSolidKindCount)
    return damaged("solid is of no known kind, at byte offset", at);
  if (!has_sound_sizes(solid))
    return damaged("solid has a size below 1e-6 or above 1e8, or one that its kind has not, at byte offset",
                   at + static_cast<std::uint32_t>(offsetof(Solid, size)));
  if (!is_placed_soundly(solid))
    return damaged("solid is placed flat, shrunk below 1e-6, or beyond 1e8 or -1e8, at byte offset",
                   at + static_cast<std::uint32_t>(offsetof(Solid, to_model)));
  if (!sections.names.holds_text(solid.name_offset, solid.name_bytes))
    return damaged("name lies outside section NAME, in the solid at byte offset", at);
  return ok_status();
}

}  // namespace

SolidsView solids_of(const Words& words, const Sections& sections) {
  const Range& section = sections.solids;
  if (section.bytes() == 0) return {};
  const auto header = words.object<SolidsHeader>(section.begin);
  const std::uint32_t candidates = section.begin + kHeaderBytes;
  return {header.detail, words.array<Vec3>(candidates, header.candidate_count),
          words.array<Solid>(candidates + header.candidate_count * kCandidateBytes, header.solid_count)};
}

Status check_solids(const Words& words, const Sections& sections) {
  const Range& section = sections.solids;
  if (section.end == 0) return ok_status();
  if (section.bytes() < kHeaderBytes) return damaged("section SOLD is cut off, at byte offset", section.begin);
  const auto header = words.object<SolidsHeader>(section.begin);
  if (!between(header.solid_count, 1, format::kMaxSolids) ||
      !between(header.candidate_count, 1, format::kMaxViewCandidates) ||
      kHeaderBytes + std::uint64_t{header.candidate_count} * kCandidateBytes +
              std::uint64_t{header.solid_count} * kSolidBytes !=
          section.bytes())
    return damaged("section SOLD does not have the solids and view candidates that it promises, at byte offset",
                   section.begin);
  if (!detail_is_sound(header.detail) || header.reserved != 0)
    return damaged("section SOLD divides curved surfaces into too few or too many faces, at byte offset",
                   section.begin + static_cast<std::uint32_t>(offsetof(SolidsHeader, detail)));
  const SolidsView view = solids_of(words, sections);
  std::uint32_t at = section.begin + kHeaderBytes;
  for (const Vec3 candidate : view.candidates) {
    constexpr float kRounding = 1e-3f;
    const float l = length(candidate);
    if (!(std::fabs(l - 1) <= kRounding)) return damaged("view candidate is not of unit length, at byte offset", at);
    at += kCandidateBytes;
  }
  for (const Solid& solid : view.solids) {
    const Status status = check_solid(solid, sections, at);
    if (!status.ok()) return status;
    at += kSolidBytes;
  }
  return ok_status();
}

}  // namespace usuzumi::firmware
