#include "engine/service/client/engine_client.h"

#include <fmt/format.h>
#include <grpc/grpc.h>
#include <grpc/support/log.h>
#include <grpcpp/grpcpp.h>

#include <condition_variable>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <optional>
#include <thread>

#include "engine/service/client/detail/answers.h"
#include "engine/service/client/detail/inflate.h"
#include "engine/service/client/detail/live_stream.h"
#include "engine/service/engine.grpc.pb.h"
#include "engine/service/words_on_the_wire.h"
#include "storage/base/error.h"

namespace footwall::service {
namespace {

constexpr std::chrono::milliseconds kPatience{1900};
constexpr int kLargestMessage = 64 << 20;
constexpr std::size_t kFilePiece = std::size_t{1} << 20;

// gRPC prints its own words on standard error, which say less than ours. And it is kept for the life of the
// program: where its last object goes while a call is being put away, its shutdown waits ten seconds for
// that.
void prepare_grpc() {
  [[maybe_unused]] static const bool kOnce = [] {
    grpc_init();
    if (std::getenv("GRPC_VERBOSITY") == nullptr)
      gpr_set_log_verbosity(static_cast<gpr_log_severity>(GPR_LOG_SEVERITY_ERROR + 1));
    return true;
  }();
}

grpc::ChannelArguments arguments_for_an_engine() {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(kLargestMessage);
  // A connection of its own, which does not wait because another one failed before.
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 1000);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  // An end of the process is told by the system, at once on this machine. Pings find an engine that hangs,
  // and a machine or a network that is gone.
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, kPingMilliseconds);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kPingPatienceMilliseconds);
  arguments.SetInt(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  return arguments;
}

std::shared_ptr<grpc::Channel> channel_to(const Connection& connection) {
  prepare_grpc();
  grpc::ChannelArguments arguments = arguments_for_an_engine();
  if (connection.address.starts_with("unix:"))
    return grpc::CreateCustomChannel(connection.address, grpc::InsecureChannelCredentials(), arguments);
  grpc::SslCredentialsOptions tls;
  tls.pem_root_certs = connection.certificate;
  arguments.SetSslTargetNameOverride(kCertificateName);
  return grpc::CreateCustomChannel(connection.address.substr(std::string("tcp:").size()),
                                   grpc::SslCredentials(tls), arguments);
}

Error no_connection(const Connection& connection, const grpc::Status& status) {
  const std::string& why = status.error_message();
  const auto says = [&](const char* words) { return why.find(words) != std::string::npos; };
  if (says("handshake failed") || says("Handshake failed") || says("certificate") || says("Peer name")) {
    return {ErrorCode::kInvalid, "what answers at " + connection.address + " does not have the certificate",
            "use the connection file of the engine that runs now"};
  }
  const std::string there = connection.host.empty() ? "" : " on " + connection.host;
  // Somebody has the socket, or a machine is silent.
  const bool silent = status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED || says("timed out");
  if (silent && !says("refused") && !says("No such")) {
    return {ErrorCode::kEngine, "the engine at " + connection.address + " does not answer",
            "it hangs, or the way to it is broken: look at its process" +
                (connection.process > 0 ? " " + std::to_string(connection.process) : "") + there +
                ", end it, and start it again with footwall serve"};
  }
  return {ErrorCode::kEngine, "the engine has ended: nobody answers at " + connection.address,
          "start it again" + there + " with footwall serve"};
}

// Over a connection of its own.
bool answers(const Connection& connection) {
  const auto channel = channel_to(connection);
  const auto end = std::chrono::system_clock::now() + std::chrono::milliseconds(kPingPatienceMilliseconds);
  grpc::ClientContext context;
  context.AddMetadata(kTokenMetadata, connection.token);
  context.set_deadline(end);
  v1::StatusReply reply;
  return v1::Engine::NewStub(channel)->Status(&context, {}, &reply).ok();
}

void take_progress(const v1::Progress& progress, const JobContext& job) {
  job.report(progress.fraction(), progress.phase(), progress.amounts());
}

}  // namespace

struct EngineClient::State {
  explicit State(const Connection& to)
      : connection(to), channel(channel_to(to)), stub(v1::Engine::NewStub(channel)) {}

  void prepare(grpc::ClientContext& context) const { context.AddMetadata(kTokenMetadata, connection.token); }

  // A call with one answer. deadline: of calls that are answered at once.
  template <class Reply, class Start>
  Reply ask(const Start& start, bool at_once) const {
    grpc::ClientContext context;
    prepare(context);
    if (at_once) context.set_deadline(std::chrono::system_clock::now() + kPatience);
    Reply reply;
    throw_unless_ok(finish(context, reply, start), context);
    return reply;
  }
  template <class Reply, class Start>
  static grpc::Status finish(grpc::ClientContext& context, Reply& reply, const Start& start) {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<grpc::Status> ended;
    start(&context, &reply, [&](const grpc::Status& status) {
      const std::scoped_lock lock(mutex);
      ended = status;
      changed.notify_all();
    });
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return ended.has_value(); });
    return *ended;
  }

  // A call with a stream of answers, each of which is handed over.
  template <class Reply, class Start, class Take>
  void listen(const Start& start, const Take& take, const JobContext& job) const {
    job.check();
    grpc::ClientContext context;
    prepare(context);
    AnswerStream<Reply> answers(context, [&](auto* reactor) { start(&context, reactor); });
    Reply reply;
    while (answers.next(reply, job)) take(reply);
    answers.throw_unless_ok();
  }

  Connection connection;
  std::shared_ptr<grpc::Channel> channel;
  std::unique_ptr<v1::Engine::Stub> stub;
};

