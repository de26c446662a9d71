// A volume in three steps: what each takes, and what is left where one fails.
#include "engine/tasks/add_volume.h"

#include <gtest/gtest.h>

#include "engine/tasks/export_faces.h"
#include "made_source.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/volume/volume_reader.h"

namespace footwall::tasks {
namespace {

namespace fs = std::filesystem;

std::size_t files_in(const fs::path& folder) {
  if (!fs::exists(folder)) return 0;
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

ErrorCode code_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::kInternal;
}

class AddVolume : public testing::Test {
 protected:
  ScratchFolder folder_;
  project::Project project_ = project::Project::create(folder_.path() / "p.footwall", std::nullopt);
};

TEST_F(AddVolume, InThreeStepsIsInOne) {
  const VolumeSource source = made_source();
  {
    const auto planned = plan_volume(project_, "a", source.geometry);
    EXPECT_TRUE(project_.volumes().empty());
    write_planned(*planned, source, {});
    EXPECT_FALSE(project_.survey());
    list_planned(project_, *planned, source);
  }
  add_volume(project_, "b", source, {});
  const auto volumes = project_.volumes();
  ASSERT_EQ(volumes.size(), 2u);
  EXPECT_EQ(volumes[0].checksum, volumes[1].checksum);
  EXPECT_EQ(*project_.survey(), source.geometry);
  EXPECT_EQ(volume::VolumeReader(project_.volume_path(volumes[0])).info().dims, source.geometry.dims());
}

TEST_F(AddVolume, WhatIsNotListedLeavesNothing) {
  const VolumeSource source = made_source();
  plan_volume(project_, "a", source.geometry).reset();
  EXPECT_FALSE(fs::exists(project_.volumes_folder()));
  {
    const auto planned = plan_volume(project_, "a", source.geometry);
    write_planned(*planned, source, {});
    EXPECT_EQ(files_in(project_.volumes_folder()), 1u);
  }
  EXPECT_FALSE(fs::exists(project_.volumes_folder()));
}

TEST_F(AddVolume, TwoAtOnceNeverShareAFile) {
  const VolumeSource source = made_source();
  add_volume(project_, "first", source, {});
  const auto one = plan_volume(project_, "same", source.geometry);
  const auto two = plan_volume(project_, "same", source.geometry);
  EXPECT_EQ(files_in(project_.volumes_folder()), 3u);
  write_planned(*one, source, {});
  write_planned(*two, source, {});
  const auto listed = list_planned(project_, *one, source);
  EXPECT_EQ(code_of([&] { list_planned(project_, *two, source); }), ErrorCode::kInvalid);
  EXPECT_EQ(volume::VolumeReader(project_.volume_path(listed)).info().dims, source.geometry.dims());
}

TEST_F(AddVolume, ASurveySetMeanwhileIsNotOverwritten) {
  const VolumeSource source = made_source();
  const auto planned = plan_volume(project_, "late", source.geometry);
  write_planned(*planned, source, {});
  VolumeSource other = made_source();
  other.geometry.z0 = 0;
  add_volume(project_, "early", other, {});
  EXPECT_EQ(code_of([&] { list_planned(project_, *planned, source); }), ErrorCode::kInvalid);
  EXPECT_EQ(project_.survey()->z0, 0);
}

TEST_F(AddVolume, NamesAndGeometriesAreCheckedBeforeTheLongWork) {
  const VolumeSource source = made_source();
  add_volume(project_, "a", source, {});
  EXPECT_EQ(code_of([&] { plan_volume(project_, "a", source.geometry); }), ErrorCode::kInvalid);
  survey::Geometry finer = source.geometry;
  finer.interval = 2;
  EXPECT_EQ(code_of([&] { plan_volume(project_, "b", finer); }), ErrorCode::kInvalid);
  EXPECT_EQ(files_in(project_.volumes_folder()), 1u);
}

TEST_F(AddVolume, FacesGoOnlyIntoFormatsThatHoldThem) {
  EXPECT_EQ(code_of([&] { export_faces(project_, folder_.path() / "a.xyz", "", {}); }), ErrorCode::kUsage);
  const auto as_table = [&] { export_faces(project_, folder_.path() / "a.csv", "", {}); };
  EXPECT_EQ(code_of(as_table), ErrorCode::kNotFound);  // no fault
  project_.edit("New fault", [](project::Interpretation& now) { now.add_fault("F"); });
  EXPECT_EQ(code_of(as_table), ErrorCode::kInvalid);  // no face
  EXPECT_FALSE(fs::exists(folder_.path() / "a.csv"));
}

}  // namespace
}  // namespace footwall::tasks
