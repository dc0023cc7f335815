#include "boards/linux-arm64/mapped_memory.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "boards/linux-arm64/memory_map.h"

namespace usuzumi::linux_arm64 {
namespace {

std::string file_with(const std::string& text) {
  const std::string path = ::testing::TempDir() + "usuzumi-mapped-memory-test.rom";
  std::ofstream(path) << text;
  return path;
}

TEST(MappedMemory, GivesWhatTheMemoryMapSays) {
  MappedMemory memory;
  ASSERT_EQ(memory.map(), 0);
  const boards::BoardMemory& m = memory.memory();
  EXPECT_EQ(m.ram.base, 0x1000'0000u);
  EXPECT_EQ(m.ram.bytes.size(), 32u << 20);
  EXPECT_EQ(m.vram.base, 0x2000'0000u);
  EXPECT_EQ(m.vram.bytes.size(), 32u << 20);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(m.vram.bytes.data()) % 4096, 0u) << "the display maps pages over it";
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(m.engine_work.data()) % 64, 0u);
  EXPECT_EQ(m.engine_work.size(), 16u << 20);
  m.ram.bytes.back() = m.vram.bytes.back() = m.engine_work.back() = std::byte{1};
}

TEST(MappedMemory, TheFileIsTheRomAndNotToBeWritten) {
  const std::string path = file_with("drawing data");
  MappedMemory memory;
  ASSERT_EQ(memory.map(), 0);
  ASSERT_EQ(memory.map_rom(path.c_str()), 0);
  const MemoryRegion& rom = memory.memory().rom;
  EXPECT_EQ(rom.base, 0x4000'0000u);
  EXPECT_FALSE(rom.writable);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(rom.bytes.data()), rom.bytes.size()), "drawing data");
}

TEST(MappedMemory, WithoutAFileTheRomIsEmpty) {
  MappedMemory memory;
  ASSERT_EQ(memory.map(), 0);
  EXPECT_EQ(memory.map_rom("/nowhere/a.rom"), ENOENT);
  EXPECT_EQ(memory.map_rom("/"), EISDIR);
  EXPECT_EQ(memory.map_rom(file_with("").c_str()), 0);
  EXPECT_TRUE(memory.memory().rom.bytes.empty());
}

TEST(MappedMemory, APipeOrADeviceIsRefusedAtOnce) {
  const std::string path = ::testing::TempDir() + "usuzumi-mapped-memory-test.fifo";
  std::filesystem::remove(path);
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  MappedMemory memory;
  ASSERT_EQ(memory.map(), 0);
  alarm(10);  // an opening that waits for a writer ends the test
  EXPECT_EQ(memory.map_rom(path.c_str()), EMEDIUMTYPE);
  EXPECT_EQ(memory.map_rom("/dev/zero"), EMEDIUMTYPE);
  alarm(0);
  EXPECT_TRUE(memory.memory().rom.bytes.empty());
  std::filesystem::remove(path);
}

TEST(MappedMemory, AFileThatTheBusCannotHoldIsRefused) {
  const std::string path = file_with("");
  std::filesystem::resize_file(path, kMostRomBytes + 1);  // a hole: takes no room on the disk
  MappedMemory memory;
  ASSERT_EQ(memory.map(), 0);
  EXPECT_EQ(memory.map_rom(path.c_str()), EFBIG);
  EXPECT_TRUE(memory.memory().rom.bytes.empty());
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace usuzumi::linux_arm64
