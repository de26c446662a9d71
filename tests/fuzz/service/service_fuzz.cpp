// What clients send, as bytes: whatever they are, every call ends once, or waits as a command that the wire's
// conversions take or refuse. The first byte of an input chooses the method; the rest are its messages, each
// after two bytes that say how long it is.
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/stubs/logging.h>

#include <filesystem>

#include "engine/service/ranks.pb.h"
#include "engine/service/server/requests/methods.h"
#include "engine/service/server/requests/parcel.h"
#include "engine/service/server/requests/pillar_request.h"
#include "engine/service/wire.h"
#include "fuzz/target.h"
#include "scratch_folder.h"

namespace footwall::fuzz {
namespace {

using namespace service;

constexpr const char* kMethods[] = {"Status",    "Cancel",      "Shutdown",    "OpenVolume", "CloseVolume",
                                    "EditModel", "ReadModel",   "Extract",     "Live",       "FaceVoxels",
                                    "ReadBox",   "Interpolate", "Triangulate", "Isosurface", "Render",
                                    "RunTask",   "Nothing"};

// Counts what a client would get.
class CountedReply final : public Reply {
 public:
  void send(const google::protobuf::Message& message, const JobContext& /*job*/) override {
    is_good = is_good && ends == 0 && message.IsInitialized();
    ++sent;
  }
  void hint(const google::protobuf::Message& /*message*/) noexcept override {}
  void end(const std::optional<Error>& /*failure*/) noexcept override { ++ends; }
  void read_on() noexcept override { reading = true; }

  bool is_good = true;
  bool reading = true;
  int sent = 0;
  int ends = 0;
};

void convert(const v1::Faces& faces) {
  message_of(faces_from(faces));
}

// As the ranks read commands.
void convert(const v1::Command& command) {
  const auto tried = [](const auto& f) {
    try {
      f();
    } catch (const Error& error) {
      if (error.code() == ErrorCode::kInternal) throw;
    }
  };
  const auto edits = [&](const v1::EditBatch& batch) {
    for (const v1::Edit& edit : batch.edits()) {
      tried([&] { convert(edit.put()); });
      tried([&] { names_from(edit.remove()); });
      tried([&] { convert(edit.replace().faces()); });
    }
  };
  edits(command.edit_model());
  for (const v1::EditBatch& batch : command.live().batches()) edits(batch);
  tried([&] { options_from(command.extract().options(), 1); });
  tried([&] { options_from(command.live().options(), 1); });
  tried([&] { names_from(command.extract().only()); });
  tried([&] { message_of(box_from(command.read_box().box())); });
}

// Carries out what waits, as the dispatcher and the pillars' thread do.
void carry_out(CallQueue& queue, const std::shared_ptr<CountedReply>& reply) {
  while (!queue.entries().empty()) {
    const std::shared_ptr<Call> call = queue.next();
    const int ends = reply->ends;
    if (const auto pillars = std::dynamic_pointer_cast<PillarRequest>(call)) {
      pillars->run();
    } else {
      convert(call->take_command());
      call->finish(Error(ErrorCode::kUnsupported, "nothing is done here"));
    }
    queue.done();
    if (reply->ends == ends) reply->is_good = false;
  }
}

// Whether a message takes no more than was foreseen before it was unpacked.
bool takes_what_is_foreseen(const std::string& method, std::string_view wire) {
  const auto* const known = v1::StatusRequest::descriptor()->file()->service(0)->FindMethodByName(method);
  if (known == nullptr) return true;
  const auto message = new_message(*known->input_type());
  try {
    google::protobuf::io::ArrayInputStream stream(wire.data(), static_cast<int>(wire.size()), 7);
    const Parcel parcel(stream, static_cast<std::int64_t>(wire.size()), *known->input_type());
    parcel.unpack(*message);
    return static_cast<std::int64_t>(message->SpaceUsedLong()) <= parcel.memory_bytes();
  } catch (const Error& error) {
    const google::protobuf::LogSilencer quiet;
    return error.code() == ErrorCode::kInvalid &&
           !message->ParseFromArray(wire.data(), static_cast<int>(wire.size()));
  }
}

bool run(const std::string& bytes) {
  static const ScratchFolder scratch;  // files of tasks come and go in it
  if (bytes.empty()) return true;
  CallQueue queue;
  const auto services = std::make_shared<Services>(
      queue, [] { return ResidentStatus(); }, [] {});
  services->scratch = scratch.path();
  const auto reply = std::make_shared<CountedReply>();
  const auto method = static_cast<unsigned char>(bytes[0]) % std::size(kMethods);
  const auto request = make_request(std::string("/footwall.v1.Engine/") + kMethods[method], services, reply);
  if (!request) return kMethods[method] == std::string_view("Nothing");
  std::optional<Error> failure;
  try {
    std::size_t at = 1;
    while (std::exchange(reply->reading, false) && at + 2 <= bytes.size()) {
      const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(bytes[n]); };
      const std::size_t size = std::min<std::size_t>(byte(at) + 256U * byte(at + 1), bytes.size() - at - 2);
      if (!takes_what_is_foreseen(kMethods[method], std::string_view(bytes).substr(at + 2, size)))
        return false;
      google::protobuf::io::ArrayInputStream stream(bytes.data() + at + 2, static_cast<int>(size));
      reply->reading = false;
      request->received(stream, static_cast<std::int64_t>(size));
      at += 2 + size;
    }
    if (reply->reading || at == 1) request->no_more();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kInternal) throw;
    failure = error;
  }
  if (failure) {
    reply->end(failure);
    request->left();
  }
  carry_out(services->pillars, reply);
  carry_out(queue, reply);
  request->left();
  return reply->is_good;
}

