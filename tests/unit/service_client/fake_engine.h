// An engine without ranks: the client's tests tell it by the volume's name what to do.
#pragma once
#include <grpcpp/grpcpp.h>
#include <unistd.h>
#include <zlib.h>

#include <atomic>
#include <string>
#include <thread>

#include "engine/service/engine.grpc.pb.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {

class FakeEngine final : public v1::Engine::Service {
 public:
  explicit FakeEngine(std::string token) : token_(std::move(token)) {}

  // How many calls were left by their clients.
  std::atomic<int> left{0};
  std::atomic<bool> stopped{false};

  grpc::Status Status(grpc::ServerContext* context, const v1::StatusRequest*,
                      v1::StatusReply* reply) override {
    if (!knows(*context)) return stranger();
    reply->set_version("fake");
    reply->set_process(getpid());
    reply->set_edit(edit_);
    reply->set_faces(faces_);
    return grpc::Status::OK;
  }
  grpc::Status Shutdown(grpc::ServerContext* context, const v1::ShutdownRequest*,
                        v1::ShutdownReply*) override {
    if (!knows(*context)) return stranger();
    stopped = true;
    return grpc::Status::OK;
  }
  grpc::Status EditModel(grpc::ServerContext* context, const v1::EditBatch* batch,
                         v1::EditModelReply* reply) override {
    if (!knows(*context)) return stranger();
    edit_ = batch->edit();
    for (const v1::Edit& edit : batch->edits()) {
      if (edit.clear()) faces_ = 0;
      faces_ += edit.put().faults_size() + edit.replace().faces().faults_size();
    }
    reply->set_edit(edit_);
    reply->set_faces(faces_);
    return grpc::Status::OK;
  }
  // A checksum of zeros is too large.
  grpc::Status OpenVolume(grpc::ServerContext* context, const v1::OpenVolumeRequest* request,
                          grpc::ServerWriter<v1::OpenVolumeReply>* writer) override {
    if (!knows(*context)) return stranger();
    if (request->volume().checksum() == "0000000000000000") return refused(*context);
    v1::OpenVolumeReply reply;
    reply.mutable_progress()->set_fraction(0.5);
    writer->Write(reply);
    reply.mutable_opened()->set_volume(request->volume().checksum());
    reply.mutable_opened()->set_path(request->volume().path());
    writer->Write(reply);
    return grpc::Status::OK;
  }
  // "bad": refuses. "waiting": never ends. "endless": never stops sending. Else two pieces, and done.
  grpc::Status Extract(grpc::ServerContext* context, const v1::ExtractRequest* request,
                       grpc::ServerWriter<v1::ExtractReply>* writer) override {
    if (!knows(*context)) return stranger();
    v1::ExtractReply reply;
    reply.mutable_progress()->set_fraction(0.25);
    reply.mutable_progress()->set_phase("voxelize");
    writer->Write(reply);
    if (request->volume() == "bad") return refused(*context);
    reply.mutable_numbers()->add_count(7);
    while (request->volume() == "endless" && writer->Write(reply)) {
    }
    while (request->volume() == "waiting" && !context->IsCancelled())
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (context->IsCancelled()) {
      ++left;
      return {grpc::StatusCode::CANCELLED, "left"};
    }
    writer->Write(reply);
    writer->Write(reply);
    reply.mutable_done()->set_faces(2);
    writer->Write(reply);
    return grpc::Status::OK;
  }
  // 0, 1, 2 ..., in two pieces. "short": one too few. "bomb": a stream of zeros without end.
  grpc::Status ReadBox(grpc::ServerContext* context, const v1::ReadBoxRequest* request,
                       grpc::ServerWriter<v1::ReadBoxReply>* writer) override {
    if (!knows(*context)) return stranger();
    const v1::Index& hi = request->box().hi();
    std::vector<float> values(static_cast<std::size_t>(hi.i() * hi.j() * hi.k()));
    for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<float>(n);
    if (request->volume() == "short") values.pop_back();
    if (request->volume() == "bomb") values.assign(values.size() * 1000, 0);
    const std::size_t half = values.size() / 2;
    for (const auto& [first, count] :
         {std::pair(std::size_t{0}, half), std::pair(half, values.size() - half)}) {
      std::string bytes(reinterpret_cast<const char*>(values.data() + first), count * sizeof(float));
      v1::ReadBoxReply reply;
      reply.set_values(request->compress() ? packed(bytes) : bytes);
      writer->Write(reply);
    }
    return grpc::Status::OK;
  }
  grpc::Status Live(grpc::ServerContext* context,
                    grpc::ServerReaderWriter<v1::LiveReply, v1::LiveRequest>* stream) override {
    if (!knows(*context)) return stranger();
    v1::LiveRequest request;
    while (stream->Read(&request)) {
      if (!request.has_batch()) continue;
      v1::LiveReply reply;
      reply.set_edit(request.batch().edit());
      if (request.batch().edits().empty()) return refused(*context);
      stream->Write(reply);
    }
    return grpc::Status::OK;
  }
  // Gives the files back, each in pieces of 100,000 bytes, and what it was asked as result.
  grpc::Status RunTask(grpc::ServerContext* context,
                       grpc::ServerReaderWriter<v1::TaskOutput, v1::TaskInput>* stream) override {
    if (!knows(*context)) return stranger();
    v1::TaskInput input;
    std::string kind;
    std::vector<std::pair<std::string, std::string>> files;
    while (stream->Read(&input) && !input.start()) {
      if (input.has_task()) kind = input.task().kind();
      if (kind == "refused") return refused(*context);
      if (!input.has_file()) continue;
      if (files.empty() || files.back().first != input.file().name())
        files.emplace_back(input.file().name(), "");
      files.back().second += input.file().bytes();
    }
    files.emplace_back("result.json", "{\"kind\": \"" + kind + "\"}");
    for (const auto& [name, bytes] : files) {
      for (std::size_t at = 0; at == 0 || at < bytes.size(); at += 100000) {
        v1::TaskOutput output;
        output.mutable_file()->set_name(name);
        output.mutable_file()->set_bytes(bytes.substr(at, 100000));
        output.mutable_file()->set_last(at + 100000 >= bytes.size());
        stream->Write(output);
      }
    }
    return grpc::Status::OK;
  }

 private:
  bool knows(const grpc::ServerContext& context) const {
    const auto found = context.client_metadata().find(kTokenMetadata);
    return found != context.client_metadata().end() &&
           std::string(found->second.data(), found->second.size()) == token_;
  }
  static grpc::Status stranger() { return {grpc::StatusCode::UNAUTHENTICATED, ""}; }
  static grpc::Status refused(grpc::ServerContext& context) {
    v1::Failure failure;
    failure.set_code("memory");
    failure.set_message("needs 4.3 GiB");
    failure.set_hint("give more ranks");
    context.AddTrailingMetadata(kFailureMetadata, failure.SerializeAsString());
    return {grpc::StatusCode::RESOURCE_EXHAUSTED, "needs 4.3 GiB"};
  }
  static std::string packed(const std::string& bytes) {
    uLongf length = compressBound(bytes.size());
    std::string out(length, '\0');
    compress2(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(bytes.data()),
              bytes.size(), 1);
    out.resize(length);
    return out;
  }

  std::string token_;
  std::atomic<std::uint64_t> edit_{0};
  std::atomic<std::int64_t> faces_{0};
};

}  // namespace footwall::service
