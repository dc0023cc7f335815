#include "sim/cli/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "hal/trigonometry.h"
#include "sim/common/error.h"
#include "sim/common/strict_json.h"

namespace usuzumi::sim {
namespace {

using json = nlohmann::ordered_json;

class FrameReader {
 public:
  FrameReader(const std::string& where, const json& object) : where_(where), object_(object) {
    if (!object.is_object()) fail("a camera must be an object with \"eye\" and \"target\"");
    for (const auto& [key, value] : object.items())
      if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys))
        fail(fmt::format("\"{}\" is none of eye, target, up, fov_y_deg, near, far", key));
  }

  firmware::Camera read(const firmware::Bounds& bounds) const {
    firmware::Camera camera;
    camera.eye = vector("eye", nullptr);
    camera.target = vector("target", nullptr);
    camera.up = vector("up", &camera.up);
    const double degrees = number("fov_y_deg", 40);
    camera.fov_y_rad = static_cast<float>(degrees * kPi / 180);
    const float radius = std::max(bounds.radius(), 1e-6f);
    const float distance = length(camera.eye - bounds.centre());
    camera.near_distance =
        static_cast<float>(number("near", double{std::max(distance - radius * 1.01f, radius * 0.01f)}));
    camera.far_distance = static_cast<float>(number("far", double{distance + radius * 1.01f}));
    const Status status = check(camera);
    if (!status.ok()) fail(status.message);
    return camera;
  }

 private:
  static constexpr const char* kKeys[] = {"eye", "target", "up", "fov_y_deg", "near", "far"};

  [[noreturn]] void fail(const std::string& what) const { throw Error(ExitCode::kBadInput, where_ + " " + what); }

  Vec3 vector(const char* key, const Vec3* otherwise) const {
    const auto found = object_.find(key);
    if (found == object_.end()) {
      if (otherwise != nullptr) return *otherwise;
      fail(fmt::format("there is no \"{}\": give three numbers", key));
    }
    const bool three = found->is_array() && found->size() == 3 && (*found)[0].is_number() && (*found)[1].is_number() &&
                       (*found)[2].is_number();
    if (!three) fail(fmt::format("\"{}\" must be three numbers", key));
    return {(*found)[0].get<float>(), (*found)[1].get<float>(), (*found)[2].get<float>()};
  }

  double number(const char* key, double otherwise) const {
    const auto found = object_.find(key);
    if (found == object_.end()) return otherwise;
    if (!found->is_number()) fail(fmt::format("\"{}\" must be a number", key));
    return found->get<double>();
  }

  std::string where_;
  const json& object_;
};

}  // namespace

std::vector<firmware::Camera> read_camera_file(const std::filesystem::path& path, const firmware::Bounds& bounds) {
  const json file = read_strict_json(path);
  std::vector<firmware::Camera> cameras;
  if (!file.is_object() || !file.contains("frames")) {
    cameras.push_back(FrameReader(path.string() + ":", file).read(bounds));
    return cameras;
  }
  const auto refuse = [&](const std::string& why) {
    throw Error(ExitCode::kBadInput, fmt::format("{}: {}", path.string(), why));
  };
  for (const auto& [key, value] : file.items())
    if (key != "frames")
      refuse(fmt::format("\"{}\" beside \"frames\" is not known here; move it into the frames or remove it", key));
  const json& frames = file["frames"];
  if (!frames.is_array() || frames.empty()) refuse("\"frames\" must be a list of cameras");
  for (std::size_t i = 0; i < frames.size(); ++i)
    cameras.push_back(FrameReader(fmt::format("{}: frame {}:", path.string(), i), frames[i]).read(bounds));
  return cameras;
}

}  // namespace usuzumi::sim
