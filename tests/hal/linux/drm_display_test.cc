#include "hal/linux/drm_display.h"

#include <cerrno>
#include <cstring>
#include <drm_fourcc.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <sys/mman.h>

#include "tests/hal/linux/fake_kernel.h"

namespace usuzumi::linux_hal::testing {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

constexpr std::uint32_t kWidth = 64, kHeight = 48;
constexpr BusAddress kVramBase = 0x40000000;
constexpr std::size_t kVramBytes = 1 << 20;

class DrmDisplayTest : public ::testing::Test {
 protected:
  DrmDisplayTest() {
    void* const at = mmap(nullptr, kVramBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    vram_ = {static_cast<std::byte*>(at), kVramBytes};
    display_.emplace(kernel_);
  }
  ~DrmDisplayTest() override {
    display_.reset();
    munmap(vram_.data(), vram_.size());
  }

  DrmConfig config() {
    return {.card = nullptr, .width = kWidth, .height = kHeight, .vram = {kVramBase, vram_}, .flip_timeout_ms = 20};
  }

  Scanout scanout(command::PixelFormat format = command::PixelFormat::kXrgb8888) {
    Scanout s{kWidth, kHeight, format, display_->stride_bytes(kWidth, kHeight, format), {}};
    s.picture[0] = kVramBase + 0x10000;
    s.picture[1] = kVramBase + 0x20000;
    return s;
  }

  Status open_and_start() {
    const Status status = display_->open(config());
    return status.ok() ? display_->start(scanout()) : status;
  }

  /// Every pixel of picture `i`, as the CPU writes it.
  void fill(const Scanout& s, std::uint32_t i, std::uint8_t value) {
    std::memset(vram_.data() + (s.picture[i] - kVramBase), value, std::size_t{s.stride_bytes} * s.height);
  }

  FakeKernel kernel_;
  std::span<std::byte> vram_;
  std::optional<DrmDisplay> display_;
};

TEST_F(DrmDisplayTest, ShowsWhatTheCpuWroteIntoVramOnceThePageHasFlipped) {
  ASSERT_TRUE(display_->open(config()).ok());
  const Scanout s = scanout();
  EXPECT_EQ(s.stride_bytes, 256u);  // 64 pixels of 4 bytes, a whole unit of the card
  ASSERT_TRUE(display_->start(s).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0));
  EXPECT_EQ(kernel_.panel(4).size(), 64u * 48 * 4);
  fill(s, 0, 0x11);
  EXPECT_THAT(kernel_.panel(4), Each(0)) << "a picture is shown before show()";
  ASSERT_TRUE(display_->show(0).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0x11));
  fill(s, 1, 0x22);
  EXPECT_THAT(kernel_.panel(4), Each(0x11));
  ASSERT_TRUE(display_->show(1).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0x22));
  ASSERT_TRUE(display_->show(1).ok());
  EXPECT_EQ(kernel_.card.flips, 3u) << "a picture shown already waits for a blank all the same";
}

TEST_F(DrmDisplayTest, RowsAreAsLongAsTheCardWantsThem) {
  kernel_.card.stride_unit_bytes = 1024;
  ASSERT_TRUE(display_->open(config()).ok());
  EXPECT_EQ(display_->stride_bytes(kWidth, kHeight, command::PixelFormat::kXrgb8888), 1024u);
  EXPECT_EQ(kernel_.buffers() + kernel_.frame_buffers(), 0u) << "the trial's buffer is left behind";
  ASSERT_TRUE(display_->start(scanout()).ok());
  fill(scanout(), 0, 0x33);
  ASSERT_TRUE(display_->show(0).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0x33));
}

TEST_F(DrmDisplayTest, Rgb565IsOfferedOnlyWhereTheCardTakesIt) {
  ASSERT_TRUE(display_->open(config()).ok());
  EXPECT_EQ(display_->stride_bytes(kWidth, kHeight, command::PixelFormat::kRgb565), 0u);
  kernel_.card.formats.insert(DRM_FORMAT_RGB565);
  EXPECT_EQ(display_->stride_bytes(kWidth, kHeight, command::PixelFormat::kRgb565), 256u);
  ASSERT_TRUE(display_->start(scanout(command::PixelFormat::kRgb565)).ok());
  ASSERT_TRUE(display_->show(1).ok());
  EXPECT_EQ(kernel_.panel(2).size(), 64u * 48 * 2);
}

