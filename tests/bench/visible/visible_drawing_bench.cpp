// What a picture of only what can be seen costs against that of the whole surface, in one run:
//
//   bench_visible_drawing --nrrd avg152T1.nrrd --resample 256x256x145 --stretch 1.75 --value 80
//   mpiexec -n 2 bench_visible_drawing --synthetic sphere --repeat 21
//
// Every picture is compared with that of the whole surface. First come pictures that know of none before,
// then those that do. Times are medians of the slowest rank.
#include <omp.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "engine/comm/environment.h"
#include "engine/isosurface/brick_ranges.h"
#include "engine/isosurface/parallel/choose_pillars.h"
#include "engine/isosurface/visible/parallel/brick_pillars.h"
#include "engine/isosurface/visible/parallel/visible_picture_parallel.h"
#include "engine/synthetic/fields.h"
#include "engine/verify/visible_by_definition.h"
#include "storage/formats/nrrd.h"

namespace footwall {
namespace {

using isosurface::VisiblePass;
using isosurface::VisibleReport;

struct Options {
  std::string nrrd;
  std::string synthetic = "sphere";
  std::string resample;
  double stretch = 1;
  float value = NAN;
  std::vector<double> camera{30, 25, 1};
  int size = 1024;
  int repeat = 9;
  double budget = 0;
  int interleave = 8;
};

struct Volume {
  survey::Index size{0, 0, 0};
  isosurface::PageVector<float> values;
  isosurface::Field field() const { return {values.all(), size, {0, 0, 0}, size}; }
};

Volume copied(const std::vector<float>& values, const survey::Index& size) {
  Volume volume{size, {}};
  volume.values.resize_uninitialised(values.size());
  std::copy(values.begin(), values.end(), volume.values.data());
  return volume;
}

// Trilinear, the first and last samples stay where they are.
Volume resampled(const Volume& from, const survey::Index& size) {
  Volume to{size, {}};
  to.values.resize_uninitialised(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  std::size_t n = 0;
  survey::Index at{};
  for (at[0] = 0; at[0] < size[0]; ++at[0]) {
    for (at[1] = 0; at[1] < size[1]; ++at[1]) {
      for (at[2] = 0; at[2] < size[2]; ++at[2], ++n) {
        survey::Index low{};
        std::array<double, 3> share{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double place = static_cast<double>(at[axis]) * static_cast<double>(from.size[axis] - 1) /
                               static_cast<double>(size[axis] - 1);
          low[axis] = std::min(static_cast<std::int64_t>(place), from.size[axis] - 2);
          share[axis] = place - static_cast<double>(low[axis]);
        }
        double sum = 0;
        for (std::int64_t corner = 0; corner < 8; ++corner) {
          const std::int64_t i = corner & 1;
          const std::int64_t j = corner >> 1 & 1;
          const std::int64_t k = corner >> 2;
          const double weight = (i != 0 ? share[0] : 1 - share[0]) * (j != 0 ? share[1] : 1 - share[1]) *
                                (k != 0 ? share[2] : 1 - share[2]);
          const std::int64_t row = (low[0] + i) * from.size[1] + low[1] + j;
          sum += weight * from.values[static_cast<std::size_t>(row * from.size[2] + low[2] + k)];
        }
        to.values[n] = static_cast<float>(sum);
      }
    }
  }
  return to;
}

Volume volume_of(Options& options) {
  Volume volume;
  if (!options.nrrd.empty()) {
    const formats::nrrd::NrrdFile file(options.nrrd, std::filesystem::temp_directory_path(), {});
    const auto& axes = file.header().axes;
    const survey::Index size{axes[0].size, axes[1].size, axes[2].size};
    std::vector<float> values(static_cast<std::size_t>(size[0] * size[1] * size[2]));
    file.read_block(formats::nrrd::default_order(file.header()), {{0, 0, 0}, size}, values);
    volume = copied(values, size);
  } else {
    const synthetic::SampledField made = synthetic::make_field(options.synthetic, 256);
    if (std::isnan(options.value)) options.value = made.isovalue;
    volume = copied(made.values, {256, 256, 256});
  }
  if (options.resample.empty()) return volume;
  survey::Index size{};
  char x = 0;
  std::istringstream text(options.resample);
  text >> size[0] >> x >> size[1] >> x >> size[2];
  if (!text || std::min({size[0], size[1], size[2]}) < 2)
    throw Error(ErrorCode::kUsage, options.resample + " is no size", "give IxJxK");
  return resampled(volume, size);
}

// The whole surface on all ranks: each extracts its pillars and draws them.
class WholePicture {
 public:
  render::SurfaceLayer draw(comm::Communicator& world, const Volume& volume,
                            const isosurface::VisibleRequest& request) {
    const auto cut =
        isosurface::choose_interleaving(volume.size, world.size(), request.bricks, request.isovalue, true);
    isosurface::ParallelOptions options;
    options.bricks = &request.bricks;
    isosurface::extract_parallel(
        world, isosurface::Pillars(volume.size, world.size(), cut),
        [&](const survey::Box&) { return volume.field(); }, request.isovalue, options, {}, extraction_);
    std::vector<render::LitSurface> surfaces;
    runs_.clear();
    for (const isosurface::Piece& piece : extraction_.pieces) {
      std::vector<render::IdRun>& runs = runs_.emplace_back();
      const isosurface::Surface& surface = piece.surface;
      for (std::size_t row = 0; row + 1 < surface.row_first.size(); ++row) {
        if (surface.row_first[row + 1] == surface.row_first[row]) continue;
        const auto id = static_cast<render::PrimitiveId>(piece.row_numbers[row]);
        if (runs.empty() ||
            id != runs.back().first_id + (surface.row_first[row] - runs.back().first_triangle))
          runs.push_back({surface.row_first[row], id});
      }
      surfaces.push_back(
          {request.colour,
           request.placement,
           {reinterpret_cast<const render::Vec3f*>(surface.positions.data()), surface.positions.size()},
           {reinterpret_cast<const render::Vec3f*>(surface.normals.data()), surface.normals.size()},
           {reinterpret_cast<const render::TriangleIndices*>(surface.triangles.data()),
            surface.triangles.size()},
           runs});
    }
    render::ComposeReport report;
    return composer_.compose(world, surfaces, request.camera, {request.width, request.height, 1, {}}, report);
  }

 private:
  isosurface::Extraction extraction_;
  std::deque<std::vector<render::IdRun>> runs_;
  render::Composer composer_;
};

double processor_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2] * 1e3;
}

// Elapsed and processor time of the slowest rank.
struct Times {
  std::vector<double> elapsed;
  std::vector<double> busy;

