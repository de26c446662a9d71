// What carries out a command on the ranks: one function for each kind, in a file of its own.
#pragma once
#include <google/protobuf/message.h>

#include <functional>
#include <span>

#include "engine/comm/communicator.h"
#include "storage/base/job_context.h"

namespace footwall::v1 {
class Command;
class ReadBoxRequest;
}  // namespace footwall::v1

namespace footwall::service {

class ResidentState;

// Takes messages for the client on rank 0; on the others they are dropped. Throws Error kCancelled where the
// client has gone: inside collectively(), like any failure of one rank.
using Send = std::function<void(const google::protobuf::Message&)>;

// Collective. Throws the same Error on all ranks (comm::AgreedError), and then the state is as it was.
using CommandFunction = void (*)(ResidentState& state, const v1::Command& command, const Send& send,
                                 const JobContext& job);

// One row per kind of command.
struct CommandRow {
  int kind;  // of Command.what
  const char* name;
  CommandFunction run;
};
std::span<const CommandRow> command_rows();

void open_volume(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void close_volume(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void edit_model(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void read_model(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void extract(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void live(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void face_voxels(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void isosurface(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void render(ResidentState&, const v1::Command&, const Send&, const JobContext&);
void run_task(ResidentState&, const v1::Command&, const Send&, const JobContext&);

// Rank 0 alone, between the slices of what all ranks do; throws its own error.
void read_box(ResidentState&, const v1::ReadBoxRequest&, const Send&);

}  // namespace footwall::service
