// RunTask: gathers the task and its files, then waits for its turn.
#pragma once
#include "engine/service/ranks.pb.h"
#include "engine/service/server/requests/rank_call.h"
#include "engine/service/server/requests/task_folder.h"

namespace footwall::service {

class TaskRequest final : public RankCall {
 public:
  using RankCall::RankCall;
  void received(google::protobuf::io::ZeroCopyInputStream& bytes, std::int64_t size) override;
  void no_more() override;
  v1::Command take_command() override;

 private:
  v1::StoredTask task_;
  std::unique_ptr<TaskFolder> folder_;
  bool started_ = false;
};

}  // namespace footwall::service
