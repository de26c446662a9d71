#include "storage/project/project.h"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <limits>

#include "storage/survey/lattice.h"
#include "unit/project/project_folder.h"

namespace footwall::project {
namespace {

using ProjectTest = ProjectFolder;
using survey::WorldPoint;

VolumeRecord volume_named(const std::string& name) {
  VolumeRecord v;
  v.name = name;
  v.file = name + ".h5";
  v.dims = {40, 50, 60};
  v.bytes = 5;
  v.checksum = "0123456789abcdef";
  v.min = -1.5;
  v.max = 2.5;
  v.null_count = 3;
  return v;
}

TEST_F(ProjectTest, TheSurveyAndSettingsComeBackExactly) {
  {
    auto project = Project::create(path_, small_survey());
    EXPECT_FALSE(project.read_only());
    EXPECT_EQ(project.schema_version(), 4);
    project.set_setting("velocity", "2000.5");
  }
  auto project = Project::open(path_, OpenMode::kRead);
  EXPECT_EQ(project.survey(), small_survey());
  EXPECT_EQ(project.setting("velocity"), "2000.5");
  EXPECT_FALSE(project.setting("nothing"));
  EXPECT_TRUE(project.check().ok());
}

TEST_F(ProjectTest, AProjectMayHaveNoSurveyAndGetOneLater) {
  auto project = Project::create(path_, {});
  EXPECT_FALSE(project.survey());
  project.set_survey(small_survey(), R"({"from":"f3.sgy"})");
  EXPECT_EQ(project.survey(), small_survey());
  EXPECT_EQ(project.survey_provenance(), R"({"from":"f3.sgy"})");
  project.add_volume(volume_named("amp"));
  auto other = small_survey();
  other.crs = "EPSG:23031";
  EXPECT_NO_THROW(project.set_survey(other));
  other.samples = 61;
  EXPECT_EQ(error_of([&] { project.set_survey(other); }).code(), ErrorCode::kInvalid);
}

TEST_F(ProjectTest, CreateRefusesAnExistingFile) {
  std::ofstream(path_) << "precious";
  EXPECT_EQ(error_of([&] { Project::create(path_, {}); }).code(), ErrorCode::kInvalid);
  EXPECT_EQ(std::filesystem::file_size(path_), 8U);
}

TEST_F(ProjectTest, VolumesAreFoundByNameOrAsTheOnlyOne) {
  auto project = Project::create(path_, small_survey());
  EXPECT_EQ(error_of([&] { project.volume(""); }).code(), ErrorCode::kNotFound);
  auto amp = volume_named("amp");
  amp.mean = std::numeric_limits<double>::quiet_NaN();
  amp.id = project.add_volume(amp);
  project.add_volume(volume_named("disc"));
  EXPECT_EQ(project.volume("").name, "amp");
  EXPECT_TRUE(std::isnan(project.volume("amp").mean));
  EXPECT_EQ(project.volume("disc").max, 2.5);
  EXPECT_FALSE(project.volume("disc").null_value);
  const Error error = error_of([&] { project.volume("x"); });
  EXPECT_NE(error.hint().find("'amp', 'disc'"), std::string::npos);
  EXPECT_THROW(project.add_volume(volume_named("amp")), Error);
  amp.null_value = -999.25;
  project.update_volume(amp);
  EXPECT_EQ(project.volume("amp").null_value, -999.25);
  amp.name = "disc";
  EXPECT_THROW(project.update_volume(amp), Error);
}

TEST_F(ProjectTest, AMovedVolumeIsMissedAndRelinked) {
  auto project = Project::create(path_, small_survey());
  project.add_volume(volume_named("amp"));
  ASSERT_EQ(project.missing().size(), 1U);
  EXPECT_EQ(project.missing()[0].reason, "not there");
  std::filesystem::create_directory(project.volumes_folder());
  std::ofstream(project.volumes_folder() / "amp.h5") << "four";
  EXPECT_NE(project.missing().at(0).reason.find("4 bytes, expected 5"), std::string::npos);
  std::filesystem::create_directory(folder_ / "elsewhere");
  std::ofstream(folder_ / "elsewhere" / "a.h5") << "fives";
  EXPECT_THROW(project.relink("amp", folder_ / "none"), Error);
  EXPECT_THROW(project.relink("amp", project.volumes_folder() / "amp.h5"), Error) << "another size";
  EXPECT_THROW(project.relink("amp", folder_ / "elsewhere" / "a.h5", "ffffffffffffffff"), Error);
  project.relink("amp", folder_ / "elsewhere" / "a.h5", "0123456789abcdef");
  EXPECT_TRUE(project.missing().empty());
  EXPECT_FALSE(std::filesystem::path(project.volume("amp").file).is_absolute());
}

MeshRecord strip(std::int32_t n, double scale) {
  MeshRecord mesh;
  mesh.algorithm = "strip 1";
  mesh.parameters = R"({"detail":0.5})";
  mesh.chart = Bytes(33, std::byte{5});
  for (std::int32_t v = 0; v < n; ++v) {
    const auto kind = v % 2 == 0 ? MeshVertex::Owner::kPillar : MeshVertex::Owner::kPanel;
    mesh.vertices.push_back({kind, 100 + v % 3, v, {v * scale, v % 2 * scale, v / 3.0}});
  }
  for (std::int32_t f = 0; f + 2 < n; ++f) mesh.faces.push_back({7 + f % 2, f, {f, f + 1, f + 2}});
  return mesh;
}

TEST_F(ProjectTest, ViewsAreKeptByNameOutsideUndo) {
  auto project = Project::create(path_, {});
  EXPECT_TRUE(project.views().empty());
  EXPECT_EQ(error_of([&] { project.view("front"); }).code(), ErrorCode::kNotFound);
  project.save_view({"top", "0,90,1", 0, ""});
  project.save_view({"front", "30,20,1", 2.5, ""});
  project.save_view({"front", "31,20,1", 3, ""});
  EXPECT_FALSE(project.undo());
  ASSERT_EQ(project.views().size(), 2U);
  EXPECT_EQ(project.views()[0].name, "front");
  EXPECT_EQ(project.view("front").camera, "31,20,1");
  EXPECT_EQ(project.view("front").exaggeration, 3);
  EXPECT_FALSE(project.view("front").when.empty());
  for (const ViewRecord& wrong : {ViewRecord{"", "0,0,1", 0, ""}, ViewRecord{"x", "0,0,1", -1, ""},
                                  ViewRecord{"x", "0,0,1", std::numeric_limits<double>::quiet_NaN(), ""}}) {
    EXPECT_EQ(error_of([&] { project.save_view(wrong); }).code(), ErrorCode::kInvalid);
  }
  project.delete_view("top");
  EXPECT_EQ(error_of([&] { project.delete_view("top"); }).hint(), "there are: front");
}

TEST_F(ProjectTest, AMeshComesBackExactlyAndIsReplaced) {
  auto project = Project::create(path_, small_survey());
  project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  EXPECT_FALSE(project.mesh(1));
  MeshRecord mesh = strip(100, 3.7);
  mesh.revision = 3;
  project.store_mesh(1, strip(50, 1));
  project.store_mesh(1, mesh);
  EXPECT_EQ(project.mesh(1), mesh);
  EXPECT_THROW(project.store_mesh(2, mesh), Error);
  mesh.faces[3].vertices[0] = 100;
  EXPECT_THROW(project.store_mesh(1, mesh), Error);
  mesh = strip(0, 1);
  project.store_mesh(1, mesh);
  EXPECT_EQ(project.mesh(1), mesh);
}

TEST_F(ProjectTest, AMillionTrianglesComeBackExactly) {
  auto project = Project::create(path_, small_survey());
  project.edit("add", [](Interpretation& it) { it.add_fault("F"); });
  const MeshRecord mesh = strip(1'000'002, 0.5);
  project.store_mesh(1, mesh);
  EXPECT_TRUE(project.mesh(1) == mesh);  // not EXPECT_EQ: it would print them
}

class Runs : public ProjectFolder {
 protected:
  void SetUp() override {
    ProjectFolder::SetUp();
    project_.emplace(Project::create(path_, small_survey()));
    project_->edit("add", [](Interpretation& it) {
      const auto fault = it.add_fault("F");
      it.add_pillar(fault, survey::PillarKind::kInterpreted, std::vector<WorldPoint>{{606100, 6074100, 50}});
    });
    mesh_ = strip(12, 0);
    for (MeshVertex& v : mesh_.vertices) v.position = {606100.0 + 30 * v.n, 6074100.0 + 20 * (v.n % 2), 50};
    mesh_.revision = project_->fault("F").revision;
    project_->store_mesh(1, mesh_);
    const std::vector<StatisticRecord> known{{"mean", 1, "amplitude", {}, {}, "seismic", "mean amplitude"},
                                             {"discontinuity", 2, "1", 0.0, 1.0, "viridis", ""}};
    project_->register_statistics(known);
    project_->register_statistics(known);
    EXPECT_EQ(project_->statistics(), known);
  }
  void TearDown() override {
    project_.reset();
    ProjectFolder::TearDown();
  }
  FaultRun result() const {
    FaultRun run;
    run.fault = 1;
    run.fault_name = "F";
    run.revision = mesh_.revision;
    const survey::Lattice lattice(small_survey());
    for (const MeshFace& face : mesh_.faces) {
      run.panels.push_back(face.panel);
      run.numbers.push_back(face.n);
      survey::LatticeTriangle triangle;
      for (int c = 0; c < 3; ++c) {
        triangle[c] = lattice.from_world(mesh_.vertices[static_cast<std::size_t>(face.vertices[c])].position);
      }
      run.lattice.push_back(triangle);
      run.statistics["mean"].push_back(face.n / 3.0);
    }
    run.statistics["mean"][2] = std::numeric_limits<double>::quiet_NaN();
    return run;
  }
  std::optional<Project> project_;
  MeshRecord mesh_;
};

TEST_F(Runs, StatisticsComeBackBitByBit) {
  const std::vector<FaultRun> faults{result()};
  RunRecord run;
  run.volume = "amp";
  run.volume_checksum = "0123456789abcdef";
  run.parameters = R"({"exchange":"reduce"})";
  const auto id = project_->add_run(run, faults);
  EXPECT_EQ(project_->run({}).id, id);
  EXPECT_EQ(project_->run(id).parameters, run.parameters);
  EXPECT_EQ(project_->run_faults(id), (std::vector<std::int64_t>{1}));
  const FaultRun back = project_->fault_statistics(id, 1);
  EXPECT_EQ(back.panels, faults[0].panels);
  EXPECT_EQ(back.lattice, faults[0].lattice);
  EXPECT_EQ(back.statistics.at("mean")[7], faults[0].statistics.at("mean")[7]);
  EXPECT_TRUE(std::isnan(back.statistics.at("mean")[2]));
  EXPECT_EQ(project_->run(id).name, fmt::format("run {}", id));
  project_->rename_run(id, "after the move");
  EXPECT_EQ(project_->run(id).name, "after the move");
  EXPECT_EQ(error_of([&] { project_->rename_run(id, "two\nlines"); }).code(), ErrorCode::kInvalid);
  project_->rename_run(id, "");
  EXPECT_EQ(project_->run(id).name, fmt::format("run {}", id));
  EXPECT_EQ(error_of([&] { project_->rename_run(id + 1, "x"); }).code(), ErrorCode::kNotFound);
  EXPECT_TRUE(project_->check().ok());
  project_->delete_run(id);
  EXPECT_THROW(project_->run(id), Error);
}

TEST_F(Runs, VoxelsOfFacesAreKeptAndGoWithTheirRun) {
  FaultRun fault = result();
  FaceVoxels voxels{"lot", R"({"snr":30})", {}, {}};
  for (std::size_t n = 0; n < fault.panels.size(); ++n) {
    voxels.bytes.resize(voxels.bytes.size() + n % 3, static_cast<std::byte>(n));
    voxels.ends.push_back(voxels.bytes.size());
  }
  fault.voxels = {voxels};
  const auto id = project_->add_run({}, std::vector<FaultRun>{fault});
  const std::vector<FaceVoxels> back = project_->face_voxels(id, 1);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].codec, "lot");
  EXPECT_EQ(back[0].parameters, voxels.parameters);
  EXPECT_EQ(back[0].ends, voxels.ends);
  EXPECT_EQ(back[0].bytes, voxels.bytes);
  EXPECT_TRUE(project_->check().ok());
  project_->delete_run(id);
  EXPECT_TRUE(project_->face_voxels(id, 1).empty());
  fault.voxels[0].ends.pop_back();
  EXPECT_EQ(error_of([&] { project_->add_run({}, std::vector<FaultRun>{fault}); }).code(),
            ErrorCode::kInvalid);
}

