// A line from the leader of a host, its lowest rank, to each of its other ranks: words that a rank can sleep
// for. Unix sockets, no MPI: they may be used beside it, and from any thread. Rank 0's goes on to the leaders
// of other hosts (far_line.h).
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace footwall::service {

// A file descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return number_; }

 private:
  int number_;
};

// The leader's end.
class HostLineLeader {
 public:
  // Makes the socket folder/name, for this user alone. Throws Error kIo, kUsage (a path that is too long).
  explicit HostLineLeader(const std::filesystem::path& path);
  // Takes `members` connections of processes of this user and removes the socket's file. Throws Error kEngine
  // where they do not come in time.
  void accept(int members, std::chrono::milliseconds patience = std::chrono::seconds(60));
  // The leader of another host is one more member.
  void take(Descriptor member) { members_.push_back(std::move(member)); }
  // To every member, the last taken first; then throws Error kEngine where one has gone, or has not read
  // a great many words.
  void send(std::uint64_t word) const;

 private:
  std::filesystem::path path_;
  Descriptor listening_;
  std::vector<Descriptor> members_;
};

// A member's end.
class HostLineMember {
 public:
  explicit HostLineMember(Descriptor connection) : socket_(std::move(connection)) {}
  // Throws Error kNotFound, kIo, kUsage.
  explicit HostLineMember(const std::filesystem::path& path);
  // Sleeps until a word comes; none where the leader has gone, or after hang_up().
  std::optional<std::uint64_t> receive() const;
  // Ends receive(), from any thread.
  void hang_up() const;

 private:
  Descriptor socket_;
};

}  // namespace footwall::service