  template <class Body>
  auto measure(comm::Communicator& world, Body&& body) {
    world.maximum(0.0);  // all begin together
    const double start = omp_get_wtime();
    const double busy_start = processor_seconds();
    auto result = body();
    const double mine = processor_seconds() - busy_start;
    elapsed.push_back(world.maximum(omp_get_wtime() - start));
    busy.push_back(world.maximum(mine));
    return result;
  }
  std::string text() const {
    return fmt::format("{:.1f} ms ({:.1f} of the processor)", median(elapsed), median(busy));
  }
};

void print(const VisibleReport& report, const verify::SurfacePicture& whole) {
  fmt::print("{} of {} triangles, {:.2f} times those that own a pixel{}\n", report.triangles, whole.triangles,
             static_cast<double>(report.triangles) / static_cast<double>(whole.owning_triangles),
             report.finished ? "" : ", ended by the budget");
  for (const VisiblePass& pass : report.passes) {
    const VisiblePass::Seconds& s = pass.seconds;
    fmt::print(
        "  {} bricks, {} triangles ({:.1f} % so far), load difference {:.1f} %, {} pixels open; ms: "
        "visibility "
        "{:.1f}, partition {:.1f}, assign {:.1f}, extract {:.1f}, composite {:.1f}\n",
        pass.cells, pass.triangles, pass.percent, 100 * pass.load_difference, pass.uncovered_pixels,
        s.visibility * 1e3, s.partition * 1e3, s.assign * 1e3, s.extract * 1e3, s.composite * 1e3);
  }
}

void run(comm::Communicator& world, Options& options) {
  const Volume volume = volume_of(options);
  const isosurface::BrickRanges ranges = isosurface::brick_ranges(volume.field(), 1);
  isosurface::VisibleRequest request;
  request.isovalue = options.value;
  request.volume_size = volume.size;
  request.bricks = ranges.tables();
  request.placement.linear[8] = options.stretch;
  request.colour = render::hex(0xc08040);
  request.width = request.height = options.size;
  if (options.budget > 0) request.budget_seconds = options.budget * 1e-3;
  const render::Vec3 far =
      request.placement({static_cast<double>(volume.size[0] - 1), static_cast<double>(volume.size[1] - 1),
                         static_cast<double>(volume.size[2] - 1)});
  request.camera = render::Camera::look(options.camera[0], options.camera[1], options.camera[2],
                                        render::Bounds{{0, 0, 0}, far}, 1, true);
  const isosurface::BrickPillars pillars(volume.field(), world.size(), world.rank(),
                                         {options.interleave, options.interleave, 1});
  const verify::SurfacePicture whole =
      verify::whole_surface_picture(volume.field(), request.isovalue, request.camera, request.placement,
                                    request.colour, request.width, request.height);
  WholePicture whole_picture;
  isosurface::VisiblePicture picture;
  std::array<Times, 3> times;  // the whole; not knowing of pictures before; knowing
  const auto check = [&](const render::SurfaceLayer& layer) {
    if (world.rank() != 0) return;
    std::vector<float> depths(static_cast<std::size_t>(options.size));
    std::vector<render::Rgba> colours(depths.size());
    for (int y = 0; y < options.size; ++y) {
      layer.row(y, depths, colours);
      const auto first = static_cast<std::ptrdiff_t>(y) * options.size;
      if (!std::equal(depths.begin(), depths.end(), whole.depths.begin() + first) ||
          !std::equal(colours.begin(), colours.end(), whole.colours.begin() + first))
        throw Error(ErrorCode::kInternal, fmt::format("row {} is not that of the whole surface", y));
    }
  };
  std::int64_t first_final = 0;
  for (int n = 0; n <= options.repeat; ++n) {
    check(times[0].measure(world, [&] { return whole_picture.draw(world, volume, request); }));
    for (const bool knows : {false, true}) {
      if (!knows) picture.forget();
      VisibleReport report;
      render::ComposeReport composed;
      const auto draw = [&] { return picture.draw(world, pillars.parts(), request, report, composed); };
      const render::SurfaceLayer layer = times[knows ? 2 : 1].measure(world, draw);
      if (report.finished) check(layer);
      if (n < options.repeat || world.rank() != 0) continue;
      fmt::print("{}\n", knows ? "after a picture like it:" : "first picture:");
      print(report, whole);
    }
    if (n == 0) {
      for (Times& each : times) each = {};
    }
  }
  // How much of it is there after the first wave.
  picture.forget();
  VisibleReport report;
  render::ComposeReport composed;
  picture.draw(world, pillars.parts(), request, report, composed,
               [&](int wave, const render::SurfaceLayer& layer) {
                 if (wave > 1 || world.rank() != 0) return;
                 std::vector<float> depths(static_cast<std::size_t>(options.size));
                 std::vector<render::Rgba> colours(depths.size());
                 for (int y = 0; y < options.size; ++y) {
                   layer.row(y, depths, colours);
                   for (std::size_t x = 0; x < depths.size(); ++x) {
                     const std::size_t at = static_cast<std::size_t>(y) * depths.size() + x;
                     first_final += depths[x] < 1 && depths[x] == whole.depths[at] ? 1 : 0;
                   }
                 }
               });
  if (world.rank() != 0) return;
  fmt::print("{:.1f} % of the final pixels after the first wave\n",
             100.0 * static_cast<double>(first_final) /
                 static_cast<double>(std::max<std::int64_t>(whole.pixels, 1)));
  fmt::print("{} ranks: whole {}; visible {}, after a picture like it {}\n", world.size(), times[0].text(),
             times[1].text(), times[2].text());
}

}  // namespace
}  // namespace footwall

int main(int argc, char** argv) {
  using namespace footwall;
  comm::Environment environment(argc, argv);
  Options options;
  CLI::App app{"Pictures of only what can be seen of an isosurface, measured"};
  app.add_option("--nrrd", options.nrrd, "Volume");
  app.add_option("--synthetic", options.synthetic, "sphere, gyroid or envelope, of 256^3 samples");
  app.add_option("--resample", options.resample, "IxJxK");
  app.add_option("--stretch", options.stretch, "Of samples against inlines and crosslines");
  app.add_option("--value", options.value, "Isovalue");
  app.add_option("--camera", options.camera, "Azimuth, elevation, zoom")->expected(3)->delimiter(',');
  app.add_option("--size", options.size, "Pixels each way");
  app.add_option("--repeat", options.repeat, "Pictures of each kind");
  app.add_option("--budget", options.budget, "Milliseconds");
  app.add_option("--interleave", options.interleave, "Pillars of each rank each way");
  CLI11_PARSE(app, argc, argv);
  try {
    comm::Communicator world(MPI_COMM_WORLD);
    run(world, options);
    return 0;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}
