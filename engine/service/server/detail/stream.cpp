#include "engine/service/server/detail/stream.h"

#include <fmt/format.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/support/proto_buffer_reader.h>
#include <grpcpp/support/proto_buffer_writer.h>

#include "engine/service/server/requests/failure.h"
#include "engine/service/words_on_the_wire.h"

namespace footwall::service {
namespace {

constexpr std::size_t kOutbox = std::size_t{8} << 20;
// How often a waiting writer looks whether its job was cancelled.
constexpr std::chrono::milliseconds kGlance(20);

grpc::ByteBuffer bytes_of(const google::protobuf::Message& message) {
  grpc::ByteBuffer bytes;
  bool own = false;
  const grpc::Status status =
      grpc::GenericSerialize<grpc::ProtoBufferWriter, google::protobuf::Message>(message, &bytes, &own);
  if (!status.ok()) {
    throw Error(ErrorCode::kInternal,
                fmt::format("a {} cannot be sent: {}", message.GetTypeName(), status.error_message()));
  }
  return bytes;
}

Error gone() {
  return {ErrorCode::kCancelled, "the client has gone"};
}

}  // namespace

grpc::StatusCode status_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
    case ErrorCode::kInvalid:
    case ErrorCode::kFormat:
      return grpc::StatusCode::INVALID_ARGUMENT;
    case ErrorCode::kNotFound:
      return grpc::StatusCode::NOT_FOUND;
    case ErrorCode::kCorrupt:
      return grpc::StatusCode::DATA_LOSS;
    case ErrorCode::kIo:
      return grpc::StatusCode::ABORTED;
    case ErrorCode::kHeld:
      return grpc::StatusCode::FAILED_PRECONDITION;
    case ErrorCode::kUnsupported:
      return grpc::StatusCode::UNIMPLEMENTED;
    case ErrorCode::kMemory:
      return grpc::StatusCode::RESOURCE_EXHAUSTED;
    case ErrorCode::kCancelled:
      return grpc::StatusCode::CANCELLED;
    case ErrorCode::kEngine:
      return grpc::StatusCode::UNAVAILABLE;
    case ErrorCode::kInternal:
      break;
  }
  return grpc::StatusCode::INTERNAL;
}

Stream::Stream(grpc::CallbackServerContext& context, const Patience& patience,
               std::function<void(const Stream&)> done)
    : patience_(patience), done_(std::move(done)), context_(&context) {}

std::shared_ptr<Stream> Stream::open(grpc::CallbackServerContext& context, const Patience& patience,
                                     std::function<void(const Stream&)> done) {
  std::shared_ptr<Stream> stream(new Stream(context, patience, std::move(done)));
  stream->self_ = stream;
  return stream;
}

void Stream::serve(std::shared_ptr<Request> request) {
  {
    const std::scoped_lock lock(mutex_);
    request_ = std::move(request);
  }
  read_on();
}

std::shared_ptr<Request> Stream::request() {
  const std::scoped_lock lock(mutex_);
  return request_;
}

void Stream::read_on() noexcept {
  {
    const std::scoped_lock lock(mutex_);
    if (end_ || context_ == nullptr) return;
    ++asking_;
  }
  StartRead(&incoming_);
  {
    const std::scoped_lock lock(mutex_);
    --asking_;
  }
  go_on();
}

void Stream::OnReadDone(bool ok) {
  const std::shared_ptr<Request> asked = request();
  if (!asked) return;
  std::optional<Error> failure;
  try {
    if (ok) {
      hand_over(*asked);
    } else {
      asked->no_more();
    }
  } catch (const Error& error) {
    failure = error;
  } catch (const std::bad_alloc&) {
    failure = Error(ErrorCode::kMemory, "not enough memory for this message");
  } catch (const std::exception& error) {
    failure = Error(ErrorCode::kInternal, error.what());
  }
  if (failure) drop(*failure);
}

void Stream::drop(const Error& why) noexcept {
  end(why);
  if (const auto asked = request()) asked->left();
}

void Stream::hand_over(Request& asked) {
  {
    const std::scoped_lock lock(mutex_);
    asked_ = true;
  }
  grpc::ByteBuffer bytes;
  bytes.Swap(&incoming_);
  grpc::ProtoBufferReader reader(&bytes);
  asked.received(reader, static_cast<std::int64_t>(bytes.Length()));
}

