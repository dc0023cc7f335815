#include "boards/common/text_line.h"

#include <gtest/gtest.h>

#include <string>

namespace usuzumi::boards {
namespace {

TEST(TextLine, IsPutTogetherFromTextAndNumbers) {
  TextLine line;
  line.text("frame ").number(0).text(" crc32=").hex(0xAB).text(" at ").number(18'446'744'073'709'551'615u);
  EXPECT_EQ(line.finish(), "frame 0 crc32=000000ab at 18446744073709551615\n");
}

TEST(TextLine, WhatDoesNotFitIsLeftOutAndTheLineStillEnds) {
  TextLine line;
  for (int i = 0; i < 100; ++i) line.text("0123456789");
  const std::string_view finished = line.finish();
  EXPECT_EQ(finished.size(), TextLine::kCapacity);
  EXPECT_TRUE(finished.starts_with("0123456789"));
  EXPECT_EQ(finished.back(), '\n');
}

}  // namespace
}  // namespace usuzumi::boards
