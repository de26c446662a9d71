#include "app/footwall-engine/isosurface_command.h"

#include "app/footwall-engine/running_job.h"
#include "engine/session/isosurface_job.h"
#include "storage/base/text.h"

namespace footwall::app {
namespace {

survey::Index size_from(const std::string& words) {
  const auto parts = text::split(words, 'x');
  survey::Index size{0, 0, 0};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = parts.size() == 3 ? text::integer(parts[axis]) : std::nullopt;
    if (!number || *number < 1) throw Error(ErrorCode::kUsage, "--size " + words + " is no size of a volume");
    size[axis] = *number;
  }
  return size;
}

}  // namespace

IsosurfaceCommand::IsosurfaceCommand(CLI::App& app)
    : extract_(app.add_subcommand("isosurface", "extracts an isosurface; footwall isosurface starts it")),
      bench_(
          app.add_subcommand("bench-isosurface", "times one by ranks; footwall bench isosurface starts it")) {
  extract_->add_option("JOB", job_, "what to extract, JSON")->required();
  bench_->add_option("RAW", run_.raw, "float32, samples fastest")->required();
  bench_->add_option("--size", size_, "IxJxK samples")->required();
  bench_->add_option("--value", run_.value)->required();
  bench_->add_option("--variant", run_.variant)->required();
  bench_->add_option("--pillars", pillars_, "comma separated")->required();
  bench_->add_option("--repeat", run_.repeats);
  bench_->add_option("--threads", run_.threads);
  bench_->add_flag("--no-normals", no_normals_);
  bench_->add_flag("--pyramid", run_.pyramid);
  bench_->add_option("--result", result_, "where the result is written, JSON")->required();
}

void IsosurfaceCommand::run(const comm::Communicator& world) {
  if (extract_->parsed()) {
    session::run_isosurface(world, job_, running_job(world));
    return;
  }
  world.collectively([&] {
    run_.size = size_from(size_);
    run_.normals = !no_normals_;
    for (const std::string_view one : text::split(pillars_, ','))
      run_.interleavings.push_back(isosurface::parse_interleaving(one));
  });
  tasks::run_ranks(world, run_, result_, running_job(world));
}

}  // namespace footwall::app
