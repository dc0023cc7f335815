#include "tests/study/views.h"

#include <cmath>
#include <cstdlib>

#include "firmware/device/turntable.h"
#include "sim/desk/desk.h"
#include "sim/pack/rom_writer.h"

namespace usuzumi::study {

std::vector<Vec3> view_directions() {
  std::vector<Vec3> directions;
  for (int corners = 1; corners <= 3; ++corners)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (std::abs(x) + std::abs(y) + std::abs(z) == corners)
            directions.push_back(normalized({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)}));
  return directions;
}

firmware::Bounds bounds_of(const sim::Model& model) {
  firmware::Bounds bounds;
  bool any = false;
  for (const sim::Mesh& mesh : model.meshes) {
    for (const Vec3 p : mesh.positions) {
      if (!any) bounds = {p, p};
      any = true;
      bounds.low = {std::fmin(bounds.low.x, p.x), std::fmin(bounds.low.y, p.y), std::fmin(bounds.low.z, p.z)};
      bounds.high = {std::fmax(bounds.high.x, p.x), std::fmax(bounds.high.y, p.y), std::fmax(bounds.high.z, p.z)};
    }
  }
  return bounds;
}

std::vector<firmware::Camera> cameras_around(const firmware::Bounds& bounds, std::span<const Vec3> directions,
                                             float aspect) {
  std::vector<firmware::Camera> cameras;
  for (const Vec3 d : directions) {
    const double azimuth = std::atan2(static_cast<double>(d.x), static_cast<double>(d.z));
    cameras.push_back(firmware::orbit(bounds, azimuth, std::asin(static_cast<double>(d.y)), aspect));
  }
  return cameras;
}

std::vector<sim::Image> draw(const sim::Model& model, std::span<const firmware::Camera> cameras, PictureSize size,
                             Rgba8 background) {
  sim::DeskConfig config;
  config.width = size.width;
  config.height = size.height;
  const std::vector<std::byte> rom = sim::write_container(model);
  sim::Desk desk(config, rom, "study");
  const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
  std::vector<sim::Image> pictures;
  for (const firmware::Camera& camera : cameras) {
    firmware::FrameRequest request = firmware::lit_request(camera, aspect, background);
    request.thinning.enabled = false;
    pictures.push_back(desk.draw(request).picture);
  }
  return pictures;
}

ColourDifference colour_difference(const sim::Image& a, const sim::Image& b, Rgba8 background) {
  const std::uint32_t nothing = background.r() << 16 | background.g() << 8 | background.b();
  ColourDifference difference;
  for (std::size_t i = 0; i < a.xrgb.size(); ++i) {
    if (a.xrgb[i] == nothing && b.xrgb[i] == nothing) continue;
    int channels = 0;
    for (const unsigned shift : {0u, 8u, 16u})
      channels += std::abs(static_cast<int>(a.xrgb[i] >> shift & 255) - static_cast<int>(b.xrgb[i] >> shift & 255));
    difference.sum += channels / 3.0;
    ++difference.pixels;
  }
  return difference;
}

ColourDifference colour_difference(std::span<const sim::Image> a, std::span<const sim::Image> b) {
  ColourDifference all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const ColourDifference one = colour_difference(a[i], b[i]);
    all.sum += one.sum;
    all.pixels += one.pixels;
  }
  return all;
}

}  // namespace usuzumi::study
