// Makes an attribute volume on all ranks: each computes its part of the volume and writes it into the file
// (volume_writer_parallel.h). The file's bytes depend on the input and the window alone, not on the number of
// ranks.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/extract/discontinuity_volume.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// On disk as JSON: {footwall_attribute: 1, kind: "discontinuity", window: "3x3x9", volume, output, result},
// and volume_file where it is not empty.
struct AttributeJob {
  std::filesystem::path volume;  // absolute, like the others
  std::filesystem::path output;  // the new volume file; takes its name when it is whole
  std::filesystem::path result;  // {ranks, seconds, checksum}, written last
  extract::Window window;
  std::string volume_file = {};  // what the output is to call the volume's file; empty: by its name
};

// Throws kIo, kUnsupported (a path that is not UTF-8).
void write_attribute_job(const AttributeJob& job, const std::filesystem::path& path);
nlohmann::json json_of(const AttributeJob& job);
// Throws kNotFound, kFormat.
AttributeJob read_attribute_job(const std::filesystem::path& path);
// what: names the job in errors.
AttributeJob attribute_job_from(const nlohmann::json& json, const std::string& what);

// Collective; the same Error on every rank, and then no file: what reading and writing volumes throws,
// kCancelled on any rank. Each rank holds what the writer does, and of the old volume at most
// four times what is needed for a block.
void run_attribute(const comm::Communicator& parent, const std::filesystem::path& job_path,
                   const JobContext& context);
// The same; ranks give the same job.
void run_attribute(const comm::Communicator& parent, const AttributeJob& job, const JobContext& context);

}  // namespace footwall::session
