#include "tests/study/contact_sheet.h"

#include <algorithm>

namespace usuzumi::study {

sim::Image contact_sheet(std::span<const sim::Image> pictures, std::uint32_t columns, std::uint32_t gap,
                         std::uint32_t rgb) {
  const auto count = static_cast<std::uint32_t>(pictures.size());
  const std::uint32_t across = std::min(columns, count), down = (count + columns - 1) / columns;
  const std::uint32_t width = pictures[0].width, height = pictures[0].height;
  sim::Image sheet(across * (width + gap) - gap, down * (height + gap) - gap, rgb);
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t y = 0; y < height; ++y)
      for (std::uint32_t x = 0; x < width; ++x)
        sheet.at(i % columns * (width + gap) + x, i / columns * (height + gap) + y) = pictures[i].at(x, y);
  return sheet;
}

}  // namespace usuzumi::study