std::string input(std::string_view method, const std::vector<std::string>& messages) {
  const auto* const at = std::find(std::begin(kMethods), std::end(kMethods), method);
  std::string bytes(1, static_cast<char>(at - std::begin(kMethods)));
  for (const std::string& message : messages) {
    bytes += static_cast<char>(message.size() % 256);
    bytes += static_cast<char>(message.size() / 256);
    bytes += message;
  }
  return bytes;
}

v1::EditBatch batch() {
  v1::EditBatch batch;
  batch.set_edit(7);
  const std::vector<extract::Face> faces{{1, 2, 3, {{{0, 256, 512}, {300, 400, 500}, {-1, -2, -3}}}},
                                         {1, 2, 4, {{{0, 0, 0}, {256, 0, 0}, {0, 256, 0}}}}};
  *batch.add_edits()->mutable_put() = message_of(faces);
  *batch.add_edits()->mutable_remove() = names_of(faces);
  batch.add_edits()->set_mesh("operation");
  batch.add_edits()->mutable_replace()->set_fault(1);
  *batch.mutable_edits(3)->mutable_replace()->mutable_faces() = message_of(faces);
  batch.add_edits()->set_clear(true);
  return batch;
}

constexpr const char* kGeometry =
    R"({"inlines":{"first":1,"step":1,"count":20},"crosslines":{"first":1,"step":1,"count":20},"samples":20,)"
    R"("z0":0,"interval":4,"domain":"time","vertical_unit":"ms","horizontal_unit":"m","crs":"","map":{"origin_x":0,)"
    R"("origin_y":0,"per_inline_x":25,"per_inline_y":0,"per_crossline_x":0,"per_crossline_y":25},"assumed":[]})";

template <class Request>
Request with_pillars() {
  Request request;
  request.set_geometry_json(kGeometry);
  for (int n = 0; n < 2; ++n) {
    v1::Pillar& pillar = *request.add_pillars();
    pillar.set_id(n + 1);
    for (int k = 1; k < 4; ++k) {
      for (const double value : {25.0 * (4 + 4 * n), 100.0 + k, 20.0 * k}) pillar.add_nodes(value);
    }
  }
  return request;
}

std::vector<std::string> made() {
  std::vector<std::string> all;
  for (const char* method : kMethods) all.push_back(input(method, {""}));
  const auto add = [&](const char* method, const auto&... messages) {
    all.push_back(input(method, {messages.SerializeAsString()...}));
  };
  add("EditModel", batch());
  v1::LiveRequest first;
  first.set_volume("0123456789abcdef");
  first.mutable_options()->add_compute("contrast");
  v1::LiveRequest later;
  *later.mutable_batch() = batch();
  add("Live", first, later, later);
  v1::ExtractRequest extract;
  extract.set_volume("0123456789abcdef");
  extract.mutable_options()->set_exchange("push");
  extract.mutable_only()->add_faults(1);
  extract.mutable_only()->add_owners(1);
  extract.mutable_only()->add_numbers(1);
  add("Extract", extract);
  v1::ReadBoxRequest box;
  box.set_volume("0123456789abcdef");
  box.mutable_box()->mutable_hi()->set_i(9);
  add("ReadBox", box);
  auto interpolate = with_pillars<v1::InterpolateRequest>();
  interpolate.set_every(2);
  add("Interpolate", interpolate);
  add("Triangulate", with_pillars<v1::TriangulateRequest>());
  v1::TaskInput task;
  task.mutable_task()->set_kind("batch");
  v1::TaskInput file;
  file.mutable_file()->set_name("a.txt");
  file.mutable_file()->set_bytes("some bytes");
  file.mutable_file()->set_last(true);
  v1::TaskInput start;
  start.set_start(true);
  add("RunTask", task, file, start);
  return all;
}

}  // namespace

Target fuzz_target() {
  return {{}, made(), run};
}

}  // namespace footwall::fuzz
