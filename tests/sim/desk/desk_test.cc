#include "sim/desk/desk.h"

#include <gtest/gtest.h>

#include "sim/common/error.h"
#include "tests/support/desk_request.h"
#include "tests/support/thinning_bench.h"

namespace usuzumi {
namespace {

using sim::Desk;
using sim::DeskConfig;
using sim::Error;
using testing::container_rom;
using testing::hills;
using testing::request_for;
using testing::RomImage;
using testing::square;

RomImage scene_rom() {
  auto ground = hills(16, 3);
  auto lamp = square(0.3f, 1, 0.6f);
  lamp.colours = {rgba8(255, 0, 0), rgba8(0, 255, 0), rgba8(0, 0, 255), rgba8(255, 255, 0)};
  lamp.flags = firmware::format::kFlagTwoSided;
  return container_rom({ground, lamp, square(0.05f, 2, 0.7f)});
}

DeskConfig config(std::uint32_t width = 320, std::uint32_t height = 192) {
  DeskConfig c;
  c.width = width;
  c.height = height;
  return c;
}

TEST(DeskTest, PanelVramAndSignatureUnitAgreeOnThePicture) {
  const RomImage rom = scene_rom();
  for (const bool small : {false, true}) {
    DeskConfig c = config();
    if (small) c.board = sim::small_board();
    Desk desk(c, rom.bytes(), "scene");
    for (int i = 0; i < 4; ++i) {
      const auto shown = desk.draw(request_for(desk, 0.3 + i));
      EXPECT_EQ(shown.picture.width, 320u);
      EXPECT_EQ(shown.picture.height, 192u);
      EXPECT_EQ(shown.record.crc32, shown.record.panel_crc32);
      const sim::Image in_vram = desk.picture_in_vram();
      EXPECT_EQ(picture_crc32(in_vram), shown.record.crc32) << "frame " << i << (small ? ", RGB565" : "");
    }
  }
}

TEST(DeskTest, ThePictureShowsModelAndBackground) {
  const RomImage rom = scene_rom();
  Desk desk(config(), rom.bytes(), "scene");
  const auto shown = desk.draw(request_for(desk));
  EXPECT_EQ(shown.picture.at(0, 0), 0x0A141Eu);
  std::size_t model = 0;
  for (std::uint32_t v : shown.picture.xrgb) model += v != 0x0A141Eu ? 1 : 0;
  EXPECT_GT(model, shown.picture.xrgb.size() / 8);
  EXPECT_LT(model, shown.picture.xrgb.size());
}

TEST(DeskTest, TwoRunsTakeTheSameVirtualTimeWhateverTheThreads) {
  const RomImage rom = scene_rom();
  DeskConfig two_threads = config();
  two_threads.threads = 2;
  Desk a(config(), rom.bytes(), "a"), b(two_threads, rom.bytes(), "b");
  for (int i = 0; i < 3; ++i) {
    const auto ra = a.draw(request_for(a, i)).record, rb = b.draw(request_for(b, i)).record;
    EXPECT_EQ(ra.crc32, rb.crc32);
    EXPECT_EQ(ra.firmware.thin_ns, rb.firmware.thin_ns);
    EXPECT_EQ(ra.firmware.draw_ns, rb.firmware.draw_ns);
    EXPECT_EQ(ra.firmware.wait_ns, rb.firmware.wait_ns);
    EXPECT_EQ(a.machine().now_cycles(), b.machine().now_cycles());
  }
}

TEST(DeskTest, RomIsUnchangedByARun) {
  const RomImage rom = scene_rom();
  Desk desk(config(), rom.bytes(), "scene");
  const std::uint32_t before = desk.machine().rom_crc32();
  for (int i = 0; i < 3; ++i) desk.draw(request_for(desk, i));
  EXPECT_EQ(desk.machine().rom_crc32(), before);
  EXPECT_EQ(before, crc32(kCrc32Start, rom.bytes()));
}

TEST(DeskTest, TheFirmwareMakesNoGuestErrors) {
  const RomImage rom = scene_rom();
  Desk desk(config(), rom.bytes(), "scene");
  for (int i = 0; i < 3; ++i) desk.draw(request_for(desk, i));
  EXPECT_EQ(desk.machine().guest_log().mistakes(), 0u);
  EXPECT_EQ(desk.machine().guest_log().unimplemented(), 0u);
}

TEST(DeskTest, AHungEngineEndsInASentenceNotInAHang) {
  const RomImage rom = scene_rom();
  DeskConfig c = config();
  c.faults.engine_hangs = true;
  Desk desk(c, rom.bytes(), "scene");
  try {
    desk.draw(request_for(desk));
    FAIL() << "a hung engine drew";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), sim::ExitCode::kDevice);
    EXPECT_NE(std::string(e.what()).find("engine"), std::string::npos) << e.what();
  }
}

TEST(DeskTest, ABusTooSlowForTheDisplayIsSeenInThePictureAndInTheStatus) {
  const RomImage rom = scene_rom();
  DeskConfig slow = config(800, 480);
  slow.faults.bus_slowdown = 50;  // 64 MB a second for a picture that takes 92
  slow.pins = {{0, "ignition", true}};
  Desk starved(slow, rom.bytes(), "scene"), sound(config(800, 480), rom.bytes(), "scene");
  const auto bad = starved.draw(request_for(starved)), good = sound.draw(request_for(sound));
  EXPECT_EQ(bad.record.shown, firmware::Shown::kSafePicture);
  EXPECT_NE(bad.record.fault.find("FIFO"), std::string::npos) << bad.record.fault;
  EXPECT_NE(bad.record.crc32, good.record.crc32);
  EXPECT_EQ(bad.record.crc32, bad.record.panel_crc32);
  EXPECT_GT(starved.machine().display().starved_lines(), 0u);
  slow.pins.reset();
  Desk unwatched(slow, rom.bytes(), "scene");
  EXPECT_THROW(unwatched.draw(request_for(unwatched)), Error) << "nobody asked for a fault";
  EXPECT_EQ(sound.machine().display().starved_lines(), 0u);
}

TEST(DeskTest, RefusesDrawingDataThatIsNotSound) {
  RomImage rom = scene_rom();
  rom[100] ^= 1;
  try {
    Desk desk(config(), rom.bytes(), "bad.rom");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), sim::ExitCode::kBadInput);
    EXPECT_EQ(std::string(e.what()).find("bad.rom: CRC-32"), 0u) << e.what();
  }
}

TEST(DeskTest, DrawsAModelAsLargeAndAsSmallAsCoordinatesGo) {
  for (const float size : {1e8f, 1e-15f}) {
    auto ground = hills(16, 3);
    for (Vec3& p : ground.positions) p = {p.x * size, p.y * size, p.z * size};
    Desk desk(config(), container_rom({ground}).bytes(), "far");
    const auto shown = desk.draw(request_for(desk));
    EXPECT_EQ(shown.record.firmware.thinning.faces_out, 256u) << size;
    std::size_t model = 0;
    for (std::uint32_t v : shown.picture.xrgb) model += v != 0x0A141Eu ? 1 : 0;
    EXPECT_GT(model, shown.picture.xrgb.size() / 8) << size;
  }
}

TEST(DeskTest, RefusesAPictureThatVramCannotHold) {
  const RomImage rom = scene_rom();
  DeskConfig c = config(1920, 720);
  c.board = sim::small_board();
  try {
    Desk desk(c, rom.bytes(), "scene");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), sim::ExitCode::kDevice);
    EXPECT_NE(std::string(e.what()).find("VRAM is too small"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace usuzumi
