#include "boards/linux-arm64/changed_lines.h"

#include <gtest/gtest.h>

namespace usuzumi::linux_arm64 {
namespace {

TEST(ChangedLines, AFramesNumbersAreNoNews) {
  ChangedLines lines;
  EXPECT_TRUE(lines.is_news("frame 0 picture thinned light=1 crc32=00000001 faces=9->5\n"));
  EXPECT_FALSE(lines.is_news("frame 1 picture thinned light=1 crc32=00000002 faces=8->4\n"));
  EXPECT_FALSE(lines.is_news("frame 10 picture thinned light=1 crc32=00000002 faces=8->4\n"));
  EXPECT_FALSE(lines.is_news("frame 11 picture thinned light=1 meshes=5->4 faces=8->4\n")) << "without a signature";
  EXPECT_FALSE(lines.is_news("frame 12 picture thinned light=1 meshes=5->3 faces=8->3\n"));
  EXPECT_TRUE(lines.is_news("frame 13 picture budget light=1 meshes=5->3 faces=8->3\n"));
}

TEST(ChangedLines, WhatIsShownModeLightAndFaultAre) {
  ChangedLines lines;
  EXPECT_TRUE(lines.is_news("frame 0 picture thinned light=1 crc32=00000001\n"));
  EXPECT_TRUE(lines.is_news("frame 1 picture budget light=1 crc32=00000001\n"));
  EXPECT_TRUE(lines.is_news("frame 2 dark budget light=0 crc32=00000001\n"));
  EXPECT_TRUE(lines.is_news("frame 3 safe budget light=1 crc32=00000001 fault=\"a\"\n"));
  EXPECT_TRUE(lines.is_news("frame 4 safe budget light=1 crc32=00000001 fault=\"b\"\n"));
  EXPECT_FALSE(lines.is_news("frame 5 safe budget light=1 crc32=00000002 fault=\"b\"\n"));
  EXPECT_TRUE(lines.is_news("frame 6 safe budget light=1 crc32=00000002\n"));
}

TEST(ChangedLines, OtherLinesAlwaysAre) {
  ChangedLines lines;
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(lines.is_news("error: display: no card\n"));
    EXPECT_TRUE(lines.is_news("boot 800x480\n"));
    EXPECT_TRUE(lines.is_news("\n"));
  }
  EXPECT_TRUE(lines.is_news("frame 1")) << "a line cut short is no reason to read behind its end";
}

}  // namespace
}  // namespace usuzumi::linux_arm64
