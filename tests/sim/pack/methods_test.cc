// The author's choice of a thinning method, its settings and the values of edges.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/simplify/vertex_deletion/presets.h"
#include "sim/pack/method_settings.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using firmware::DrawingData;
using firmware::Method;
using ::testing::AllOf;
using testing::GltfBuilder;
using ::testing::HasSubstr;
using testing::json;
using testing::run_usuzumi;
using testing::TempFolder;

/// Packs with a sidecar for mesh "plate" and looks at the ROM.
class Methods : public ::testing::Test {
 protected:
  /// "plate": a square, whose right side is in the group RIM; its material is called "paint".
  static GltfBuilder plate() {
    GltfBuilder b;
    const int p = b.positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    const int rim = b.accessor(std::vector<float>{0, 1, 0.75f, 0.5f}, 5126, "SCALAR", 1);
    b.document["materials"] = json::array({{{"name", "paint"}}});
    b.node({{"name", "Plate"},
            {"mesh", b.mesh({{"attributes", {{"POSITION", p}, {"_RIM", rim}}},
                             {"indices", b.indices({0, 1, 2, 0, 2, 3})},
                             {"material", 0}},
                            "plate")}});
    return b;
  }
  testing::CommandResult pack(const json& properties, std::vector<std::string> options = {}) {
    json all = {{"thinning_level", 3}};
    all.update(properties);
    const std::string sidecar = folder_.write("s.json", json{{"meshes", {{"plate", all}}}}.dump());
    options.insert(options.begin(),
                   {"pack", folder_.write("m.gltf", plate().text()), "-o", folder_ / "m.rom", "--sidecar", sidecar});
    return run_usuzumi(options);
  }
  firmware::MeshView mesh() {
    rom_ = testing::bytes_of_file(folder_ / "m.rom");
    const auto data = DrawingData::open(rom_);
    EXPECT_TRUE(data.ok()) << data.status().message;
    return data->mesh(0);
  }
  std::string refusal(const json& properties) {
    const auto result = pack(properties);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    return result.err;
  }
  /// By position: (0 0) (1 0) (1 1) (0 1).
  std::vector<float> edge_values() {
    const auto view = mesh();
    std::vector<float> out(4);
    for (std::size_t v = 0; v < view.edge_values.size(); ++v) {
      const Vec3 p = view.positions[v];
      out[p.y < 0.5f ? (p.x < 0.5f ? 0 : 1) : (p.x < 0.5f ? 3 : 2)] = view.edge_values[v];
    }
    return out;
  }

  TempFolder folder_;
  std::vector<std::byte> rom_;
};

TEST_F(Methods, ComeFromSidecarOptionAndExtras) {
  for (const auto& [name, method] :
       {std::pair{"qem", Method::kQem}, std::pair{"edge-removal", Method::kEdgeRemoval},
        std::pair{"half-edge", Method::kHalfEdge}, std::pair{"vertex-deletion", Method::kVertexDeletion}}) {
    ASSERT_EQ(pack({{"method", name}}).exit_code, 0);
    EXPECT_EQ(mesh().method, method);
    EXPECT_EQ(mesh().method_settings, nullptr) << "nobody gave any";
    ASSERT_EQ(pack({{"method", "qem"}}, {"--method", std::string("plate=") + name}).exit_code, 0);
    EXPECT_EQ(mesh().method, method);
    GltfBuilder b = plate();
    b.document["meshes"][0]["extras"] = {{"thinning_level", 3}, {"method", name}};
    ASSERT_EQ(run_usuzumi({"pack", folder_.write("x.gltf", b.text()), "-o", folder_ / "m.rom"}).exit_code, 0);
    EXPECT_EQ(mesh().method, method);
  }
}

TEST_F(Methods, SettingsReachTheFirmwareByTheirNames) {
  const json given = {{"a", 2},
                      {"b", 0.5},
                      {"neighbour_weight", 0.25},
                      {"computed_weight", 3},
                      {"user_weight", 4},
                      {"placement", "keep-an-end"},
                      {"boundary_answer", "refuse"},
                      {"boundary_limit", 0.125}};
  ASSERT_EQ(pack({{"method", "edge-removal"}, {"method_settings", given}}).exit_code, 0);
  const auto s = mesh().edge_removal();
  EXPECT_EQ(s.a, 2);
  EXPECT_EQ(s.b, 0.5f);
  EXPECT_EQ(s.neighbour_weight, 0.25f);
  EXPECT_EQ(s.computed_weight, 3);
  EXPECT_EQ(s.user_weight, 4);
  EXPECT_EQ(s.placement, firmware::EdgePlacement::kKeepAnEnd);
  EXPECT_EQ(s.boundary_answer, firmware::BoundaryAnswer::kRefuse);
  EXPECT_EQ(s.boundary_limit, 0.125f);
  json shown = json::parse(run_usuzumi({"inspect", folder_ / "m.rom", "--json"}).out)["meshes"][0];
  EXPECT_EQ(shown["method"], "edge-removal");
  EXPECT_EQ(shown["method_settings"], given);
}