TEST_F(Runs, ARunIsRefusedWholeWhenAPartOfItIsWrong) {
  FaultRun short_one = result();
  short_one.statistics["mean"].pop_back();
  EXPECT_EQ(error_of([&] { project_->add_run({}, std::vector<FaultRun>{short_one}); }).code(),
            ErrorCode::kInvalid);
  FaultRun unknown = result();
  unknown.statistics["offset"] = unknown.statistics["mean"];
  EXPECT_EQ(error_of([&] { project_->add_run({}, std::vector<FaultRun>{unknown}); }).code(),
            ErrorCode::kInvalid);
  EXPECT_TRUE(project_->runs().empty());
}

TEST_F(Runs, LiveResultsReplaceThoseOfTheSameVolumeOnly) {
  RunRecord live;
  live.live = true;
  live.volume = "amp";
  project_->add_run(live, std::vector<FaultRun>{result()});
  live.volume = "disc";
  project_->add_run(live, std::vector<FaultRun>{result()});
  RunRecord named;
  named.volume = "amp";
  named.name = "kept";
  project_->add_run(named, std::vector<FaultRun>{result()});
  live.volume = "amp";
  const auto last = project_->add_run(live, std::vector<FaultRun>{result()});
  const auto runs = project_->runs();
  ASSERT_EQ(runs.size(), 3U);
  EXPECT_EQ(runs[0].volume, "disc");
  EXPECT_EQ(runs[1].name, "kept");
  EXPECT_EQ(runs[2].id, last);
}

