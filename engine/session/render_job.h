// Draws isosurfaces on all ranks: each reads and extracts its pillars of the volumes and draws them, pictures
// are merged (engine/render/composite), rank 0 writes the result as a layer for the picture that everything
// else is drawn into. The layer's bytes depend on the job alone, not on the number of ranks.
#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/comm/communicator.h"
#include "engine/render/camera.h"
#include "engine/render/lit_surface.h"
#include "engine/session/visible_choice.h"
#include "storage/base/job_context.h"

namespace footwall::session {

// On disk as JSON: {footwall_render: 1, width, height, threads, group_threshold, interleave, camera
// (camera_json.h), visible (visible_choice.h, or null), isosurfaces: [{volume, value, colour, placement}],
// layer, result}.
struct RenderJob {
  struct Isosurface {
    std::filesystem::path volume;  // absolute, like the others
    float value = 0;
    render::Rgba colour = 0;
    render::Placement placement;  // from the volume's own index space to the scene
  };
  int width = 0;  // of the layer
  int height = 0;
  int threads = 1;                              // of each rank
  std::optional<double> group_threshold = 0.1;  // none: by estimated times (group_options.h)
  std::string interleave = "auto";              // or "AxB", "AxBxC" (pillars.h)
  render::Camera camera;
  std::vector<Isosurface> isosurfaces;
  std::optional<VisibleChoice> visible;  // none: all of the isosurfaces is extracted
  std::filesystem::path layer;           // surface_layer.h
  // {ranks, seconds: {read, extract, group, project, rasterize, shade, merge, gather, total}, isosurfaces:
  // [{triangles}] or, of what can be seen, those of VisibleReport (visible_choice.h), bytes_sent, messages,
  // merged_bytes, merged_pixels, layer_bytes}, written last
  std::filesystem::path result;
};

// Throws kIo, kUnsupported (a path that is not UTF-8).
void write_render_job(const RenderJob& job, const std::filesystem::path& path);
nlohmann::json json_of(const RenderJob& job);
// Throws kNotFound, kFormat.
RenderJob read_render_job(const std::filesystem::path& path);
// what: names the job in errors.
RenderJob render_job_from(const nlohmann::json& json, const std::string& what);

// Collective; the same Error on every rank, and then no result: what reading volumes throws, kUsage for a
// picture that cannot be, kUnsupported for too many triangles, kMemory, kCancelled on any rank.
void run_render(const comm::Communicator& parent, const std::filesystem::path& job_path,
                const JobContext& context);
// The same; ranks give the same job.
void run_render(const comm::Communicator& parent, const RenderJob& job, const JobContext& context);

}  // namespace footwall::session