TEST_F(DrmDisplayTest, TheConsolesPictureComesBackAndNothingIsLeftBehind) {
  ASSERT_TRUE(open_and_start().ok());
  const Scanout s = scanout();
  ASSERT_TRUE(display_->show(0).ok());
  EXPECT_EQ(kernel_.mappings(), 2u);
  EXPECT_EQ(kernel_.buffers(), 3u);
  EXPECT_TRUE(kernel_.has_master());
  display_->release();
  EXPECT_TRUE(kernel_.as_before());
  fill(s, 0, 0x44);  // VRAM is memory still
  fill(s, 1, 0x44);
}

TEST_F(DrmDisplayTest, AScreenThatWasOffIsSwitchedOffAgain) {
  kernel_.card.shown_frame_buffer = 0;
  ASSERT_TRUE(open_and_start().ok());
  ASSERT_TRUE(display_->show(0).ok());
  EXPECT_NE(kernel_.card.shown_frame_buffer, 0u);
  display_.reset();
  EXPECT_EQ(kernel_.card.shown_frame_buffer, 0u);
  EXPECT_EQ(kernel_.open_files() + kernel_.buffers() + kernel_.frame_buffers() + kernel_.mappings(), 0u);
}

TEST_F(DrmDisplayTest, StartsAnewAfterRelease) {
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(open_and_start().ok());
    ASSERT_TRUE(display_->start(scanout()).ok()) << "a second start without release";
    ASSERT_TRUE(display_->show(0).ok());
    EXPECT_EQ(kernel_.buffers(), 3u);
    display_->release();
    EXPECT_TRUE(kernel_.as_before());
  }
}

TEST_F(DrmDisplayTest, ASizeThatTheDisplayHasNotIsRefusedWithTheSizesItHas) {
  DrmConfig wanted = config();
  wanted.width = 640;
  wanted.height = 480;
  const Status status = display_->open(wanted);
  EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
  EXPECT_STREQ(status.message,
               "display /dev/dri/card0 has no 640x480; it has 1024x768 64x48 800x600; sizes in all");
  EXPECT_EQ(status.where, 3u);
  EXPECT_TRUE(kernel_.as_before());
}

TEST_F(DrmDisplayTest, AnInterlacedModeIsNotTakenForThePicture) {
  for (drm_mode_modeinfo& mode : kernel_.card.connectors[0].modes) mode.flags = DRM_MODE_FLAG_INTERLACE;
  const Status status = display_->open(config());
  EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
  EXPECT_STREQ(status.message, "display /dev/dri/card0 has no 64x48; it has interlaced ones alone; sizes in all");
  EXPECT_EQ(status.where, 0u);
}

TEST_F(DrmDisplayTest, AListOfManySizesStaysOneShortLine) {
  kernel_.card.connectors[0].modes.clear();
  for (std::uint16_t i = 0; i < 120; ++i)
    kernel_.card.connectors[0].modes.push_back(mode_of(static_cast<std::uint16_t>(1000 + i), 1000));
  const Status status = display_->open(config());
  EXPECT_EQ(status.where, 120u);
  EXPECT_LE(std::strlen(status.message), StatusText::kCapacity);
  EXPECT_THAT(status.message, HasSubstr("; sizes in all"));
}

TEST_F(DrmDisplayTest, WithoutACardSaysWhereItLooked) {
  kernel_.card.path = "/dev/fb0";
  const Status status = display_->open(config());
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_THAT(status.message, HasSubstr("no card in /dev/dri"));
}

TEST_F(DrmDisplayTest, FindsACardOfAnyNumberAndTakesTheOneItIsTold) {
  kernel_.card.path = "/dev/dri/card7";
  ASSERT_TRUE(display_->open(config()).ok());
  EXPECT_STREQ(display_->card(), "/dev/dri/card7");
  DrmConfig other = config();
  other.card = "/dev/dri/card1";
  const Status status = display_->open(other);
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_THAT(status.message, HasSubstr("/dev/dri/card1: not there"));
  EXPECT_EQ(status.where, static_cast<std::uint32_t>(ENOENT));
  EXPECT_TRUE(kernel_.as_before());
}

