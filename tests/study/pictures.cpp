// usuzumi_study_pictures: the pictures of the documentation, drawn by the device.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "firmware/device/turntable.h"
#include "sim/image/png.h"
#include "tests/study/contact_sheet.h"
#include "tests/study/subjects.h"
#include "tests/study/thin_model.h"
#include "tests/study/views.h"

namespace usuzumi::study {
namespace {

namespace fs = std::filesystem;

constexpr Rgba8 kBackground = rgba8(176, 190, 204);

/// view_of() fits the corners of the model's box into the picture; what is rounder may be shown larger, by a narrower
/// view.
firmware::Camera narrow_view(const sim::Model& model, double azimuth_rad, double elevation_rad, PictureSize size,
                             float narrower) {
  firmware::Camera camera = firmware::view_of(bounds_of(model), azimuth_rad, elevation_rad,
                                              static_cast<float>(size.width) / static_cast<float>(size.height));
  camera.fov_y_rad *= narrower;
  return camera;
}

sim::Image drawn(const sim::Model& model, const firmware::Camera& camera, PictureSize size) {
  return draw(model, std::span(&camera, 1), size, kBackground).front();
}

sim::Model without_texture(sim::Model model) {
  for (sim::Mesh& mesh : model.meshes) {
    mesh.material.reset();
    mesh.texture_coordinates.clear();
    mesh.base_colour = rgba8(200, 205, 210);
  }
  model.materials.clear();
  model.textures.clear();
  return model;
}

/// The example of US 6,396,952, p. 35: a sphere of 182 vertices in steps of 60 %, with its map and without.
void draw_earth(const fs::path& out) {
  constexpr PictureSize kSize{240, 240};
  constexpr double kAzimuth = 2.5, kElevation = 0.5;  // radians: Africa and Europe, with the pole in sight
  const sim::Model whole = earth();
  const firmware::Camera camera = narrow_view(whole, kAzimuth, kElevation, kSize, 0.6f);
  std::vector<sim::Image> textured, plain;
  for (const double share : {1.0, 0.6, 0.36, 0.216}) {
    const ThinnedModel thinned =
        share < 1 ? thin_model(whole, firmware::Method::kEdgeRemoval, share) : unthinned(whole);
    textured.push_back(drawn(thinned.model, camera, kSize));
    plain.push_back(drawn(without_texture(thinned.model), camera, kSize));
    fmt::print("earth-thinned.png: {} faces\n", thinned.faces);
  }
  textured.insert(textured.end(), plain.begin(), plain.end());
  sim::write_png(out / "earth-thinned.png", contact_sheet(textured, 4));
}

/// The truck whole, by QEM and by half-edge collapse.
void draw_truck(const fs::path& out) {
  constexpr PictureSize kSize{480, 320};
  constexpr double kShare = 0.5, kAzimuth = 2.3, kElevation = 0.25;  // radians: from its left front
  const auto whole = truck(1024);
  if (!whole) return;
  const firmware::Camera camera = narrow_view(*whole, kAzimuth, kElevation, kSize, 0.8f);
  std::vector<sim::Image> pictures = {drawn(*whole, camera, kSize)};
  for (const firmware::Method method : {firmware::Method::kQem, firmware::Method::kHalfEdge}) {
    const ThinnedModel thinned = thin_model(*whole, method, kShare);
    pictures.push_back(drawn(thinned.model, camera, kSize));
    fmt::print("truck-methods.png: {} faces\n", thinned.faces);
  }
  sim::write_png(out / "truck-methods.png", contact_sheet(pictures, 3));
}

}  // namespace
}  // namespace usuzumi::study

int main(int argc, char** argv) {
  using namespace usuzumi::study;
  CLI::App app("Draws pictures of the documentation, earth-thinned.png and truck-methods.png",
               "usuzumi_study_pictures");
  std::filesystem::path out;
  app.add_option("--out", out, "The folder for them, which must exist")->check(CLI::ExistingDirectory)->required();
  CLI11_PARSE(app, argc, argv);
  try {
    draw_earth(out);
    draw_truck(out);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "usuzumi_study_pictures: %s\n", error.what());
    return 1;
  }
  return 0;
}
