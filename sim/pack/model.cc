#include "sim/pack/model.h"

namespace usuzumi::sim {

Tags merge_tags(const Tags& over, const Tags& under) {
  Tags merged = over;
  if (!merged.level) merged.level = under.level;
  if (!merged.quota) merged.quota = under.quota;
  if (!merged.area_threshold_px) merged.area_threshold_px = under.area_threshold_px;
  if (!merged.telltale) merged.telltale = under.telltale;
  if (!merged.method) merged.method = under.method;
  if (!merged.settings) merged.settings = under.settings;
  if (!merged.regions) merged.regions = under.regions;
  if (!merged.layers) merged.layers = under.layers;
  return merged;
}

}  // namespace usuzumi::sim
