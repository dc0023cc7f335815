#include "firmware/simplify/qem/edge_candidates.h"

namespace usuzumi::firmware {

void EdgeCandidates::begin_fill() {
  horizon_ = kEdgeKeyMax;
  count_ = 0;
}

void EdgeCandidates::halve() {
  horizon_ = key_of_rank(count_ / 2);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    slots_[kept] = slots_[i];  // stored in any case: which are kept is as good as random, so no branch
    kept += slots_[i] < horizon_ ? 1u : 0u;
  }
  count_ = kept;
}

// Digit by digit from the highest, without moving anything: the first digits are the exponents of costs, and mostly one
// or two more find the key.
EdgeKey EdgeCandidates::key_of_rank(std::size_t rank) const {
  if (rank >= count_) return horizon_;
  constexpr int kMostDigitBits = 10;
  const int digit_bits = count_ < 4096 ? 8 : kMostDigitBits;  // few keys are not worth many counters
  EdgeKey prefix = 0;
  int known_below = 64;  // bits from here up are known
  while (known_below > 0) {
    const int shift = known_below > digit_bits ? known_below - digit_bits : 0;
    const EdgeKey digits = (EdgeKey{1} << (known_below - shift)) - 1;
    std::uint32_t counts[1u << kMostDigitBits];
    for (EdgeKey d = 0; d <= digits; ++d) counts[d] = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      // One shift by 64 would be undefined; the first digit has no prefix to agree with.
      const bool agrees = known_below == 64 || (slots_[i] ^ prefix) >> known_below == 0;
      counts[(slots_[i] >> shift) & digits] += agrees ? 1u : 0u;
    }
    EdgeKey digit = 0;
    while (rank >= counts[digit]) rank -= counts[digit++];
    prefix |= digit << shift;
    known_below = shift;
    if (counts[digit] == 1 && shift > 0) {  // one key is left; it is read off
      for (std::size_t i = 0; i < count_; ++i)
        if ((slots_[i] ^ prefix) >> shift == 0) return slots_[i];
    }
  }
  return prefix;
}

std::size_t EdgeCandidates::take(EdgeKey limit, std::span<EdgeKey> batch) {
  std::size_t taken = 0;
  for (; read_ < count_ && taken < batch.size(); ++read_) {
    const EdgeKey key = slots_[read_];
    batch[taken] = key;
    slots_[write_] = key;
    const std::size_t is_taken = key < limit ? 1u : 0u;
    taken += is_taken;
    write_ += 1 - is_taken;
  }
  if (taken == 0) count_ = write_;  // the pass has ended
  return taken;
}

}  // namespace usuzumi::firmware
