#include "engine/service/server/requests/status_request.h"

#include <fmt/format.h>

#include "engine/service/engine.pb.h"
#include "engine/service/server/requests/failure.h"
#include "engine/service/server/requests/parcel.h"

namespace footwall::service {
namespace {

double seconds_since(std::chrono::steady_clock::time_point time) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

void tell_jobs(const CallQueue& queue, v1::StatusReply& reply) {
  for (const CallQueue::Entry& entry : queue.entries()) {
    v1::JobStatus& job = *reply.add_jobs();
    job.set_job(entry.id);
    job.set_what(entry.what);
    job.set_running(entry.state.running);
    job.mutable_progress()->set_fraction(entry.state.fraction);
    job.mutable_progress()->set_phase(utf8_of(entry.state.phase));
    job.mutable_progress()->set_amounts(utf8_of(entry.state.amounts));
    job.set_seconds(seconds_since(entry.state.since));
  }
}

void tell_ranks(const ResidentStatus& status, v1::StatusReply& reply) {
  for (std::size_t n = 0; n < status.ranks.size(); ++n) {
    v1::RankStatus& rank = *reply.add_each_rank();
    rank.set_rank(static_cast<int>(n));
    rank.set_host(utf8_of(status.ranks[n].host));
    rank.set_process(status.ranks[n].process);
    rank.set_memory_bytes(status.ranks[n].memory_bytes);
    if (status.ranks[n].start_seconds) rank.set_start_seconds(*status.ranks[n].start_seconds);
  }
  if (status.ranks.empty()) return;
  reply.set_host(utf8_of(status.ranks.front().host));
  reply.set_process(status.ranks.front().process);
}

void tell_volumes(const ResidentStatus& status, v1::StatusReply& reply) {
  for (const VolumeFacts& facts : status.volumes) {
    v1::OpenVolumeInfo& volume = *reply.add_volumes();
    volume.set_volume(facts.checksum);
    volume.set_path(utf8_of(facts.path));
    volume.mutable_dims()->set_i(facts.dims[0]);
    volume.mutable_dims()->set_j(facts.dims[1]);
    volume.mutable_dims()->set_k(facts.dims[2]);
    volume.set_memory_bytes(facts.memory_bytes);
  }
}

void fill(const Services& services, v1::StatusReply& reply) {
  const ResidentStatus status = services.status();
  reply.set_version(services.version);
  reply.set_ranks(static_cast<int>(status.ranks.size()));
  reply.set_threads(status.threads);
  reply.set_uptime_seconds(seconds_since(services.since));
  tell_ranks(status, reply);
  tell_volumes(status, reply);
  reply.set_faces(status.faces);
  reply.set_edit(status.edit);
  reply.set_state_hash(fmt::format("{:016x}", status.state_hash));
  tell_jobs(services.queue, reply);
  tell_jobs(services.pillars, reply);
}

}  // namespace

ImmediateRequest::ImmediateRequest(const google::protobuf::MethodDescriptor& method,
                                   std::shared_ptr<Reply> reply, Answer answer, std::function<void()> after)
    : method_(method), reply_(std::move(reply)), answer_(std::move(answer)), after_(std::move(after)) {}

void ImmediateRequest::received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) {
  const auto request = new_message(*method_.input_type());
  Parcel(bytes, size, *method_.input_type()).unpack(*request);
  const auto reply = new_message(*method_.output_type());
  answer_(*request, *reply);
  reply_->send(*reply, {});
  reply_->end(std::nullopt);
  if (after_) after_();
}

void ImmediateRequest::no_more() {
  throw Error(ErrorCode::kInvalid, fmt::format("the call has no {}", method_.input_type()->name()));
}

std::shared_ptr<Request> status_request(const google::protobuf::MethodDescriptor& method,
                                        const std::shared_ptr<Services>& services,
                                        std::shared_ptr<Reply> reply) {
  return std::make_shared<ImmediateRequest>(
      method, std::move(reply), [services](const google::protobuf::Message&, google::protobuf::Message& out) {
        fill(*services, dynamic_cast<v1::StatusReply&>(out));
      });
}

std::shared_ptr<Request> cancel_request(const google::protobuf::MethodDescriptor& method,
                                        const std::shared_ptr<Services>& services,
                                        std::shared_ptr<Reply> reply) {
  return std::make_shared<ImmediateRequest>(
      method, std::move(reply),
      [services](const google::protobuf::Message& request, google::protobuf::Message& out) {
        const std::uint64_t job = dynamic_cast<const v1::CancelRequest&>(request).job();
        dynamic_cast<v1::CancelReply&>(out).set_found(services->queue.cancel(job) ||
                                                      services->pillars.cancel(job));
      });
}

std::shared_ptr<Request> shutdown_request(const google::protobuf::MethodDescriptor& method,
                                          const std::shared_ptr<Services>& services,
                                          std::shared_ptr<Reply> reply) {
  return std::make_shared<ImmediateRequest>(
      method, std::move(reply), [](const google::protobuf::Message&, google::protobuf::Message&) {},
      [services] {
        if (!services->told_to_end.exchange(true)) services->shutdown();
      });
}

}  // namespace footwall::service
