// The thinning policies as words on the command line.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/thinning/policy.h"

namespace usuzumi::sim {

/// Policies of levels 2 and 3, with the mesh numbers that the chosen ones refer to.
class PolicyOptions {
 public:
  /// Each of `words` is [2=|3=]POLICY, without a level for both:
  ///   always | below-area:PIXELS | chosen:NAME[,NAME...] | random:SHARE%[:SEED]
  /// Names may have the wildcards * and ?. Throws Error kUsage.
  PolicyOptions(std::span<const std::string> words, const firmware::DrawingData& data);

  void apply(firmware::ThinningSettings& settings) const;

 private:
  void parse(const std::string& word, const firmware::DrawingData& data);

  firmware::Policy delete_policy_, collapse_policy_;
  std::vector<std::uint32_t> chosen_for_delete_, chosen_for_collapse_;
};

}  // namespace usuzumi::sim