TEST_F(Methods, PresetsAreTheFirmwaresAndSingleSettingsGoOverThem) {
  const auto with = [&](const json& settings) {
    const auto packed = pack({{"method", "vertex-deletion"}, {"method_settings", settings}});
    EXPECT_EQ(packed.exit_code, 0) << packed.err;
    return mesh().vertex_deletion();
  };
  EXPECT_EQ(with({{"preset", "flat"}}).largest, firmware::kFlatPreset.largest);
  EXPECT_EQ(with({{"preset", "curved"}}).move, firmware::kCurvedPreset.move);
  EXPECT_EQ(with({{"preset", "bounded"}}).boundary_area, firmware::kBoundedPreset.boundary_area);
  const auto mixed = with({{"largest", 7}, {"preset", "curved"}, {"limit_normal", 0.5}, {"protrusion_penalty", 20}});
  EXPECT_EQ(mixed.largest, 7);
  EXPECT_EQ(mixed.move, firmware::kCurvedPreset.move);
  EXPECT_EQ(mixed.limit_normal, 0.5f);
  EXPECT_EQ(mixed.protrusion_penalty, 20);
  EXPECT_EQ(mixed.area, firmware::VertexDeletionSettings{}.area);
}

TEST_F(Methods, TextOfACustomPropertyMayBeJson) {
  GltfBuilder b = plate();
  b.document["nodes"][0]["extras"] = {{"thinning_level", 3},
                                      {"method", "edge-removal"},
                                      {"method_settings", "{\"a\": 9}"},
                                      {"regions", "[{\"group\": \"rim\", \"value\": 2}]"}};
  ASSERT_EQ(run_usuzumi({"pack", folder_.write("x.gltf", b.text()), "-o", folder_ / "m.rom"}).exit_code, 0);
  EXPECT_EQ(mesh().edge_removal().a, 9);
  EXPECT_EQ(edge_values(), (std::vector<float>{0, 2, 2, 0})) << "0.5 is not in the group";
}

TEST_F(Methods, RegionsGiveValuesAndLocksByGroupMaterialAndName) {
  const auto with = [&](const json& regions) {
    const auto packed = pack({{"method", "edge-removal"}, {"regions", regions}});
    EXPECT_EQ(packed.exit_code, 0) << packed.err;
    return edge_values();
  };
  const json rim_locked = {{"group", "rim"}, {"locked", true}}, paint = {{"material", "paint"}, {"value", 3}};
  EXPECT_EQ(with(json::array({rim_locked})), (std::vector<float>{0, -1, -1, 0}));
  EXPECT_EQ(with(json::array({paint, rim_locked})), (std::vector<float>{3, -1, -1, 3}));
  EXPECT_EQ(with(json::array({rim_locked, paint})), (std::vector<float>{3, 3, 3, 3})) << "the later counts";
  EXPECT_EQ(with(json::array({{{"group", "Plate"}, {"value", 1}}})), (std::vector<float>{1, 1, 1, 1}));
  EXPECT_EQ(json::parse(run_usuzumi({"inspect", folder_ / "m.rom", "--json"}).out)["meshes"][0]["edge_values"],
            (json{{"valued", 4}, {"locked", 0}}));
}

TEST_F(Methods, RegionsOfObjGroupsAreMeshesOfThatName) {
  const std::string obj =
      folder_.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\ng rim\nf 1 2 3\ng body\nf 2 4 3\n");
  const std::string sidecar =
      folder_.write("s.json", R"({"meshes": {"*": {"thinning_level": 3, "method": "edge-removal",
      "regions": [{"group": "rim", "locked": true}]}}})");
  const auto packed = run_usuzumi({"pack", obj, "-o", folder_ / "m.rom", "--sidecar", sidecar});
  ASSERT_EQ(packed.exit_code, 0) << packed.err;
  EXPECT_EQ(mesh().name, "rim");
  for (float v : mesh().edge_values) EXPECT_EQ(v, firmware::kLockedEdgeValue);
}

