#include "engine/tasks/workload/make.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine/mesh/model.h"
#include "engine/tasks/workload/grow.h"
#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::tasks {
namespace {

constexpr std::size_t kLimit = 100'000'000;

// The seed's sample run (appendix B.1.2): 16 meshes, 96 polygons, 2 cycles, 10 repeats.
WorkloadShape sample() {
  WorkloadShape shape;
  shape.size = {104, 104, 100};
  shape.area = 500;
  shape.faces = 96;
  shape.cycles = 2;
  shape.distance = 10;
  shape.repeats = 10;
  return shape;
}

struct Made {
  MadeWorkload facts;
  std::string text;
  Workload script;
};

Made made(const WorkloadShape& shape) {
  const ScratchFolder folder;
  Made m;
  m.facts = make_workload(shape, folder.path() / "w.fww");
  m.text = read_whole_file(folder.path() / "w.fww", kLimit);
  m.script = parse_script(m.text);
  return m;
}

survey::IndexPoint index_of(const mesh::LatticePoint& p) {
  return survey::Lattice::index_of(p);
}

TEST(Make, CountsTheOperationsOfTheSeedsSampleRun) {
  const Made m = made(sample());
  EXPECT_EQ(m.facts.operations.adds(), 1120);
  EXPECT_EQ(m.facts.operations.remove_faces, 1440);
  EXPECT_EQ(m.facts.operations.move_vertex, 1440);
  EXPECT_EQ(m.facts.operations.extract_all, 20);
  EXPECT_EQ(m.facts.operations.destroy_mesh, 160);
  const OperationCounts counts = counts_of(m.script);
  EXPECT_EQ(counts.adds(), 1120);
  EXPECT_EQ(counts.move_vertex, 1440);
  EXPECT_EQ(counts.extract_all, 20);
  EXPECT_EQ(m.script.size, (survey::Index{104, 104, 100}));
}

TEST(Make, EveryOperationIsAcceptedAndNothingIsLeft) {
  WorkloadShape shape = sample();
  shape.faces = 333;  // not a multiple of the meshes
  shape.repeats = 2;
  const Made m = made(shape);
  mesh::MeshSet meshes;
  for (const WorkloadRepeat& repeat : m.script.repeats) {
    double area = 0;
    for (const WorkloadStep& step : repeat.steps) {
      for (const mesh::Operation& operation : step.operations) ASSERT_NO_THROW(meshes.apply(operation));
      if (!step.extract) continue;
      EXPECT_EQ(meshes.mesh_count(), 16);
      EXPECT_EQ(meshes.face_count(), 333 + 16);
      if (&step == &repeat.steps.front()) {
        for (const mesh::FaceKey& face : meshes.faces()) area += area_of(meshes.triangle(face));
      }
    }
    EXPECT_NEAR(area / (333 + 16), shape.area, 0.01 * shape.area);
    EXPECT_EQ(meshes.mesh_count(), 0);
    EXPECT_EQ(meshes.face_count(), 0);
  }
}

TEST(Make, MeansAreNearWhatIsAskedAndFacesInside) {
  struct Asked {
    survey::Index size;
    double area;
    double outside;  // the part of the faces that may be outside
  };
  for (const Asked& asked :
       {Asked{{100, 100, 50}, 1000, 0.001}, Asked{{400, 400, 200}, 1000, 0}, Asked{{30, 30, 30}, 2, 0},
        Asked{{200, 200, 100}, 4, 0}, Asked{{64, 64, 1}, 100, 1}, Asked{{20, 20, 20}, 1e4, 1}}) {
    WorkloadShape shape = sample();
    shape.size = asked.size;
    shape.area = asked.area;
    shape.faces = 1000;
    shape.cycles = 1;
    shape.repeats = 1;
    const Made m = made(shape);
    EXPECT_NEAR(m.facts.mean_area, asked.area, kAreaTolerance * asked.area);
    EXPECT_LE(static_cast<double>(m.facts.faces_outside), asked.outside * static_cast<double>(m.facts.faces))
        << "area " << asked.area;
    EXPECT_EQ(m.facts.faces, 1016);
  }
}

TEST(Make, VerticesMoveByTheMeanDistance) {
  for (const double fraction : {1.0, 0.1, 0.0}) {
    WorkloadShape shape = sample();
    shape.faces = 2000;
    shape.cycles = 3;
    shape.repeats = 1;
    shape.size = {300, 300, 300};
    shape.move_fraction = fraction;
    const Made m = made(shape);
    mesh::MeshSet meshes;
    double sum = 0;
    std::size_t moves = 0, step_number = 0;
    for (const WorkloadStep& step : m.script.repeats[0].steps) {
      std::set<std::pair<mesh::MeshId, mesh::VertexId>> moved;
      for (const mesh::Operation& operation : step.operations) {
        if (const auto* move = std::get_if<mesh::MoveVertex>(&operation)) {
          const Vector way = at(index_of(move->to)) - at(meshes.mesh(move->mesh).position(move->vertex));
          sum += length(way);
          ++moves;
          EXPECT_TRUE(moved.insert({move->mesh, move->vertex}).second) << "once a cycle";
        }
        meshes.apply(operation);
      }
      const bool moves_now = step_number == 1 || step_number == 2;
      EXPECT_EQ(moved.size(), moves_now ? static_cast<std::size_t>(std::ceil(fraction * 2048)) : 0);
      ++step_number;
    }
    if (moves > 1000) {
      EXPECT_NEAR(sum / static_cast<double>(moves), shape.distance, 0.5);
    }
  }
}

TEST(Make, MovesBeforeTheFirstWhenAsked) {
  WorkloadShape shape = sample();
  shape.move_first = true;
  EXPECT_EQ(made(shape).facts.operations.move_vertex, 2880);
}

TEST(Make, IsTheSameForTheSameSeedAndOtherMeshesForEachRepeat) {
  WorkloadShape shape = sample();
  const Made first = made(shape);
  EXPECT_EQ(made(shape).text, first.text);
  EXPECT_NE(first.script.repeats[0].steps[0].operations[0], first.script.repeats[1].steps[0].operations[0]);
  shape.seed = 2;
  EXPECT_NE(made(shape).text, first.text);
}

TEST(Make, RefusesShapesThatCannotBe) {
  const ScratchFolder folder;
  const auto refused = [&](auto change) {
    WorkloadShape shape = sample();
    change(shape);
    try {
      make_workload(shape, folder.path() / "w.fww");
    } catch (const Error& error) {
      return error.code() == ErrorCode::kUsage && !std::filesystem::exists(folder.path() / "w.fww");
    }
    return false;
  };
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.area = 0; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.area = std::nan(""); }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.distance = -1; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.meshes = 0; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.faces = -1; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.cycles = 0; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.repeats = 0; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.move_fraction = 1.5; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.size[1] = 0; }));
  EXPECT_TRUE(refused([](WorkloadShape& s) { s.faces = 1'000'000'000; }));
}

}  // namespace
}  // namespace footwall::tasks
