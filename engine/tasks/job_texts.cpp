#include "engine/tasks/job_texts.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace footwall::tasks {
namespace {

// For Slurm: what is no letter, digit, dot or hyphen becomes a hyphen.
std::string plain(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') c = '-';
  }
  return name;
}

std::string time_limit(double seconds) {
  const auto minutes = static_cast<std::int64_t>(std::ceil((3 * seconds / 60 + 10) / 5)) * 5;
  return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

std::int64_t megabytes_of_cpu(const Forecast& forecast) {
  const double bytes = 1.25 * static_cast<double>(forecast.memory.total()) / forecast.threads;
  return static_cast<std::int64_t>(std::ceil(bytes / (1 << 20) / 100)) * 100;
}

constexpr const char* kScript = R"SH(#!/bin/bash
# Runs this job under Slurm: sbatch job.sbatch, in this folder. Written by footwall extract --write-job.
#SBATCH --job-name={name}
#SBATCH --ntasks={ranks}
#SBATCH --cpus-per-task={threads}
#SBATCH --mem-per-cpu={megabytes}M
#SBATCH --time={time}
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=job-%j.log
# Your site may want these (take one # away), or modules to load:
##SBATCH --partition=NAME
##SBATCH --account=NAME
# module load openmpi hdf5

# FOOTWALL_ENGINE: the engine, if it is not in PATH. FOOTWALL_VOLUME: the volume, if not where JOB.json says.
engine="${{FOOTWALL_ENGINE:-footwall-engine}}"
cd "${{SLURM_SUBMIT_DIR:-$(dirname "$0")}}" || exit 1
export OMPI_MCA_btl_vader_single_copy_mechanism=none

plugins="$(srun --mpi=list 2>&1)"
if grep -qw pmix <<<"$plugins"; then
  start=(srun --mpi=pmix)
elif grep -qw pmi2 <<<"$plugins"; then
  start=(srun --mpi=pmi2)
else
  start=(mpirun -n "${{SLURM_NTASKS:-{ranks}}}" --bind-to none)
fi
if [ "${{start[0]}}" = srun ]; then
  start+=(--ntasks="${{SLURM_NTASKS:-{ranks}}}" --cpus-per-task="${{SLURM_CPUS_PER_TASK:-{threads}}}" --kill-on-bad-exit=1)
fi

"${{start[@]}}" "$engine" batch JOB.json ${{FOOTWALL_VOLUME:+--volume "$FOOTWALL_VOLUME"}} &
ranks=$!
# Slurm tells this script (B:) two minutes before the end; srun and mpirun tell the ranks. A wait ends with a signal.
trap 'told=1; kill -USR1 "$ranks"' USR1 TERM
while :; do
  told=
  wait "$ranks"
  status=$?
  [ -n "$told" ] || break
done
# 75: Slurm wants the processors back, or the time is up. What is done is kept; the next run goes on from there.
if [ "$status" -eq 75 ] && [ -n "$SLURM_JOB_ID" ]; then
  scontrol requeue "$SLURM_JOB_ID"
fi
exit "$status"
)SH";

constexpr const char* kReadme =
    R"TXT(A batch job of Footwall: {faces} faces of {faults} faults, about {voxels} voxels of the volume {volume}.

Run it, in this folder, on any machine with footwall-engine:

    mpirun -n {ranks} footwall-engine batch JOB.json
    sbatch job.sbatch                        (Slurm; look at its first lines before)
    footwall batch JOB.json --ranks {ranks}       (starts mpirun or srun by itself)

{where}
The folder may be copied or moved first. Results are written to parts/. A run that was stopped goes on where it
was when it is started again. Then bring the folder back, and:

    footwall attach PROJECT.footwall THIS-FOLDER

Forecast for {ranks} ranks of {threads} threads: {memory} MB of memory a rank, {read} MB to read, {seconds:.1f} s,
from {based_on}.
)TXT";

}  // namespace

std::string job_script(const session::Job& job, const Forecast& forecast, const std::string& name) {
  return fmt::format(kScript, fmt::arg("name", plain("footwall-" + name)), fmt::arg("ranks", forecast.ranks),
                     fmt::arg("threads", job.options.threads),
                     fmt::arg("megabytes", megabytes_of_cpu(forecast)),
                     fmt::arg("time", time_limit(forecast.seconds.total())));
}

std::string job_readme(const session::Job& job, const Forecast& forecast) {
  const std::string where =
      job.volume.is_relative()
          ? fmt::format("The volume is here too, as {}.\n", job.volume.string())
          : fmt::format(
                "The volume is not in this folder, but at\n\n    {}\n\nWhere it is elsewhere, add --volume "
                "PATH (for sbatch: set FOOTWALL_VOLUME). Its checksum, {}, is compared.\n",
                job.volume.string(), job.volume_checksum);
  return fmt::format(kReadme, fmt::arg("faces", forecast.faces), fmt::arg("faults", job.faults.size()),
                     fmt::arg("voxels", forecast.voxels), fmt::arg("volume", job.volume_name),
                     fmt::arg("ranks", forecast.ranks), fmt::arg("threads", forecast.threads),
                     fmt::arg("where", where), fmt::arg("memory", forecast.memory.total() / 1000000),
                     fmt::arg("read", forecast.bytes_to_read / 1000000),
                     fmt::arg("seconds", forecast.seconds.total()), fmt::arg("based_on", forecast.based_on));
}

}  // namespace footwall::tasks