TEST_F(Methods, WhatIsNotKnownIsOneClearLine) {
  EXPECT_THAT(refusal({{"method", "quadric"}}),
              HasSubstr("must be one of qem, edge-removal, half-edge, vertex-deletion"));
  EXPECT_THAT(refusal({{"method", 2}}), HasSubstr("vertex-deletion, not 2"));
  const auto option = pack(json::object(), {"--method", "plate=QEM"});
  EXPECT_EQ(option.exit_code, 2);
  EXPECT_THAT(option.err, HasSubstr("--method plate=QEM: the value must be one of qem, edge-removal"));
  GltfBuilder b = plate();
  b.document["nodes"][0]["extras"] = {{"method", "vertex deletion"}};
  const auto extras = run_usuzumi({"pack", folder_.write("x.gltf", b.text()), "-o", folder_ / "x.rom"});
  EXPECT_EQ(extras.exit_code, 3);
  EXPECT_THAT(extras.err, HasSubstr("node 'Plate': method must be one of qem"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.rom"));
  const auto settings = [&](const json& s) { return refusal({{"method", "edge-removal"}, {"method_settings", s}}); };
  EXPECT_THAT(settings({{"neighbor_weight", 1}}), HasSubstr("did you mean neighbour_weight"));
  EXPECT_THAT(settings({{"a", -1}}), HasSubstr("a must be a number, 0 or more"));
  EXPECT_THAT(settings({{"a", "much"}}), HasSubstr("a must be a number"));
  EXPECT_THAT(settings({{"placement", "best"}}),
              HasSubstr("automatic, equal-volume, least-volume, keep-an-end, midpoint"));
  EXPECT_THAT(settings({{"largest", 1}}), HasSubstr("'largest' is of method vertex-deletion, not of edge-removal"));
  EXPECT_THAT(settings({{"preset", "round"}}), HasSubstr("flat, curved, bounded"));
  EXPECT_THAT(settings(json::object()), HasSubstr("object of settings"));
  EXPECT_THAT(refusal({{"method_settings", {{"a", 1}}}}), HasSubstr("not of qem; give it"));
  EXPECT_THAT(refusal({{"method_settings", {{"placement", "midpoint"}}}}), HasSubstr("whose own is --placement"));
  const auto regions = [&](const json& r) { return refusal({{"method", "edge-removal"}, {"regions", r}}); };
  EXPECT_THAT(regions(json::array({{{"group", "rims"}, {"value", 1}}})), HasSubstr("RIM"));
  EXPECT_THAT(regions(json::array({{{"material", "pain"}, {"value", 1}}})), HasSubstr("did you mean paint"));
  EXPECT_THAT(regions(json::array({{{"group", "rim"}, {"value", -2}}})), HasSubstr("0 or more"));
  EXPECT_THAT(regions(json::array({{{"group", "rim"}}})), HasSubstr("value or \"locked\""));
  EXPECT_THAT(regions(json::array({{{"value", 1}}})), HasSubstr("a group or a material"));
  EXPECT_THAT(regions(json::array({{{"group", "rim"}, {"lock", true}}})), HasSubstr("did you mean locked"));
  EXPECT_THAT(regions(json::array()), HasSubstr("must be a list"));
}

TEST_F(Methods, WhatTheMethodOrLevelDoesNotUseIsNoted) {
  EXPECT_THAT(pack({{"method", "half-edge"}, {"regions", json::array({{{"group", "rim"}, {"value", 1}}})}}).err,
              HasSubstr("only the method edge-removal"));
  EXPECT_TRUE(mesh().edge_values.empty());
  EXPECT_THAT(pack({{"thinning_level", 1}, {"method", "half-edge"}}).err, HasSubstr("method is kept in ROM"));
  const auto bare = pack({{"method", "half-edge"}}, {"--bare"});
  EXPECT_EQ(bare.exit_code, 3);
  EXPECT_THAT(bare.err, HasSubstr("--bare keeps levels only"));
}

TEST(MethodNames, AreInTheOrderOfTheirNumbers) {
  EXPECT_EQ(sim::method_name(Method::kVertexDeletion), "vertex-deletion");
  EXPECT_EQ(sim::method_of("half-edge"), Method::kHalfEdge);
  EXPECT_EQ(sim::method_of("half"), std::nullopt);
}

}  // namespace
}  // namespace usuzumi