void Stream::send(const google::protobuf::Message& message, const JobContext& job) {
  grpc::ByteBuffer bytes = bytes_of(message);
  {
    std::unique_lock lock(mutex_);
    while (!end_ && outbox_bytes_ > 0 && outbox_bytes_ + bytes.Length() > kOutbox) {
      job.check();
      changed_.wait_for(lock, kGlance);
      if (Clock::now() - last_taken_ > patience_.reading) give_up_locked();
    }
    if (end_) throw gone();
    if (outbox_bytes_ == 0) last_taken_ = Clock::now();
    outbox_bytes_ += bytes.Length();
    outbox_.push_back(std::move(bytes));
  }
  go_on();
}

void Stream::hint(const google::protobuf::Message& message) noexcept {
  try {
    {
      grpc::ByteBuffer bytes = bytes_of(message);
      const std::scoped_lock lock(mutex_);
      if (end_ || !outbox_.empty() || writing_) return;
      last_taken_ = Clock::now();
      outbox_bytes_ += bytes.Length();
      outbox_.push_back(std::move(bytes));
    }
    go_on();
  } catch (const std::exception&) {
    return;  // one that may be lost
  }
}

void Stream::end(const std::optional<Error>& failure) noexcept {
  {
    const std::scoped_lock lock(mutex_);
    if (end_) return;
    if (failure) {
      const v1::Failure told = failure_of(*failure);
      if (context_ != nullptr) context_->AddTrailingMetadata(kFailureMetadata, told.SerializeAsString());
      end_ = grpc::Status(status_code_of(failure->code()), told.message());
      // A failure is told at once; what was on its way is part of an answer that never becomes whole.
      for (const grpc::ByteBuffer& bytes : outbox_) outbox_bytes_ -= bytes.Length();
      outbox_.clear();
    } else {
      end_ = grpc::Status::OK;
    }
  }
  changed_.notify_all();
  go_on();
}

void Stream::go_on() {
  // Held through gRPC's calls: they may end the stream on another thread.
  const std::shared_ptr<Stream> keep = weak_from_this().lock();
  std::unique_lock lock(mutex_);
  if (!keep || writing_ || asking_ > 0 || finished_ || context_ == nullptr) return;
  if (!outbox_.empty()) {
    writing_ = true;
    outgoing_.Swap(&outbox_.front());
    outbox_.pop_front();
    lock.unlock();
    StartWrite(&outgoing_);
  } else if (end_) {
    finished_ = true;
    const grpc::Status status = *end_;
    lock.unlock();
    Finish(status);
  }
}

void Stream::OnWriteDone(bool ok) {
  {
    const std::scoped_lock lock(mutex_);
    writing_ = false;
    outbox_bytes_ -= outgoing_.Length();
    outgoing_.Clear();
    last_taken_ = Clock::now();
    if (!ok) {
      outbox_.clear();
      outbox_bytes_ = 0;
      if (!end_) end_ = grpc::Status::CANCELLED;
    }
  }
  changed_.notify_all();
  go_on();
}

void Stream::give_up_locked() {
  outbox_.clear();
  outbox_bytes_ = writing_ ? outgoing_.Length() : 0;
  if (!end_) end_ = grpc::Status(grpc::StatusCode::CANCELLED, "the client took nothing for too long");
  if (context_ != nullptr) context_->TryCancel();
}

void Stream::tick(Clock::time_point now) {
  bool late = false;
  {
    const std::scoped_lock lock(mutex_);
    if (outbox_bytes_ > 0 && now - last_taken_ > patience_.reading) give_up_locked();
    late = !asked_ && !end_ && now - begun_ > patience_.asking;
  }
  if (late) drop(Error(ErrorCode::kCancelled, "the call was opened and nothing was asked"));
}

void Stream::OnCancel() {
  {
    const std::scoped_lock lock(mutex_);
    outbox_.clear();
    outbox_bytes_ = writing_ ? outgoing_.Length() : 0;
    if (!end_) end_ = grpc::Status::CANCELLED;
  }
  changed_.notify_all();
  if (const auto asked = request()) asked->left();
  go_on();
}

void Stream::OnDone() {
  std::shared_ptr<Request> asked;
  std::shared_ptr<Stream> self;
  {
    const std::scoped_lock lock(mutex_);
    context_ = nullptr;
    asked = std::move(request_);
    self = std::move(self_);
    if (!end_) end_ = grpc::Status::CANCELLED;
  }
  changed_.notify_all();
  done_(*this);
}

}  // namespace footwall::service
