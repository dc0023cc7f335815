// The six formats that assimp reads, and glTF 1.0: literal files, expectations worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/common/error.h"
#include "sim/pack/load_model.h"
#include "tests/sim/pack/support.h"

namespace usuzumi {
namespace {

using sim::load_model;
using sim::Mesh;
using sim::Model;
using ::testing::AllOf;
using ::testing::Contains;
using testing::face_corners;
using testing::faces_of;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TempFolder;

const std::multiset<testing::FaceCorners> kSquare{face_corners({0, 0, 0}, {1, 0, 0}, {1, 1, 0}),
                                                  face_corners({0, 0, 0}, {1, 1, 0}, {0, 1, 0})};

TEST(ObjImport, CutsPolygonsKeepsGroupsAndMaterialColours) {
  TempFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\n");
  const Model model =
      load_model(folder.write("a.obj",
                              "mtllib m.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n"
                              "o wedge\nv 0 0 5\nv 1 0 5\nv 0 1 5\nf 5 6 7\n"));
  ASSERT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].name, "square");
  EXPECT_EQ(model.meshes[1].name, "wedge");
  EXPECT_EQ(faces_of(model.meshes[0]), kSquare);
  EXPECT_EQ(model.meshes[0].base_colour, rgba8(255, 0, 0));
  EXPECT_TRUE(model.meshes[0].two_sided) << "an open surface of a format that cannot say it shows both sides";
  EXPECT_EQ(model.meshes[1].positions[0].z, 5);
}