EngineClient::EngineClient(const Connection& connection) : state_(std::make_unique<State>(connection)) {
  grpc::ClientContext context;
  state_->prepare(context);
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  const v1::StatusRequest request;
  v1::StatusReply reply;
  const grpc::Status status = State::finish(context, reply, [&](auto* c, auto* r, auto done) {
    state_->stub->async()->Status(c, &request, r, done);
  });
  if (status.error_code() == grpc::StatusCode::UNAVAILABLE ||
      status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) {
    throw no_connection(connection, status);
  }
  throw_unless_ok(status, context);
}

EngineClient::~EngineClient() = default;

v1::StatusReply EngineClient::status() {
  const v1::StatusRequest request;
  return state_->ask<v1::StatusReply>(
      [&](auto* context, auto* reply, auto done) {
        state_->stub->async()->Status(context, &request, reply, done);
      },
      true);
}

bool EngineClient::cancel(std::uint64_t job) {
  v1::CancelRequest request;
  request.set_job(job);
  return state_
      ->ask<v1::CancelReply>(
          [&](auto* context, auto* reply, auto done) {
            state_->stub->async()->Cancel(context, &request, reply, done);
          },
          true)
      .found();
}

void EngineClient::shutdown() {
  const v1::ShutdownRequest request;
  state_->ask<v1::ShutdownReply>(
      [&](auto* context, auto* reply, auto done) {
        state_->stub->async()->Shutdown(context, &request, reply, done);
      },
      true);
}

v1::OpenVolumeInfo EngineClient::open_volume(const v1::VolumeName& volume, const JobContext& job) {
  v1::OpenVolumeRequest request;
  *request.mutable_volume() = volume;
  v1::OpenVolumeInfo opened;
  state_->listen<v1::OpenVolumeReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->OpenVolume(context, &request, reactor); },
      [&](v1::OpenVolumeReply& reply) {
        if (reply.has_opened()) opened.Swap(reply.mutable_opened());
        if (reply.has_progress()) take_progress(reply.progress(), job);
      },
      job);
  return opened;
}

void EngineClient::close_volume(const std::string& volume) {
  v1::CloseVolumeRequest request;
  request.set_volume(volume);
  state_->ask<v1::CloseVolumeReply>(
      [&](auto* context, auto* reply, auto done) {
        state_->stub->async()->CloseVolume(context, &request, reply, done);
      },
      false);
}

v1::EditModelReply EngineClient::edit(const v1::EditBatch& batch) {
  return state_->ask<v1::EditModelReply>(
      [&](auto* context, auto* reply, auto done) {
        state_->stub->async()->EditModel(context, &batch, reply, done);
      },
      false);
}

v1::Faces EngineClient::model(std::span<const std::int64_t> faults) {
  v1::ReadModelRequest request;
  request.mutable_faults()->Add(faults.begin(), faults.end());
  v1::Faces all;
  state_->listen<v1::ReadModelReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->ReadModel(context, &request, reactor); },
      [&](const v1::ReadModelReply& reply) { all.MergeFrom(reply.faces()); }, {});
  return all;
}

v1::ExtractDone EngineClient::extract(const v1::ExtractRequest& request,
                                      const std::function<void(const v1::FaceNumbers&)>& numbers,
                                      const JobContext& job) {
  v1::ExtractDone done;
  state_->listen<v1::ExtractReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->Extract(context, &request, reactor); },
      [&](v1::ExtractReply& reply) {
        if (reply.has_numbers() && numbers) numbers(reply.numbers());
        if (reply.has_done()) done.Swap(reply.mutable_done());
        if (reply.has_progress()) take_progress(reply.progress(), job);
      },
      job);
  return done;
}

std::vector<v1::FaceVoxelsReply> EngineClient::face_voxels(const v1::FaceVoxelsRequest& request) {
  std::vector<v1::FaceVoxelsReply> replies;
  state_->listen<v1::FaceVoxelsReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->FaceVoxels(context, &request, reactor); },
      [&](v1::FaceVoxelsReply& reply) { replies.push_back(std::move(reply)); }, {});
  return replies;
}

