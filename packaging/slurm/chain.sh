#!/bin/bash
# There and back in one command, from a login node: writes the job into FOLDER, waits for Slurm, attaches the results.
#   chain.sh PROJECT.footwall FOLDER [options of footwall extract]
set -e
project="${1:?name a project}"
folder="${2:?name a folder that does not exist}"
footwall extract "$project" --write-job "$folder" "${@:3}"
(cd "$folder" && sbatch --wait job.sbatch)
footwall attach "$project" "$folder"