TEST_F(Runs, OnlyFacesThatDifferAreStale) {
  const auto id = project_->add_run({}, std::vector<FaultRun>{result()});
  EXPECT_EQ(project_->stale_faces(id, 1), std::vector<bool>(mesh_.faces.size(), false));
  project_->edit("move", [&](Interpretation& it) { it.move_pillar(1, {0, 0, 4}); });
  EXPECT_EQ(project_->stale_faces(id, 1), std::vector<bool>(mesh_.faces.size(), true))
      << "not triangulated again";
  mesh_.revision = project_->fault("F").revision;
  mesh_.vertices[0].position.z += 4;
  project_->store_mesh(1, mesh_);
  std::vector<bool> first_only(mesh_.faces.size(), false);
  first_only[0] = true;
  EXPECT_EQ(project_->stale_faces(id, 1), first_only);
  project_->edit("delete", [&](Interpretation& it) { it.delete_fault(1); });
  EXPECT_EQ(project_->stale_faces(id, 1), std::vector<bool>(mesh_.faces.size(), true));
}

TEST_F(ProjectTest, TheTruthIsNoFault) {
  auto project = Project::create(path_, small_survey());
  project.add_truth({"T1", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, "listric");
  ASSERT_EQ(project.truth().size(), 1U);
  EXPECT_EQ(project.truth()[0].vertices[1], (WorldPoint{1, 0, 0}));
  EXPECT_TRUE(project.faults().empty());
  EXPECT_TRUE(project.surfaces().empty());
  EXPECT_TRUE(project.history().empty());
}

}  // namespace
}  // namespace footwall::project
