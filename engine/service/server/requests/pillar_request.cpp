#include "engine/service/server/requests/pillar_request.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/pillars/interpolate.h"
#include "engine/pillars/triangulate.h"
#include "engine/pillars/world.h"
#include "engine/service/ranks.pb.h"
#include "engine/service/server/requests/failure.h"
#include "engine/service/wire.h"
#include "storage/survey/geometry_json.h"
#include "storage/survey/lattice.h"

namespace footwall::service {
namespace {

survey::Geometry geometry_from(const std::string& text) {
  try {
    return survey::geometry_from_json(nlohmann::json::parse(text));
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorCode::kInvalid, fmt::format("geometry_json is no survey's geometry: {}", error.what()),
                "give it as storage/survey/geometry_json.h has it; the Python package does");
  }
}

// Nodes are numbered through from 1.
std::vector<survey::Pillar> pillars_from(const google::protobuf::RepeatedPtrField<v1::Pillar>& messages) {
  std::vector<survey::Pillar> pillars;
  std::int64_t nodes = 0;
  for (const v1::Pillar& message : messages) {
    survey::Pillar& pillar = pillars.emplace_back();
    pillar.id = message.id();
    if (message.nodes_size() % 3 != 0) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("pillar {} has {} numbers", message.id(), message.nodes_size()),
                  "give x, y and z of each node");
    }
    for (int n = 0; n < message.nodes_size(); n += 3)
      pillar.nodes.push_back({++nodes, {message.nodes(n), message.nodes(n + 1), message.nodes(n + 2)}});
  }
  return pillars;
}

void append(const survey::WorldPoint& point, google::protobuf::RepeatedField<double>& to) {
  for (const double value : {point.x, point.y, point.z}) to.Add(value);
}

v1::Faces lattice_faces(const survey::Geometry& geometry, const pillars::FaultMesh& mesh,
                        std::span<const survey::WorldPoint> places, std::int64_t fault) {
  const survey::Lattice lattice(geometry);
  std::vector<extract::Face> faces;
  faces.reserve(mesh.faces.size());
  for (const pillars::MeshFace& face : mesh.faces) {
    extract::Face& out = faces.emplace_back(extract::Face{fault, face.panel, face.n, {}});
    for (std::size_t c = 0; c < 3; ++c)
      out.triangle[c] = lattice.from_world(places[static_cast<std::size_t>(face.vertices[c])]);
  }
  return message_of(faces);
}

double or_default(double value, double otherwise) {
  return value == 0 ? otherwise : value;
}

}  // namespace

v1::InterpolateReply interpolate(const v1::InterpolateRequest& request, const JobContext& job) {
  const survey::Geometry geometry = geometry_from(request.geometry_json());
  pillars::InterpolateOptions options;
  options.place_text = pillars::place_text_of(geometry);
  if (request.has_every()) options.every_lines = request.every();
  if (request.has_tolerance()) options.tolerance = request.tolerance();
  const std::vector<survey::Pillar> picked = pillars_from(request.pillars());
  const pillars::Interpolation made =
      pillars::interpolate(pillars::inputs_of(geometry, picked), options, std::nullopt, job);
  v1::InterpolateReply reply;
  for (const pillars::InterpolatedPillar& one : made.pillars) {
    v1::NewPillar& out = *reply.add_pillars();
    out.set_first(one.parents.a);
    out.set_second(one.parents.b);
    out.set_parameter(one.parents.parameter);
    for (const survey::IndexPoint& node : one.nodes) append(geometry.world_of(node), *out.mutable_nodes());
  }
  return reply;
}

v1::Triangulation triangulate(const v1::TriangulateRequest& request, const JobContext& job) {
  const survey::Geometry geometry = geometry_from(request.geometry_json());
  const std::vector<survey::Pillar> picked = pillars_from(request.pillars());
  const pillars::Options defaults;
  const pillars::Options options{
      or_default(request.detail(), defaults.detail), or_default(request.max_edge(), defaults.max_edge),
      or_default(request.tie(), defaults.tie_tolerance), pillars::place_text_of(geometry)};
  const pillars::FaultMesh mesh =
      pillars::triangulate(pillars::inputs_of(geometry, picked), options, std::nullopt, job);
  const std::vector<survey::WorldPoint> places = pillars::world_vertices(geometry, picked, mesh);
  v1::Triangulation reply;
  for (const survey::WorldPoint& place : places) append(place, *reply.mutable_vertices());
  for (const pillars::MeshFace& face : mesh.faces) {
    for (const std::int32_t vertex : face.vertices) reply.add_triangles(vertex);
  }
  *reply.mutable_faces() = lattice_faces(geometry, mesh, places, request.fault());
  for (const std::string& note : mesh.notes) reply.add_notes(utf8_of(note));
  return reply;
}

void PillarRequest::received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) {
  request_ = new_message(*method_.input_type());
  unpack(bytes, size, *request_);
  home().push(shared_from_this());
}

void PillarRequest::no_more() {
  throw Error(ErrorCode::kInvalid, fmt::format("the call has no {}", method_.input_type()->name()));
}

v1::Command PillarRequest::take_command() {
  return {};
}

void PillarRequest::answer() {
  context().check();
  if (const auto* picked = dynamic_cast<const v1::InterpolateRequest*>(request_.get())) {
    send(interpolate(*picked, context()));
    return;
  }
  v1::TriangulateReply reply;
  *reply.mutable_mesh() = triangulate(dynamic_cast<const v1::TriangulateRequest&>(*request_), context());
  send(reply);
}

void PillarRequest::run() noexcept {
  std::optional<Error> failure;
  try {
    answer();
  } catch (const Error& error) {
    failure = error;
  } catch (const std::bad_alloc&) {
    failure = Error(ErrorCode::kMemory, "not enough memory for these pillars");
  } catch (const std::exception& error) {
    failure = Error(ErrorCode::kInternal, error.what());
  }
  request_.reset();
  finish(failure);
}

void serve_pillars(Services& services) {
  while (const std::shared_ptr<Call> call = services.pillars.next()) {
    dynamic_cast<PillarRequest&>(*call).run();
    services.pillars.done();
  }
}

}  // namespace footwall::service