TEST(ObjImport, ClosedSurfaceShowsItsOutsideOnly) {
  TempFolder folder;
  const Model model =
      load_model(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  EXPECT_FALSE(model.meshes[0].two_sided);
  EXPECT_EQ(model.meshes[0].name, "a") << "an object without a name is called as its file";
}

TEST(ObjImport, DropsPointsLinesAndFacesWithoutAreaWithAWord) {
  TempFolder folder;
  const Model model =
      load_model(folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 1 2 3\nf 1 2 2\nf 1 4 3\nl 1 2\np 1\n"));
  std::size_t faces = 0;
  for (const Mesh& mesh : model.meshes) faces += mesh.face_count();
  EXPECT_EQ(faces, 1u);
  EXPECT_THAT(model.notes, Contains(HasSubstr("points and lines are left out")));
  EXPECT_THAT(model.notes, Contains(HasSubstr("2 faces of 1 meshes have two corners at one place")));
}

TEST(PlyImport, KeepsVertexColoursAsTheyAre) {
  TempFolder folder;
  const Mesh mesh =
      load_model(
          folder.write("a.ply",
                       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                       "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 0 128 0\n0 1 0 0 0 "
                       "7\n3 0 1 2\n"))
          .meshes.at(0);
  EXPECT_EQ(mesh.name, "a");
  EXPECT_EQ(mesh.colours, (std::vector{rgba8(255, 0, 0), rgba8(0, 128, 0), rgba8(0, 0, 7)}));
}

/// A triangle whose third vertex is at (0, y, 0).
std::string ply_with(const std::string& y) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 " +
         y + " 0\n3 0 1 2\n";
}

TEST(PlyImport, CoordinatesThatAreNoNumbersAreRefused) {
  TempFolder folder;
  for (const char* bad : {"nan", "inf", "1e39"}) {
    const std::string path = folder.write("a.ply", ply_with(bad));
    EXPECT_THROW(load_model(path), sim::Error) << bad;
  }
}

TEST(PlyImport, ACoordinateThatDrawingDataCannotHoldIsRefusedByItsPlace) {
  TempFolder folder;
  EXPECT_NO_THROW(load_model(folder.write("a.ply", ply_with("-1e8"))));
  for (const char* bad : {"-1.00001e8", "3e38"}) {
    const std::string path = folder.write("a.ply", ply_with(bad));
    EXPECT_THAT([&] { load_model(path); },
                ::testing::ThrowsMessage<sim::Error>(
                    AllOf(HasSubstr("a.ply"), HasSubstr("vertex 2"), HasSubstr("up to 1e+08"))))
        << bad;
  }
}

TEST(StlImport, MakesSmoothNormalsOfFacetsAndJoinsCorners) {
  TempFolder folder;
  // Two facets that meet at 10 degrees or so: (0.0998 slope). Their common corners get one normal each, so 4 vertices
  // remain.
  const Mesh mesh = load_model(folder.write("a.stl",
                                            "solid roof\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 "
                                            "0\nvertex 0 1 0\nendloop\nendfacet\n"
                                            "facet normal 0 0 1\nouter loop\nvertex 1 0 0\nvertex 1 1 0.1\nvertex 0 1 "
                                            "0\nendloop\nendfacet\nendsolid roof\n"))
                        .meshes.at(0);
  EXPECT_EQ(mesh.face_count(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
}

TEST(OffImport, ReadsFaces) {
  TempFolder folder;
  EXPECT_EQ(
      faces_of(load_model(folder.write("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")).meshes.at(0)),
      kSquare);
}

TEST(OffImport, CountsBeyondTheFileAreRefusedBeforeMemoryIsTaken) {
  TempFolder folder;
  for (const char* counts : {"4000000000 1 0", "3 4000000000 0", "99999999999999999999999 1 0"}) {
    const std::string path = folder.write("a.off", std::string("OFF # a comment\n# another\n") + counts + "\n0 0 0\n");
    try {
      load_model(path);
      ADD_FAILURE() << counts;
    } catch (const sim::Error& e) {
      EXPECT_THAT(e.what(), HasSubstr("claims"));
    }
  }
}

TEST(AcImport, KeepsTransformsAndMaterialColours) {
  TempFolder folder;
  const Mesh mesh =
      load_model(
          folder.write(
              "a.ac",
              "AC3Db\nMATERIAL \"m\" rgb 0 1 0 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n"
              "OBJECT poly\nname \"plate\"\nloc 0 0 3\nnumvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat "
              "0\n"
              "refs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nkids 0\n"))
          .meshes.at(0);
  EXPECT_EQ(faces_of(mesh), (std::multiset{face_corners({0, 0, 3}, {1, 0, 3}, {1, 1, 3}),
                                           face_corners({0, 0, 3}, {1, 1, 3}, {0, 1, 3})}));
  EXPECT_EQ(mesh.base_colour, rgba8(0, 255, 0));
}

TEST(DaeImport, AppliesNodeTransformsAndMirrors) {
  TempFolder folder;
  const std::string dae =
      R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g" name="plate"><mesh><source id="p"><float_array id="pa" count="9">
0 0 0 1 0 0 0 1 0</float_array>
<technique_common>
<accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>

<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p>
</triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">
<node id="n" name="Plate"><translate>0 0 2</translate><scale>-1 1 1</scale>
<instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
  const Mesh mesh = load_model(folder.write("a.dae", dae)).meshes.at(0);
  EXPECT_EQ(faces_of(mesh), std::multiset{face_corners({0, 0, 2}, {0, 1, 2}, {-1, 0, 2})});
  EXPECT_EQ(mesh.node_name, "Plate");
}

TEST(Gltf1Import, ReadsNamesAndExtrasThatTheImporterDoesNotHandOn) {
  TempFolder folder;
  const float xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::uint16_t order[4] = {0, 1, 2, 0};
  folder.write("d.bin", std::string(reinterpret_cast<const char*>(xyz), 36) +
                            std::string(reinterpret_cast<const char*>(order), 8));
  const std::string text = R"({"asset": {"version": "1.0"}, "scene": "s", "scenes": {"s": {"nodes": ["n0"]}},
    "nodes": {"n0": {"name": "Leaf", "meshes": ["m0"], "extras": {"thinning_level": 1}, "translation": [0, 0, 4]}},
    "meshes": {"m0": {"name": "leaf", "extras": {"thinning_level": 3, "face_quota": "50%"},
      "primitives": [{"attributes": {"POSITION": "a0"}, "indices": "a1", "material": "k0", "mode": 4}]}},
    "materials": {"k0": {"name": "paint", "values": {"diffuse": [1, 0, 0, 1]}}},
    "accessors": {"a0": {"bufferView": "v0", "byteOffset": 0, "componentType": 5126, "count": 3, 
    "type": "VEC3", "min": [0,0,0], "max": [1,1,0]},
                  "a1": {"bufferView": "v1", "byteOffset": 0, "componentType": 5123, "count": 3, "type": "SCALAR"}},
    "bufferViews": {"v0": {"buffer": "b", "byteOffset": 0, "byteLength": 36, "target": 34962},
    "v1": {"buffer": "b", "byteOffset": 36, "byteLength": 6, "target": 34963}},
    "buffers": {"b": {"byteLength": 44, "type": "arraybuffer", "uri": "d.bin"}}})";
  const Mesh mesh = load_model(folder.write("a.gltf", text)).meshes.at(0);
  EXPECT_EQ(mesh.name, "leaf");
  EXPECT_EQ(mesh.node_name, "Leaf");
  EXPECT_EQ(mesh.material_name, "paint");
  EXPECT_EQ(mesh.tags.level, 1u);
  EXPECT_TRUE(mesh.tags.quota.has_value());
  EXPECT_EQ(faces_of(mesh), std::multiset{face_corners({0, 0, 4}, {1, 0, 4}, {0, 1, 4})});
}

TEST(LoadModel, RefusesWhatItCannotReadAndSaysWhatItCan) {
  TempFolder folder;
  auto line = [&](const std::string& path) -> std::string {
    try {
      load_model(path);
    } catch (const sim::Error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_THAT(line(folder.write("a.fbx", "x")), HasSubstr(".glb .gltf .obj"));
  EXPECT_THAT(line(folder / "nowhere.obj"), HasSubstr("no such file"));
  std::filesystem::create_directory(folder.path() / "d.obj");
  EXPECT_THAT(line(folder / "d.obj"), HasSubstr("folder"));
  EXPECT_THAT(line(folder.write("garbage.stl", "\x01\x02\x03")), Not(HasSubstr("\n")));
}

TEST(LoadModel, ReadsExtensionsInCapitals) {
  TempFolder folder;
  EXPECT_EQ(load_model(folder.write("A.OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n")).meshes.size(), 1u);
}

TEST(LoadModel, NamesAreUniqueOverAllFiles) {
  TempFolder folder;
  const std::vector<std::filesystem::path> files{folder.write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"),
                                                 folder / "a.off"};
  const Model model = sim::load_models(files);
  EXPECT_EQ(model.meshes.at(0).name, "a");
  EXPECT_EQ(model.meshes.at(1).name, "a#2");
}

}  // namespace
}  // namespace usuzumi
