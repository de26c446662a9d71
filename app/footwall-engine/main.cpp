// The MPI program: runs one batch job or scripted workload, makes one attribute volume, isosurface or
// picture, on all ranks, serves clients, or checks that they work together;
// or, without MPI, keeps the launcher of others. Exit 0 done, 1 failed, 2 wrong
// usage, 75 told to make room (SIGTERM, SIGUSR1; run it again and it goes on), 130 cancelled; a failure is
// printed once.
#include <signal.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <span>

#include "app/footwall-engine/batch_command.h"
#include "app/footwall-engine/check_command.h"
#include "app/footwall-engine/isosurface_command.h"
#include "app/footwall-engine/render_command.h"
#include "app/footwall-engine/running_job.h"
#include "app/footwall-engine/serve_command.h"
#include "app/footwall-engine/visible_command.h"
#include "app/footwall-engine/workload_command.h"
#include "engine/comm/environment.h"
#include "engine/session/attribute.h"
#include "engine/session/batch.h"
#include "engine/session/keeper.h"
#include "engine/session/lonely_rank.h"

namespace {

using footwall::Error;
using footwall::ErrorCode;
using footwall::comm::Communicator;

int exit_code_of(ErrorCode code, bool told_to_make_room) {
  if (code == ErrorCode::kUsage) return 2;
  if (code != ErrorCode::kCancelled) return 1;
  return told_to_make_room ? footwall::session::kResumable : 130;
}

// Leaves together: the first rank to exit with a code other than 0 makes mpirun kill the others, and rank 0
// must have printed by then.
int leave(const Communicator& world, const Error& error) {
  // A batch system may tell some ranks only; all leave with one status.
  const bool make_room = world.maximum(std::int64_t{footwall::app::told_to_make_room() ? 1 : 0}) == 1;
  const int code = exit_code_of(error.code(), make_room);
  if (world.rank() == 0) {
    footwall::app::print_error(code == footwall::session::kResumable
                                   ? Error(ErrorCode::kCancelled, "the job was told to make room",
                                           "run it again: it goes on with the faults that are not done")
                                   : error);
  }
  MPI_Barrier(world.get());
  return code;
}

int run(Communicator& world, int argc, char** argv) {
  CLI::App app("The computing engine of Footwall; started by footwall under mpirun.");
  app.require_subcommand(1);
  std::string job;
  footwall::session::BatchOptions options;
  CLI::App* batch =
      app.add_subcommand("batch", "runs one job: reads JOB.json, writes part files and result.json");
  batch->add_option("JOB", job, "the job's JOB.json")->required();
  batch->add_option("--volume", options.volume, "where the volume is here (default: where the job says)");
  batch->add_option("--threads", options.threads, "of each rank (default: as the job says)");
  std::string folder;
  CLI::App* check =
      app.add_subcommand("check", "tells whether the ranks work together; footwall doctor asks it");
  check->add_option("FOLDER", folder, "where they write and read a file together")->required();
  footwall::app::WorkloadCommand workload(app);
  CLI::App* attribute =
      app.add_subcommand("attribute", "makes an attribute volume; footwall attribute starts it");
  attribute->add_option("JOB", job, "what to make, JSON")->required();
  footwall::app::IsosurfaceCommand isosurface(app);
  const footwall::app::RenderCommand render(app);
  const footwall::app::VisibleCommand visible(app);
  footwall::app::ServeCommand serve(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const int code = world.rank() == 0 ? app.exit(error) : 0;
    MPI_Barrier(world.get());
    return error.get_exit_code() == 0 ? code : 2;
  }
  if (check->parsed()) {
    footwall::app::check(world, folder);
  } else if (workload.parsed()) {
    workload.run(world);
  } else if (attribute->parsed()) {
    footwall::session::run_attribute(world, job, footwall::app::running_job(world));
  } else if (isosurface.parsed()) {
    isosurface.run(world);
  } else if (render.parsed()) {
    render.run(world);
  } else if (visible.parsed()) {
    visible.run(world);
  } else if (serve.parsed()) {
    serve.run(world);
  } else {
    footwall::app::batch(world, job, options);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char* const> arguments(argv, static_cast<std::size_t>(argc));
  if (footwall::session::is_keeper(arguments)) return footwall::session::keep(arguments);
  // No rank outlives the launcher that started it.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  footwall::app::heed_signals();
  int code = 1;
  try {
    const footwall::comm::Environment environment(argc, argv);
    Communicator world(MPI_COMM_WORLD);
    // `check` is there to tell what is wrong with the launcher.
    const bool asked_for_a_job = argc < 2 || std::string_view(argv[1]) != "check";
    if (asked_for_a_job) footwall::session::refuse_lonely_rank(world.size());
    try {
      code = run(world, argc, argv);
    } catch (const footwall::comm::AgreedError& error) {
      code = leave(world, error);
    } catch (...) {
      // This rank alone failed, in the middle of a communication: the others may be waiting for it.
      footwall::app::print_error(footwall::comm::current_error());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  } catch (...) {
    footwall::app::print_error(footwall::comm::current_error());
  }
  return code;
}