TEST_F(DrmDisplayTest, WithNothingConnectedSaysSoWhateverTheNumberOfConnectors) {
  for (std::uint32_t connectors = 0; connectors <= 3; ++connectors) {
    kernel_.card.connectors.assign(connectors, {false, {}});
    const Status status = display_->open(config());
    EXPECT_EQ(status.code, StatusCode::kUnavailable);
    EXPECT_THAT(status.message, HasSubstr("display /dev/dri/card0: nothing is connected"));
    EXPECT_EQ(status.where, connectors);
    EXPECT_TRUE(kernel_.as_before());
  }
}

TEST_F(DrmDisplayTest, TheFirstConnectedConnectorOfTheSizeIsTaken) {
  const FakeConnector has_size = kernel_.card.connectors[0];
  kernel_.card.connectors = {{false, {}}, {true, {mode_of(1920, 1080)}}, has_size, has_size};
  ASSERT_TRUE(open_and_start().ok());
  EXPECT_EQ(kernel_.card.driven_connector, FakeCard::kFirstConnector + 2);
  ASSERT_TRUE(display_->show(0).ok());
}

TEST_F(DrmDisplayTest, ASizeThatNoConnectorHasIsRefusedWithTheSizesOfAll) {
  kernel_.card.connectors = {{true, {mode_of(1920, 1080), mode_of(800, 600)}}, {false, {mode_of(64, 48)}},
                             {true, {mode_of(800, 600), mode_of(480, 272)}}};
  const Status status = display_->open(config());
  EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
  EXPECT_STREQ(status.message, "display /dev/dri/card0 has no 64x48; it has 1920x1080 800x600 480x272; sizes in all");
  EXPECT_EQ(status.where, 3u);
  EXPECT_TRUE(kernel_.as_before());
}

struct Refusal {
  const char* name;
  unsigned long request;  // 0: open()
  int error;
  const char* words;
};

class DrmRefusalTest : public DrmDisplayTest, public ::testing::WithParamInterface<Refusal> {};

TEST_P(DrmRefusalTest, IsOneLineThatSaysWhatAndEverythingIsGivenBack) {
  const Refusal& refusal = GetParam();
  if (refusal.request == 0) kernel_.card.open_error = refusal.error;
  else kernel_.card.refusals[refusal.request] = refusal.error;
  const Status status = open_and_start();
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_EQ(status.where, static_cast<std::uint32_t>(refusal.error));
  EXPECT_THAT(status.message, HasSubstr("/dev/dri/card0"));
  EXPECT_THAT(status.message, HasSubstr(refusal.words));
  EXPECT_THAT(status.message, HasSubstr("; errno"));
  EXPECT_EQ(std::strchr(status.message, '\n'), nullptr);
  const std::string message = status.message;
  EXPECT_EQ(kernel_.buffers() + kernel_.frame_buffers() + kernel_.mappings(), 0u) << message;
  kernel_.card.refusals.clear();
  display_->release();
  EXPECT_TRUE(kernel_.as_before());
}

