// Everything that has a golden: the scenes as the software engine draws them, and the runs as the panel shows them.
#pragma once

#include <functional>
#include <vector>

#include "sim/image/image.h"
#include "tests/golden/golden_store.h"

namespace usuzumi::golden {

struct Drawn {
  sim::Image picture;          // for the PNG
  std::vector<Entry> entries;  // for the manifest
};

struct Subject {
  const char* name;
  const char* note;
  std::vector<Exclusion> exclusions;
  std::function<Drawn()> draw;  // throws std::runtime_error where that does not go well
};

std::vector<Subject> all_subjects();

}  // namespace usuzumi::golden
