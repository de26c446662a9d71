#include "engine/tasks/import_surface.h"

#include <gtest/gtest.h>

#include <optional>

#include "engine/tasks/face_tables.h"
#include "engine/tasks/imported_surface.h"
#include "engine/tasks/triangulate.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::tasks {
namespace {

// Two pieces, the second with a triangle on an edge that has two already; a vertex that no triangle names.
std::string tsurf(const std::string& name, const std::string& unit, const std::string& positive) {
  return "GOCAD TSurf 1\nHEADER {\nname:" + name +
         "\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME Default\nAXIS_UNIT \"m\" \"m\" \"" + unit +
         "\"\nZPOSITIVE " + positive +
         "\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\nVRTX 0 1100 2100 0.25\nVRTX 1 1200 2100 0.125\nVRTX 2 "
         "1100 2200 0.1\n"
         "TRGL 0 1 2\nTFACE\nVRTX 3 1300 2300 0.1\nVRTX 4 1300 2400 0.2\nVRTX 5 1200 2350 0.1\nVRTX 6 1400 "
         "2350 0.1\n"
         "VRTX 7 1300 2350 0.3\nVRTX 8 1 2 3\nTRGL 3 4 5\nTRGL 4 3 6\nTRGL 3 4 7\nEND\n";
}

class ImportSurface : public ::testing::Test {
 protected:
  static survey::Geometry time_survey() {
    survey::Geometry g;
    g.inlines = {100, 1, 50};
    g.crosslines = {300, 1, 50};
    g.samples = 100;
    g.interval = 4;
    g.map = {1000, 2000, 10, 0, 0, 10};
    return g;
  }
  void create(const std::optional<survey::Geometry>& survey) {
    project_.emplace(project::Project::create(folder_ / "p.footwall", survey));
  }
  SurfacesImported import(const std::string& text, const SurfaceImportOptions& options = {}) {
    return import_surface(*project_, folder_.file("some file.ts", text), options, {});
  }

  ScratchFolder folder_;
  std::optional<project::Project> project_;
};

TEST_F(ImportSurface, IsOneStepAndHasItsMesh) {
  create(time_survey());
  const SurfacesImported done = import(tsurf("F 1", "s", "Depth") + tsurf("F 1", "ms", "Elevation"));
  ASSERT_EQ(done.faults.size(), 2u);
  EXPECT_EQ(done.faults[1].fault, "F 1 (2)");
  EXPECT_EQ(done.faults[1].vertices, 9);
  EXPECT_EQ(done.report.renamed, (std::vector<std::string>{"F 1 -> F 1 (2)"}));
  ASSERT_EQ(project_->history().size(), 1u);
  const project::FaultRecord fault = project_->fault("F 1");
  EXPECT_FALSE(project_->mesh_is_stale(fault.id));
  // Seconds became the survey's milliseconds; the other one's elevation became negative depth.
  const auto mesh = project_->mesh(fault.id).value();
  EXPECT_EQ(mesh.vertices[0].position, (survey::WorldPoint{1100, 2100, 250}));
  EXPECT_EQ(project_->mesh(project_->fault("F 1 (2)").id)->vertices[0].position.z, -0.25);
  // Undo takes all of it, redo makes the mesh fresh again.
  project_->undo();
  EXPECT_TRUE(project_->faults().empty());
  EXPECT_TRUE(project_->surfaces().empty());
  project_->redo();
  EXPECT_FALSE(project_->mesh_is_stale(fault.id));
}

TEST_F(ImportSurface, TheMeshIsManifoldAndKeepsFacesInOrder) {
  create(time_survey());
  const SurfacesImported done = import(tsurf("F", "s", "Depth"));
  ASSERT_EQ(done.notices.size(), 3u);  // converted, a vertex outside, cut
  EXPECT_NE(done.notices[2].find("cut along 1 edges"), std::string::npos) << done.notices[2];
  const auto mesh = project_->mesh(project_->fault("F").id).value();
  ASSERT_EQ(mesh.faces.size(), 4u);
  std::vector<std::int64_t> panels;
  for (const project::MeshFace& face : mesh.faces) panels.push_back(face.panel);
  EXPECT_EQ(panels, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.vertices.size(), 3u + 9u + 1u);
  // Face tables, and so every export, have the file's vertices and triangles.
  const FaceTables faces = face_tables(*project_, "F", {}, Coordinates::kWorld);
  EXPECT_EQ(faces.tables[0].vertices.size(), 9u);
  EXPECT_EQ(faces.tables[0].triangles[3], (std::array<std::int32_t, 3>{3, 4, 7}));
  EXPECT_EQ(faces.tables[0].face_ids[3], "4.0");
  EXPECT_EQ(faces.units, (project::SurfaceUnits{"m", "ms"}));
  EXPECT_EQ(face_tables(*project_, "F", {}, Coordinates::kIndex).tables[0].vertices.size(), 13u);
}

TEST_F(ImportSurface, WindingsThatDisagreeAreTurnedInTheMeshAlone) {
  create(time_survey());
  const SurfacesImported done = import(
      "GOCAD TSurf 1\nHEADER {\nname:F\n}\nTFACE\nVRTX 1 1100 2100 -100\nVRTX 2 1200 2100 -120\n"
      "VRTX 3 1100 2200 -130\nVRTX 4 1200 2200 -140\nTRGL 1 2 3\nTRGL 2 3 4\nEND\n");
  ASSERT_EQ(done.notices.size(), 1u);
  EXPECT_NE(done.notices[0].find("1 of 2 are turned"), std::string::npos) << done.notices[0];
  const auto mesh = project_->mesh(project_->fault("F").id).value();
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.faces[1].vertices, (std::array<std::int32_t, 3>{1, 3, 2}));
  EXPECT_EQ(face_tables(*project_, "F", {}, Coordinates::kWorld).tables[0].triangles[1],
            (std::array<std::int32_t, 3>{1, 2, 3}));
}

