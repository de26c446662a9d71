#include "engine/comm/communicator.h"

#include <array>
#include <cstring>
#include <limits>
#include <new>

namespace footwall::comm {
namespace {

// An Error as bytes: the code, the length of the message, message and hint.
Bytes packed(const Error& error) {
  const std::uint64_t length = error.message().size();
  Bytes bytes(1 + sizeof length);
  bytes[0] = static_cast<std::byte>(error.code());
  std::memcpy(bytes.data() + 1, &length, sizeof length);
  for (const std::string& text : {error.message(), error.hint()}) {
    const auto characters = std::as_bytes(std::span(text));
    bytes.insert(bytes.end(), characters.begin(), characters.end());
  }
  return bytes;
}

Error unpacked(const Bytes& bytes) {
  std::uint64_t length = 0;
  require(bytes.size() >= 1 + sizeof length, "a packed error");
  std::memcpy(&length, bytes.data() + 1, sizeof length);
  const std::string text(reinterpret_cast<const char*>(bytes.data()) + 1 + sizeof length,
                         bytes.size() - 1 - sizeof length);
  return Error(static_cast<ErrorCode>(bytes[0]), text.substr(0, length), text.substr(length));
}

}  // namespace

void check(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING + 1> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw Error(ErrorCode::kEngine,
              std::string(call) + " failed: " + std::string(text.data(), static_cast<std::size_t>(length)));
}

Error current_error() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorCode::kMemory, "out of memory", "use more ranks on more machines, or a smaller volume");
  } catch (const std::exception& error) {
    return Error(ErrorCode::kInternal, error.what());
  } catch (...) {
    return Error(ErrorCode::kInternal, "an exception of an unknown kind");
  }
}

Communicator::Communicator(MPI_Comm parent) {
  check(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
  check(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
  check(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
}

Communicator::Communicator(const Communicator& parent, const RankGrid& grid) {
  require(grid.ranks() == parent.size(), "a rank grid of all ranks");
  const std::array<int, 2> parts = grid.parts();
  const std::array<int, 2> periods{0, 0};
  check(MPI_Cart_create(parent.get(), 2, parts.data(), periods.data(), 0, &comm_), "MPI_Cart_create");
  check(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  check(MPI_Comm_rank(comm_, &rank_), "MPI_Comm_rank");
  check(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
}

Communicator::~Communicator() {
  if (comm_ != MPI_COMM_NULL) MPI_Comm_free(&comm_);
}

void Communicator::agree(const std::optional<Error>& mine) const {
  int failed = mine ? rank_ : size_;
  int first = size_;
  check(MPI_Allreduce(&failed, &first, 1, MPI_INT, MPI_MIN, comm_), "MPI_Allreduce");
  if (first == size_) return;
  throw AgreedError(unpacked(broadcast(first == rank_ ? packed(*mine) : Bytes{}, first)));
}

Bytes Communicator::broadcast(Bytes bytes, int root) const {
  std::uint64_t size = bytes.size();
  check(MPI_Bcast(&size, 1, MPI_UINT64_T, root, comm_), "MPI_Bcast");
  bytes.resize(size);
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 30;
  for (std::uint64_t at = 0; at < size; at += kPiece) {
    const int count = static_cast<int>(std::min(kPiece, size - at));
    check(MPI_Bcast(bytes.data() + at, count, MPI_BYTE, root, comm_), "MPI_Bcast");
  }
  return bytes;
}

double Communicator::maximum(double value) const {
  double result = 0;
  check(MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, MPI_MAX, comm_), "MPI_Allreduce");
  return result;
}

std::int64_t Communicator::maximum(std::int64_t value) const {
  std::int64_t result = 0;
  check(MPI_Allreduce(&value, &result, 1, MPI_INT64_T, MPI_MAX, comm_), "MPI_Allreduce");
  return result;
}

std::int64_t Communicator::sum(std::int64_t value) const {
  std::int64_t result = 0;
  check(MPI_Allreduce(&value, &result, 1, MPI_INT64_T, MPI_SUM, comm_), "MPI_Allreduce");
  return result;
}

}  // namespace footwall::comm
