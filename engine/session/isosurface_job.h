// An isosurface on all ranks: read, extract, weld, measure, filter, and write as an HDF5 surface file
// (storage/surface/surface_file.h). The file's bytes depend on the volume and what is asked alone, not on the
// number of ranks or pillars.
#pragma once
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "engine/comm/communicator.h"
#include "engine/isosurface/parallel/pillars.h"
#include "engine/render/lit_surface.h"
#include "engine/session/visible_choice.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// From where an isosurface is looked at, where only what can be seen of it is wanted. On disk: {choice
// (visible_choice.h), camera, placement (camera_json.h), width, height, colour}.
struct VisibleView {
  VisibleChoice choice;
  render::Camera camera;
  render::Placement placement;  // from the volume's own index space to the scene
  int width = 0;
  int height = 0;
  render::Rgba colour = 0;  // in pictures after passes
};

// On disk as JSON: {footwall_isosurface: 1, volume, value, variant, pillars ("4x2x1", "auto"), coordinates
// ("world", "index"), cap, largest, min_area, velocity, visible (or null), output, result}, and volume_file
// where it is not empty.
struct IsosurfaceJob {
  std::filesystem::path volume;  // absolute, like the others
  std::filesystem::path output;  // takes its name when it is whole; empty: the surface is only measured
  std::filesystem::path result;  // written last, see run_isosurface()
  float value = 0;
  std::string variant = "bricks";                   // of engine/isosurface/registry.h
  std::optional<isosurface::Interleaving> pillars;  // none: chosen
  // Positions in the survey's X, Y and z (positive down), float64; else in its index space, float32.
  bool world = false;
  bool cap = false;
  std::uint64_t largest = 0;           // components to keep; 0: all
  double min_area = 0;                 // of a component, in the unit that areas are told in
  std::optional<double> velocity;      // m/s, for areas and volumes in a time survey
  std::string volume_file;             // what the output is to call the volume's file; empty: by its name
  std::optional<VisibleView> visible;  // none: the whole isosurface; else without cap, variant, pillars
};

// Throws kIo, kUnsupported (a path that is not UTF-8).
void write_isosurface_job(const IsosurfaceJob& job, const std::filesystem::path& path);
nlohmann::json json_of(const IsosurfaceJob& job);
// Throws kNotFound, kFormat.
IsosurfaceJob read_isosurface_job(const std::filesystem::path& path);
// what: names the job in errors.
IsosurfaceJob isosurface_job_from(const nlohmann::json& json, const std::string& what);

// Collective; the same Error on every rank, and then no file: what reading volumes throws, kUsage (no such
// variant), kCancelled on any
// rank, kMemory, kUnsupported for 2^32 vertices. The result is JSON: ranks, threads, pillars, vertices,
// triangles, components, closed_components, genus, euler, area, enclosed_volume (null unless every component
// is closed), unit ("m" or, in a time survey without velocity, "voxel"), boundary_edges{at_border, inside},
// non_manifold_edges, redundant_intersections, overlap_samples, samples_read, bytes_read, load_imbalance,
// busy_seconds{mean, max}, seconds{open, extract, weld, measure, write, total}. Of what can be seen there are
// no pillars, load_imbalance, busy_seconds, redundant_intersections, overlap_samples and samples_read, but
// mode, finished, uncovered_pixels, passes (visible_choice.h) and pass_layers, their number.
void run_isosurface(const comm::Communicator& parent, const std::filesystem::path& job_path,
                    const JobContext& context);
// The same; ranks give the same job.
void run_isosurface(const comm::Communicator& parent, const IsosurfaceJob& job, const JobContext& context);

}  // namespace footwall::session
