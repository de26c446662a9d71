#include "engine/service/resident/far_line.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <future>

#include "storage/base/error.h"

namespace footwall::service {
namespace {

HostAddress address(const char* text, const char* mask) {
  HostAddress made;
  made.family = std::string_view(text).find(':') == std::string_view::npos ? AF_INET : AF_INET6;
  EXPECT_EQ(inet_pton(made.family, text, made.bytes.data()), 1);
  EXPECT_EQ(inet_pton(made.family, mask, made.mask.data()), 1);
  return made;
}

std::vector<HostAddress> loopback() {
  return {address("127.0.0.1", "255.0.0.0")};
}

// As any program on the machine could.
Descriptor stranger(const HostAddress& to) {
  Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(to.port);
  there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(made.get(), reinterpret_cast<const sockaddr*>(&there), sizeof there), 0);
  return made;
}

bool is_hung_up(const Descriptor& line) {
  char byte = 0;
  return recv(line.get(), &byte, 1, 0) <= 0;
}

TEST(FarLine, CarriesWordsLikeALineOfOneHost) {
  std::optional<FarListener> listener(loopback());
  const LineSecret secret = new_line_secret();
  const auto doors = listener->addresses();
  auto lines = std::async(std::launch::async, [&] { return listener->accept(2, secret); });
  std::vector<HostLineMember> members;
  for (int n = 0; n < 2; ++n) members.emplace_back(reach(doors, secret));
  {
    std::vector<Descriptor> ends = lines.get();
    listener.reset();
    for (Descriptor& end : ends) {
      for (std::uint64_t word = 1; word <= 20; ++word)
        ASSERT_EQ(send(end.get(), &word, sizeof word, MSG_NOSIGNAL), static_cast<ssize_t>(sizeof word));
    }
    for (const HostLineMember& member : members) {
      for (std::uint64_t word = 1; word <= 20; ++word) EXPECT_EQ(member.receive(), word);
    }
  }
  for (const HostLineMember& member : members) EXPECT_EQ(member.receive(), std::nullopt);  // rank 0 has gone
}

TEST(FarLine, StrangersGetNoWordAndHoldNobodyUp) {
  FarListener listener(loopback());
  const LineSecret secret = new_line_secret();
  const auto doors = listener.addresses();
  auto lines = std::async(std::launch::async, [&] { return listener.accept(1, secret); });
  const Descriptor silent = stranger(doors[0]);
  const Descriptor half = stranger(doors[0]);
  ASSERT_EQ(send(half.get(), secret.data(), 10, MSG_NOSIGNAL), 10);
  const Descriptor wrong = stranger(doors[0]);
  LineSecret other = secret;
  other[31] ^= 1U;
  ASSERT_EQ(send(wrong.get(), other.data(), 32, MSG_NOSIGNAL), 32);
  EXPECT_TRUE(is_hung_up(wrong));
  { const Descriptor gone = stranger(doors[0]); }
  std::vector<Descriptor> many;
  for (int n = 0; n < 300; ++n) many.push_back(stranger(doors[0]));
  const HostLineMember member(reach(doors, secret));
  EXPECT_EQ(lines.get().size(), 1U);
  EXPECT_TRUE(is_hung_up(silent));
  EXPECT_TRUE(is_hung_up(half));
  for (const Descriptor& each : many) EXPECT_TRUE(is_hung_up(each));
}

TEST(FarLine, TakesNobodyForRankZeroWhoDoesNotKnowTheSecret) {
  FarListener foreign(loopback());
  FarListener right(loopback());
  const LineSecret secret = new_line_secret();
  LineSecret other = secret;
  other[63] ^= 1U;  // knows what is said to it, but not the answer
  auto doors = foreign.addresses();
  doors.push_back(right.addresses()[0]);
  auto deceived = std::async(std::launch::async, [&] { return foreign.accept(1, other).size(); });
  auto lines = std::async(std::launch::async, [&] { return right.accept(1, secret).size(); });
  const Descriptor line = reach(doors, secret);
  EXPECT_EQ(lines.get(), 1U);
  EXPECT_EQ(deceived.get(), 1U);
}

TEST(FarLine, SaysWhoCannotBeReached) {
  std::optional<FarListener> listener(loopback());
  const LineSecret secret = new_line_secret();
  const auto doors = listener->addresses();
  EXPECT_THROW(listener->accept(1, secret, std::chrono::milliseconds(10)), Error);
  listener.reset();
  try {
    reach(doors, secret);
    FAIL() << "reached a listener that has gone";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kEngine);
    EXPECT_NE(error.message().find("127.0.0.1"), std::string::npos);
  }
  EXPECT_THROW(FarListener({}), Error);
}

TEST(FarLine, HostsMeetInTheNetworkOfBoth) {
  const std::vector<HostAddress> first{
      address("127.0.0.1", "255.0.0.0"), address("172.17.0.1", "255.255.0.0"),
      address("10.1.0.5", "255.255.255.0"), address("192.168.7.1", "255.255.255.0"),
      address("2001:db8::1", "ffff:ffff:ffff:ffff::")};
  const auto ways = [&](std::vector<HostAddress> mine) { return ways_to(first, mine); };
  EXPECT_EQ(ways({first[0], first[1], address("10.1.0.6", "255.255.255.0")}), 0b00100U);
  EXPECT_EQ(ways({first[0], address("2001:db8::2", "ffff:ffff:ffff:ffff::")}), 0b10000U);
  // No network in common: whatever is not here, too.
  EXPECT_EQ(ways({first[0], first[1], address("10.9.0.6", "255.255.255.0")}), 0b11100U);
  // One machine.
  EXPECT_EQ(ways(first), 0b00001U);
}

TEST(FarLine, KnowsTheAddressesOfThisHost) {
  const auto own = own_addresses();
  EXPECT_TRUE(std::any_of(own.begin(), own.end(), [](const HostAddress& each) {
    return each.family == AF_INET && each.bytes[0] == 127 && each.mask[0] == 255 && each.mask[3] == 0;
  }));
}

}  // namespace
}  // namespace footwall::service
