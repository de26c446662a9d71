#include "storage/volume/mpi_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace footwall::volume {
namespace {

constexpr std::int64_t kPiece = std::int64_t{1} << 30;  // counts are ints

// f(offset, count) for pieces of at most kPiece.
void each_piece(std::size_t size, const std::function<void(std::size_t, int)>& f) {
  const auto bytes = static_cast<std::int64_t>(size);
  for (std::int64_t at = 0; at < bytes; at += kPiece)
    f(static_cast<std::size_t>(at), static_cast<int>(std::min(kPiece, bytes - at)));
}

}  // namespace

void check_mpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw Error(ErrorCode::kEngine, fmt::format("{} failed: {}", call, text));
}

OwnCommunicator::OwnCommunicator(MPI_Comm parent) {
  check_mpi(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
  check_mpi(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
}

OwnCommunicator::~OwnCommunicator() {
  if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

int OwnCommunicator::rank() const {
  int rank = 0;
  check_mpi(MPI_Comm_rank(comm_, &rank), "MPI_Comm_rank");
  return rank;
}

int OwnCommunicator::size() const {
  int size = 0;
  check_mpi(MPI_Comm_size(comm_, &size), "MPI_Comm_size");
  return size;
}

std::optional<Error> outcome_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorCode::kMemory, "not enough memory for the volume");
  } catch (const std::exception& error) {
    return Error(ErrorCode::kInternal, error.what());
  }
  return std::nullopt;
}

void broadcast(const OwnCommunicator& comm, std::string& text) {
  auto size = static_cast<long long>(text.size());
  check_mpi(MPI_Bcast(&size, 1, MPI_LONG_LONG, 0, comm.get()), "MPI_Bcast");
  text.resize(static_cast<std::size_t>(size));
  each_piece(text.size(), [&](std::size_t at, int count) {
    check_mpi(MPI_Bcast(text.data() + at, count, MPI_CHAR, 0, comm.get()), "MPI_Bcast");
  });
}

void send(const OwnCommunicator& comm, std::span<const std::byte> bytes, int to) {
  each_piece(bytes.size(), [&](std::size_t at, int count) {
    check_mpi(MPI_Send(bytes.data() + at, count, MPI_BYTE, to, 0, comm.get()), "MPI_Send");
  });
}

void receive(const OwnCommunicator& comm, std::span<std::byte> bytes, int from) {
  each_piece(bytes.size(), [&](std::size_t at, int count) {
    check_mpi(MPI_Recv(bytes.data() + at, count, MPI_BYTE, from, 0, comm.get(), MPI_STATUS_IGNORE),
              "MPI_Recv");
  });
}

void agree(const OwnCommunicator& comm, const std::optional<Error>& mine) {
  const int none = comm.size();
  const int failed = mine ? comm.rank() : none;
  int lowest = none;
  check_mpi(MPI_Allreduce(&failed, &lowest, 1, MPI_INT, MPI_MIN, comm.get()), "MPI_Allreduce");
  if (lowest == none) return;
  int head[3] = {0, 0, 0};  // code, length of message, length of hint
  std::string text;
  if (failed == lowest) {
    head[0] = static_cast<int>(mine->code());
    head[1] = static_cast<int>(mine->message().size());
    head[2] = static_cast<int>(mine->hint().size());
    text = mine->message() + mine->hint();
  }
  check_mpi(MPI_Bcast(head, 3, MPI_INT, lowest, comm.get()), "MPI_Bcast");
  text.resize(static_cast<std::size_t>(head[1]) + static_cast<std::size_t>(head[2]));
  check_mpi(MPI_Bcast(text.data(), head[1] + head[2], MPI_CHAR, lowest, comm.get()), "MPI_Bcast");
  const auto split = static_cast<std::size_t>(head[1]);
  throw Error(static_cast<ErrorCode>(head[0]), text.substr(0, split), text.substr(split));
}

}  // namespace footwall::volume
