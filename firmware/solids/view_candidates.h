// View candidates: directions from a solid's origin to where a viewer may stand, and which is nearest (Shindo et al.,
// chapter 3).
#pragma once

#include <cstdint>
#include <span>

#include "firmware/solids/solid_format.h"
#include "firmware/solids/solid_placement.h"
#include "hal/vec.h"

namespace usuzumi::firmware {

inline constexpr float kHalfRoot = 0.70710678f;
/// The default 18 of fig. 2, unit length, in a solid's own coordinates: the six axes E0 to E5, then the middles of a
/// cube's twelve edges. The paper leaves their order within either open; ours is that of the axes.
inline constexpr Vec3 kDefaultCandidates[] = {
    {1, 0, 0},
    {-1, 0, 0},
    {0, 1, 0},
    {0, -1, 0},
    {0, 0, 1},
    {0, 0, -1},
    {kHalfRoot, kHalfRoot, 0},
    {-kHalfRoot, kHalfRoot, 0},
    {kHalfRoot, -kHalfRoot, 0},
    {-kHalfRoot, -kHalfRoot, 0},
    {kHalfRoot, 0, kHalfRoot},
    {-kHalfRoot, 0, kHalfRoot},
    {kHalfRoot, 0, -kHalfRoot},
    {-kHalfRoot, 0, -kHalfRoot},
    {0, kHalfRoot, kHalfRoot},
    {0, -kHalfRoot, kHalfRoot},
    {0, kHalfRoot, -kHalfRoot},
    {0, -kHalfRoot, -kHalfRoot},
};

/// Eqs. (2), (5): bit i is set where a face of this normal may be seen from candidate i, as M[i] = S . E[i] is not
/// below zero. Both in the solid's own coordinates.
std::uint32_t candidates_that_see(Vec3 face_normal, std::span<const Vec3> candidates);

/// Eqs. (3), (4): the first of the candidates with the largest V[i] = P . F[i], where P is `to_viewer`, in the model's
/// coordinates, and F[i] the candidate placed in the model, at unit length.
std::uint32_t nearest_candidate(Vec3 to_viewer, const SolidPlacement& placement, std::span<const Vec3> candidates);

}  // namespace usuzumi::firmware
