// The thinning policies as words on the command line.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware/drawing_data/drawing_data.h"
#include "firmware/thinning/policy.h"

namespace usuzumi::sim {

struct NamedMesh {
  std::string name;
  firmware::Level level = firmware::Level::kUnset;
};
std::vector<NamedMesh> named_meshes(const firmware::DrawingData& data);

/// Policies of levels 2 and 3, with the mesh numbers that the chosen ones refer to.
class PolicyOptions {
 public:
  /// Each of `words` is [2=|3=]POLICY, without a level for both:
  ///   always | below-area:PIXELS | chosen:NAME[,NAME...] | random:SHARE%[:SEED]
  /// Names as matches_name() takes them. Throws Error kUsage, also where a level would get two policies.
  PolicyOptions(std::span<const std::string> words, const firmware::DrawingData& data);

  void apply(firmware::ThinningSettings& settings) const;
  /// A line for each word, or name in one, that changes nothing for these drawing data.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  struct ForLevel {
    std::string word;  // that gave it; empty: none
    firmware::Policy policy;
    std::vector<std::uint32_t> chosen;
  };

  void parse(const std::string& word, std::span<const NamedMesh> meshes);
  static void set(ForLevel& level, const char* number, const ForLevel& given);

  ForLevel delete_, collapse_;
  std::vector<std::string> notes_;
};

}  // namespace usuzumi::sim