TEST_F(ImportSurface, UnitsOfAnotherDomainAreRefusedUnlessOverridden) {
  create(time_survey());
  try {
    import(tsurf("F", "m", "Depth"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalid);
    EXPECT_NE(error.hint().find("--z-unit"), std::string::npos);
  }
  EXPECT_TRUE(project_->history().empty());
  SurfaceImportOptions options;
  options.z_unit = "s";
  options.z_positive_up = true;
  options.name = "mine";
  import(tsurf("F", "m", "Depth"), options);
  EXPECT_EQ(project_->mesh(project_->fault("mine").id)->vertices[0].position.z, -250);
}

TEST_F(ImportSurface, WithoutASurveyCoordinatesAreTheFiles) {
  create({});
  const SurfacesImported done = import(tsurf("F", "ft", "Elevation"));
  EXPECT_EQ(done.report.assumed.size(), 0u);
  const FaceTables faces = face_tables(*project_, "", {}, Coordinates::kWorld);
  EXPECT_EQ(faces.units, (project::SurfaceUnits{"m", "ft"}));
  EXPECT_EQ(faces.tables[0].vertices[1], (survey::WorldPoint{1200, 2100, -0.125}));
  EXPECT_THROW(face_tables(*project_, "", {}, Coordinates::kIndex), Error);
  // Another unit beside it cannot go into one file.
  import(tsurf("G", "s", "Elevation"));
  EXPECT_THROW(face_tables(*project_, "", {}, Coordinates::kWorld), Error);
  EXPECT_EQ(face_tables(*project_, "G", {}, Coordinates::kWorld, "ms").tables[0].vertices[0].z, -250);
  EXPECT_THROW(face_tables(*project_, "G", {}, Coordinates::kWorld, "m"), Error);
}

TEST_F(ImportSurface, ASurveyThatComesLaterTakesTheSurfacesInItsUnits) {
  create({});
  import(tsurf("seconds", "s", "Depth"));
  import(tsurf("feet", "ft", "Depth"));
  project_->set_survey(time_survey());
  EXPECT_TRUE(project_->mesh_is_stale(project_->fault("seconds").id));
  EXPECT_TRUE(face_tables(*project_, "", {}, Coordinates::kWorld).tables.empty());
  triangulate_fault(*project_, project_->fault("seconds"), {}, {});
  EXPECT_EQ(face_tables(*project_, "", {}, Coordinates::kWorld).tables.at(0).vertices[0].z, 250);
  try {
    triangulate_fault(*project_, project_->fault("feet"), {}, {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalid);
  }
}

TEST_F(ImportSurface, NamesThatTheProjectCannotHoldAreChangedAndTold) {
  create({});
  const std::string longest(300, 'x');
  const SurfacesImported done =
      import(tsurf("", "m", "Depth") + tsurf(longest, "m", "Depth") + tsurf("a\tb", "m", "Depth"));
  ASSERT_EQ(done.faults.size(), 3u);
  EXPECT_EQ(done.faults[0].fault, "some file");
  EXPECT_EQ(done.faults[1].fault, longest.substr(0, 190));
  EXPECT_EQ(done.faults[2].fault, "a b");
  EXPECT_EQ(done.report.renamed.size(), 3u);
}

TEST_F(ImportSurface, WhatGoesOutComesInTheSame) {
  create({});
  import(tsurf("F", "ft", "Elevation"));
  for (const bool up : {true, false}) {
    for (const std::string unit : {"ft", "m"}) {
      const FaceTables faces = face_tables(*project_, "F", {}, Coordinates::kWorld, unit);
      formats::gocad_tsurf::WriteOptions how;
      how.vertical_unit = faces.units.vertical;
      how.z_positive_up = up;
      formats::gocad_tsurf::write(folder_ / "out.ts", faces.tables, how);
      const auto back = formats::gocad_tsurf::read(folder_ / "out.ts");
      EXPECT_EQ(back.objects[0].surface.triangles, faces.tables[0].triangles);
      EXPECT_EQ(back.objects[0].vertical_unit, unit);
      for (std::size_t v = 0; v < 9; ++v) {
        EXPECT_NEAR(back.objects[0].surface.vertices[v].z, faces.tables[0].vertices[v].z, 0.5000001e-6);
      }
    }
  }
}

}  // namespace
}  // namespace footwall::tasks