std::vector<float> EngineClient::read_box(const v1::ReadBoxRequest& request, const JobContext& job) {
  const auto length = [](std::int64_t lo, std::int64_t hi) {
    constexpr std::int64_t kMost = std::int64_t{1} << 20;
    if (lo < 0 || hi <= lo || hi - lo > kMost)
      throw Error(ErrorCode::kInvalid, "the box is empty, or reaches out of the volume");
    return static_cast<std::size_t>(hi - lo);
  };
  const v1::Index& lo = request.box().lo();
  const v1::Index& hi = request.box().hi();
  const std::size_t count = length(lo.i(), hi.i()) * length(lo.j(), hi.j()) * length(lo.k(), hi.k());
  const std::size_t bytes = count * sizeof(float);
  std::string values;
  const Error wrong(ErrorCode::kEngine, "the engine sent another number of values than the box has");
  state_->listen<v1::ReadBoxReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->ReadBox(context, &request, reactor); },
      [&](const v1::ReadBoxReply& reply) {
        const std::size_t room = bytes - values.size();
        if (request.compress()) {
          inflate(reply.values(), room, values);
        } else {
          if (reply.values().size() > room) throw wrong;
          values += reply.values();
        }
      },
      job);
  if (values.size() != bytes) throw wrong;
  std::vector<float> numbers(count);
  std::memcpy(numbers.data(), values.data(), bytes);
  return numbers;
}

v1::IsosurfaceDone EngineClient::isosurface(const v1::IsosurfaceRequest& request,
                                            const std::function<void(const v1::SurfacePiece&)>& piece,
                                            const JobContext& job) {
  v1::IsosurfaceDone done;
  state_->listen<v1::IsosurfaceReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->Isosurface(context, &request, reactor); },
      [&](v1::IsosurfaceReply& reply) {
        if (reply.has_piece() && piece) piece(reply.piece());
        if (reply.has_done()) done.Swap(reply.mutable_done());
        if (reply.has_progress()) take_progress(reply.progress(), job);
      },
      job);
  return done;
}

v1::RenderDone EngineClient::render(const v1::RenderRequest& request,
                                    const std::function<void(const v1::RenderReply&)>& part,
                                    const JobContext& job) {
  v1::RenderDone done;
  state_->listen<v1::RenderReply>(
      [&](auto* context, auto* reactor) { state_->stub->async()->Render(context, &request, reactor); },
      [&](v1::RenderReply& reply) {
        if (reply.has_progress()) take_progress(reply.progress(), job);
        if ((reply.has_tile() || reply.has_pass()) && part) part(reply);
        if (reply.has_done()) done.Swap(reply.mutable_done());
      },
      job);
  return done;
}

std::unique_ptr<EngineClient::LiveStream> EngineClient::live(
    const std::string& volume, const v1::ExtractOptions& options,
    std::function<void(const v1::LiveReply&)> answer) {
  v1::LiveRequest first;
  first.set_volume(volume);
  *first.mutable_options() = options;
  return open_live_stream(state_->channel, *state_->stub, state_->connection.token, std::move(first),
                          std::move(answer),
                          [connection = state_->connection] { return answers(connection); });
}

std::string EngineClient::run_task(const v1::Task& task, std::span<const InputFile> in,
                                   const std::function<void(const v1::FilePiece&)>& out,
                                   const JobContext& job) {
  job.check();
  const auto talk = Conversation<v1::TaskInput, v1::TaskOutput>::open(
      state_->channel, [this](grpc::ClientContext& context) { state_->prepare(context); },
      [this](grpc::ClientContext* context, auto* reactor) {
        state_->stub->async()->RunTask(context, reactor);
      },
      [this] { return answers(state_->connection); });
  // A message is sent only when those before it are nearly through, so that large files are never held whole.
  const auto send = [&](v1::TaskInput message) {
    return talk->send(std::move(message)) && talk->wait_for_room(1, job);
  };
  v1::TaskInput first;
  *first.mutable_task() = task;
  bool listens = send(std::move(first));
  for (std::size_t n = 0; n < in.size() && listens; ++n) {
    std::ifstream file(in[n].path, std::ios::binary);
    if (!file) throw io_error("read", in[n].path, errno);
    bool last = false;
    while (!last && listens) {
      v1::TaskInput message;
      v1::FilePiece& piece = *message.mutable_file();
      piece.set_name(in[n].name);
      std::string& bytes = *piece.mutable_bytes();
      bytes.resize(kFilePiece);
      file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      if (file.bad()) throw io_error("read", in[n].path, errno);
      bytes.resize(static_cast<std::size_t>(file.gcount()));
      last = file.eof();
      piece.set_last(last);
      listens = send(std::move(message));
    }
  }
  if (listens) {
    v1::TaskInput start;
    start.set_start(true);
    send(std::move(start));
  }
  talk->send_no_more();
  std::string result;
  v1::TaskOutput output;
  while (talk->next(output, job)) {
    if (output.has_progress()) take_progress(output.progress(), job);
    if (!output.has_file()) continue;
    if (output.file().name() == "result.json") result += output.file().bytes();
    out(output.file());
  }
  talk->throw_unless_ok();
  return result;
}

}  // namespace footwall::service
