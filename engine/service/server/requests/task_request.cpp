#include "engine/service/server/requests/task_request.h"

#include "engine/service/server/requests/parcel.h"

namespace footwall::service {

void TaskRequest::received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) {
  v1::TaskInput input;
  // Only the task is kept; the files go to the disk at once.
  const Parcel parcel(bytes, size, *input.GetDescriptor());
  parcel.unpack(input);
  if (input.has_task() == (folder_ != nullptr))
    throw Error(ErrorCode::kInvalid, "the task comes first, once, and then its files");
  if (input.has_task()) {
    remember(parcel.memory_bytes());
    folder_ = std::make_unique<TaskFolder>(services_->scratch);
    task_.mutable_task()->Swap(input.mutable_task());
    task_.set_folder(folder_->path().string());
  } else if (input.has_file()) {
    folder_->add(input.file());
  } else if (input.start()) {
    folder_->close();
    started_ = true;
    services_->queue.push(shared_from_this());
    return;
  } else {
    throw Error(ErrorCode::kInvalid, "a message of RunTask says nothing");
  }
  reply_->read_on();
}

void TaskRequest::no_more() {
  if (!started_) throw Error(ErrorCode::kInvalid, "RunTask ended before its start");
}

v1::Command TaskRequest::take_command() {
  v1::Command command;
  command.set_job(id());
  command.mutable_task()->Swap(&task_);
  return command;
}

}  // namespace footwall::service