INSTANTIATE_TEST_SUITE_P(
    OfEachCall, DrmRefusalTest,
    ::testing::Values(Refusal{"OpenWithoutRights", 0, EACCES, "no permission; run as a member of its group (video)"},
                      Refusal{"OpenOfADeviceThatIsGone", 0, ENODEV, "the device is gone"},
                      Refusal{"AnotherMaster", DRM_IOCTL_SET_MASTER, EBUSY, "in use by another program"},
                      Refusal{"ACardWithoutModes", DRM_IOCTL_MODE_GETRESOURCES, EOPNOTSUPP, "no card that sets modes"},
                      Refusal{"AConnectorThatVanished", DRM_IOCTL_MODE_GETCONNECTOR, ENODEV, "a connector"},
                      Refusal{"NoMemoryForPictures", DRM_IOCTL_MODE_MAP_DUMB, ENOMEM, "no memory for pictures"},
                      Refusal{"TheModeByItsDriver", DRM_IOCTL_MODE_SETCRTC, EINVAL, "setting the mode: refused"},
                      Refusal{"TheModeForWantOfRights", DRM_IOCTL_MODE_SETCRTC, EACCES, "no other program shows"},
                      Refusal{"TheModeWhileBusy", DRM_IOCTL_MODE_SETCRTC, EBUSY, "in use by another program"}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(DrmDisplayTest, WithoutBuffersThereIsNoPictureFormat) {
  kernel_.card.refusals[DRM_IOCTL_MODE_ADDFB2] = EINVAL;
  ASSERT_TRUE(display_->open(config()).ok());
  EXPECT_EQ(display_->stride_bytes(kWidth, kHeight, command::PixelFormat::kXrgb8888), 0u);
  EXPECT_EQ(kernel_.buffers(), 0u);
}

TEST_F(DrmDisplayTest, AVerticalBlankThatDoesNotComeEndsTheWait) {
  ASSERT_TRUE(open_and_start().ok());
  kernel_.card.flips_arrive = false;
  const Status status = display_->show(0);
  EXPECT_EQ(status.code, StatusCode::kDeadlineExceeded);
  EXPECT_EQ(status.where, 20u);
  EXPECT_THAT(status.message, HasSubstr("no vertical blank came"));
  EXPECT_EQ(display_->show(1).code, StatusCode::kDeadlineExceeded) << "the first flip is pending still";
  // The panel recovers: the flip given up ends late, and the next goes through.
  kernel_.card.flips_arrive = true;
  fill(scanout(), 1, 0x55);
  ASSERT_TRUE(display_->show(1).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0x55));
}

TEST_F(DrmDisplayTest, AfterABlankThatCameLateEachShowReturnsWithItsOwnPicture) {
  ASSERT_TRUE(open_and_start().ok());
  const Scanout s = scanout();
  kernel_.card.flips_arrive = false;
  ASSERT_EQ(display_->show(0).code, StatusCode::kDeadlineExceeded);
  kernel_.vertical_blank();  // late: nobody waits for it any more
  kernel_.card.flips_arrive = true;
  for (std::uint32_t i = 1; i <= 6; ++i) {
    const auto value = static_cast<std::uint8_t>(0x10 + i);
    fill(s, i % 2, value);
    ASSERT_TRUE(display_->show(i % 2).ok());
    EXPECT_EQ(kernel_.panel(4)[0], value) << "show " << i << " returned while the other picture was being sent";
  }
}

TEST_F(DrmDisplayTest, ALateBlankAloneDoesNotEndTheWaitForTheNext) {
  ASSERT_TRUE(open_and_start().ok());
  kernel_.card.flips_arrive = false;
  ASSERT_EQ(display_->show(0).code, StatusCode::kDeadlineExceeded);
  kernel_.vertical_blank();
  EXPECT_EQ(display_->show(1).code, StatusCode::kDeadlineExceeded);
}

TEST_F(DrmDisplayTest, ACardWithoutPageFlipsIsSetAndFlushed) {
  ASSERT_TRUE(open_and_start().ok());
  kernel_.card.refusals[DRM_IOCTL_MODE_PAGE_FLIP] = ENOSYS;
  fill(scanout(), 1, 0x66);
  ASSERT_TRUE(display_->show(1).ok());
  EXPECT_THAT(kernel_.panel(4), Each(0x66));
  EXPECT_EQ(kernel_.card.flushes, 1u);
  kernel_.card.refusals[DRM_IOCTL_MODE_DIRTYFB] = ENOSYS;  // and one that knows nothing of flushing either
  EXPECT_TRUE(display_->show(0).ok());
}

TEST_F(DrmDisplayTest, ADisplayPulledOutIsUnavailable) {
  ASSERT_TRUE(open_and_start().ok());
  kernel_.card.refusals[DRM_IOCTL_MODE_PAGE_FLIP] = ENODEV;
  const Status status = display_->show(0);
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_THAT(status.message, HasSubstr("page flip: the device is gone"));
}

struct NoPictures {
  const char* name;
  unsigned long request;  // that is refused
  int error;
  command::PixelFormat format;
  StatusCode code;
  const char* message;
};

class DrmNoPicturesTest : public DrmDisplayTest, public ::testing::WithParamInterface<NoPictures> {};

TEST_P(DrmNoPicturesTest, StartSaysWhyAndNothingIsLeftBehind) {
  const NoPictures& p = GetParam();
  ASSERT_TRUE(display_->open(config()).ok());
  kernel_.card.refusals[p.request] = p.error;
  const Scanout s = scanout(p.format);
  ASSERT_EQ(s.stride_bytes, 0u);
  const Status status = display_->start(s);
  EXPECT_EQ(status.code, p.code);
  EXPECT_STREQ(status.message, p.message);
  EXPECT_EQ(status.where, static_cast<std::uint32_t>(p.error));
  EXPECT_EQ(kernel_.buffers() + kernel_.frame_buffers() + kernel_.mappings(), 0u);
  EXPECT_EQ(kernel_.card.crtc_settings, 0u) << "the panel was touched";
  display_->release();
  EXPECT_TRUE(kernel_.as_before());
}

constexpr auto kXrgb = command::PixelFormat::kXrgb8888, k565 = command::PixelFormat::kRgb565;
INSTANTIATE_TEST_SUITE_P(
    OfEachCause, DrmNoPicturesTest,
    ::testing::Values(
        NoPictures{"AFormatNotTaken", DRM_IOCTL_MODE_ADDFB2, EINVAL, k565, StatusCode::kInvalidArgument,
                   "display /dev/dri/card0 takes no RGB565 pictures of 64x48; leave out --rgb565; errno"},
        NoPictures{"AFormatNotThere", DRM_IOCTL_MODE_ADDFB2, ENOENT, kXrgb, StatusCode::kInvalidArgument,
                   "display /dev/dri/card0 takes no XRGB8888 pictures of 64x48; name another by --card; errno"},
        NoPictures{"NoMemory", DRM_IOCTL_MODE_CREATE_DUMB, ENOMEM, kXrgb, StatusCode::kUnavailable,
                   "display /dev/dri/card0: XRGB8888 pictures of 64x48: no memory for pictures of this size; give the "
                   "driver more (cma=), or ask for a smaller --size; errno"},
        NoPictures{"NoRights", DRM_IOCTL_MODE_CREATE_DUMB, EACCES, kXrgb, StatusCode::kUnavailable,
                   "display /dev/dri/card0: XRGB8888 pictures of 64x48: no permission; run as a member of its group "
                   "(video), and see that no other program shows pictures on this card; errno"},
        NoPictures{"ADriverWithoutBuffers", DRM_IOCTL_MODE_CREATE_DUMB, ENOSYS, k565, StatusCode::kUnavailable,
                   "display /dev/dri/card0: RGB565 pictures of 64x48: the driver has no plain buffers; name another "
                   "card by --card; errno"}),
    [](const auto& instance) { return instance.param.name; });

TEST_F(DrmDisplayTest, PicturesRefusedOnlyAMomentAgoAreATryAnew) {
  ASSERT_TRUE(display_->open(config()).ok());
  kernel_.card.refusals[DRM_IOCTL_MODE_CREATE_DUMB] = ENOMEM;
  const Scanout s = scanout();
  kernel_.card.refusals.clear();
  const Status status = display_->start(s);
  EXPECT_EQ(status.code, StatusCode::kUnavailable);
  EXPECT_THAT(status.message, HasSubstr("refused a moment ago; start the program anew"));
  EXPECT_EQ(kernel_.buffers() + kernel_.frame_buffers(), 0u);
}

TEST_F(DrmDisplayTest, StartWithAnotherSizeThanOpenSaysBoth) {
  ASSERT_TRUE(display_->open(config()).ok());
  Scanout s = scanout();
  s.width = 800;
  s.height = 600;
  const Status status = display_->start(s);
  EXPECT_EQ(status.code, StatusCode::kInvalidArgument);
  EXPECT_STREQ(status.message, "display /dev/dri/card0 was opened for 64x48, not for 800x600; width");
  EXPECT_EQ(status.where, 800u);
}

TEST_F(DrmDisplayTest, APictureOutsideVramIsRefused) {
  ASSERT_TRUE(display_->open(config()).ok());
  Scanout s = scanout();
  s.picture[1] = kVramBase + kVramBytes - 4096;
  EXPECT_EQ(display_->start(s).code, StatusCode::kInvalidArgument);
  s.picture[1] = kVramBase + 0x20040;
  EXPECT_EQ(display_->start(s).code, StatusCode::kInvalidArgument) << "not at a page";
  EXPECT_EQ(kernel_.mappings(), 0u);
}

TEST_F(DrmDisplayTest, NothingIsShownBeforeStart) {
  EXPECT_EQ(display_->show(0).code, StatusCode::kFailedPrecondition);
  ASSERT_TRUE(display_->open(config()).ok());
  EXPECT_EQ(display_->show(0).code, StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace usuzumi::linux_hal::testing
