// Everything that has a golden: the scenes as the software engine draws them, and the runs as the panel shows them.
#pragma once

#include <functional>
#include <vector>

#include "sim/image/image.h"

namespace usuzumi::golden {

struct Subject {
  const char* name;
  const char* note;
  std::function<sim::Image()> draw;  // throws std::runtime_error where that does not go well
};

std::vector<Subject> all_subjects();

}  // namespace usuzumi::golden
