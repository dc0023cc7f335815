// Work in a process of its own: whatever happens in there, one Error comes out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <new>
#include <stdexcept>

#include "sim/common/error.h"
#include "sim/pack/isolate.h"
#include "sim/pack/model_bytes.h"

namespace usuzumi {
namespace {

using sim::Error;
using sim::ExitCode;
using ::testing::HasSubstr;
using Work = std::function<std::vector<std::byte>()>;

std::string failure(const Work& work, ExitCode code = ExitCode::kBadInput,
                    std::chrono::seconds limit = std::chrono::seconds(30)) {
  try {
    sim::run_isolated("car.obj", limit, work);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), code);
    return e.what();
  }
  ADD_FAILURE() << "did not fail";
  return "";
}

TEST(Isolation, HandsBackTheBytes) {
  for (std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{3'000'000}}) {
    std::vector<std::byte> bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 & 0xFF);
    EXPECT_EQ(sim::run_isolated("x", std::chrono::seconds(30), [&] { return bytes; }), bytes);
  }
}

TEST(Isolation, PassesErrorsOnWithTheirCode) {
  EXPECT_EQ(failure([]() -> std::vector<std::byte> { throw Error(ExitCode::kUsage, "car.obj: so and so"); },
                    ExitCode::kUsage),
            "car.obj: so and so");
  EXPECT_THAT(failure([]() -> std::vector<std::byte> { throw std::runtime_error("odd"); }),
              HasSubstr("car.obj: cannot be read: odd"));
  EXPECT_THAT(failure([]() -> std::vector<std::byte> { throw std::bad_alloc(); }), HasSubstr("memory"));
}

TEST(Isolation, CrashesHangsAndSilenceBecomeOneLine) {
  EXPECT_THAT(failure([]() -> std::vector<std::byte> {
                std::raise(SIGSEGV);
                return {};
              }),
              HasSubstr("car.obj: the importer"));
  EXPECT_THAT(failure([]() -> std::vector<std::byte> { std::abort(); }), HasSubstr("crashed"));
  EXPECT_THAT(failure([]() -> std::vector<std::byte> { ::_exit(0); }), HasSubstr("without a word"));
  EXPECT_THAT(failure(
                  []() -> std::vector<std::byte> {
                    for (;;) ::pause();
                  },
                  ExitCode::kBadInput, std::chrono::seconds(1)),
              HasSubstr("--time-limit"));
}

TEST(Isolation, DropsWhatTheChildPrints) {
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  sim::run_isolated("x", std::chrono::seconds(30), []() -> std::vector<std::byte> {
    std::cout << "chatter" << std::flush;
    std::cerr << "warning" << std::flush;
    return {};
  });
  EXPECT_EQ(::testing::internal::GetCapturedStdout() + ::testing::internal::GetCapturedStderr(), "");
}

sim::Model sample() {
  sim::Model model;
  sim::Mesh& mesh = model.meshes.emplace_back();
  mesh.mesh_name = "plate";
  mesh.node_name = "Plate";
  mesh.positions = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  mesh.colours.assign(3, rgba8(1, 2, 3));
  mesh.indices = {0, 1, 2};
  mesh.two_sided = true;
  mesh.tags = {3u, {}, 4.0f, false};
  mesh.tags.layers = {1'000'000, 600'000};
  model.notes = {"a note"};
  return model;
}

TEST(ModelBytes, GoThereAndBack) {
  const sim::Model before = sample(), after = sim::model_from_bytes(sim::model_to_bytes(before), "x");
  ASSERT_EQ(after.meshes.size(), 1u);
  EXPECT_EQ(after.notes, before.notes);
  EXPECT_EQ(after.meshes[0].mesh_name, "plate");
  EXPECT_EQ(after.meshes[0].node_name, "Plate");
  EXPECT_EQ(after.meshes[0].positions, before.meshes[0].positions);
  EXPECT_EQ(after.meshes[0].colours, before.meshes[0].colours);
  EXPECT_EQ(after.meshes[0].indices, before.meshes[0].indices);
  EXPECT_EQ(after.meshes[0].two_sided, true);
  EXPECT_EQ(after.meshes[0].tags, before.meshes[0].tags);
}

TEST(ModelBytes, EveryPrefixIsRefused) {
  const std::vector<std::byte> bytes = sim::model_to_bytes(sample());
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_THROW(sim::model_from_bytes(std::vector(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(n)), "x"),
                 Error)
        << n;
}

}  // namespace
}  // namespace usuzumi
