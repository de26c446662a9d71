#include "engine/extract/cost/rates_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scratch_folder.h"
#include "storage/base/error.h"
#include "storage/base/partial_file.h"

namespace footwall::extract {
namespace {

MachineRates some_rates() {
  MachineRates rates;
  rates.alpha = 1.1e-6;
  rates.overhead = 2.2e-7;
  rates.byte = 1.0 / 3e9;
  rates.voxelize = 1e-9;
  rates.gather = 2e-9;
  rates.fold = 3e-9;
  rates.fold_discontinuity = 2e-8;
  rates.pack = 4e-9;
  rates.face = 1e-7;
  rates.finish = 2e-7;
  rates.balance = 1e-7;
  rates.whole_face = {{"lot", 1.7e-8}};
  rates.ranks = 4;
  rates.cores = 2;
  return rates;
}

const RatesKey kKey{"host", "Open MPI v4.1.4", "lot ", 4, 2};

class RatesFile : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path() / "cache" / "footwall";
};

TEST_F(RatesFile, ReadsBackEveryBit) {
  EXPECT_EQ(rates_from(to_text(some_rates())), some_rates());
  EXPECT_FALSE(read_rates(folder_, kKey));
  ASSERT_TRUE(write_rates(folder_, kKey, some_rates()));
  EXPECT_EQ(read_rates(folder_, kKey), some_rates());
  using std::filesystem::perms;
  const auto mode = std::filesystem::status(rates_path(folder_, kKey)).permissions();
  EXPECT_EQ(mode & (perms::group_all | perms::others_all), perms::none);
}

TEST_F(RatesFile, IsOfOneMachineAndRankCount) {
  ASSERT_TRUE(write_rates(folder_, kKey, some_rates()));
  for (std::size_t n = 0; n < 5; ++n) {
    RatesKey other = kKey;
    if (n == 0) other.host = "another";
    if (n == 1) other.mpi = "MPICH";
    if (n == 2) other.computations = "";
    if (n == 3) other.ranks = 5;
    if (n == 4) other.cores = 3;
    EXPECT_FALSE(read_rates(folder_, other)) << n;
    // Not even under its name.
    std::filesystem::copy_file(rates_path(folder_, kKey), rates_path(folder_, other));
    EXPECT_FALSE(read_rates(folder_, other)) << n;
  }
}

TEST_F(RatesFile, ADamagedOneIsIgnored) {
  ASSERT_TRUE(write_rates(folder_, kKey, some_rates()));
  const std::filesystem::path path = rates_path(folder_, kKey);
  const std::string whole = read_whole_file(path, 1 << 16);
  const auto put = [&](const std::string& text) { std::ofstream(path, std::ios::trunc) << text; };
  for (std::size_t cut = 0; cut + 2 < whole.size(); cut += 7) {
    put(whole.substr(0, cut));
    EXPECT_FALSE(read_rates(folder_, kKey)) << cut;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    put(changed);
    const auto read = read_rates(folder_, kKey);
    // White space and the like may change without harm.
    if (read) {
      EXPECT_EQ(*read, some_rates()) << at;
    }
  }
  std::string later = whole;
  later.replace(later.find("\"footwall_rates\": 3"), 19, "\"footwall_rates\": 9");
  put(later);
  EXPECT_FALSE(read_rates(folder_, kKey));
  put(whole);
  EXPECT_TRUE(read_rates(folder_, kKey));
}

TEST_F(RatesFile, AFolderThatCannotBeIsNoError) {
  std::ofstream(scratch_.path() / "cache") << "a file";
  EXPECT_FALSE(write_rates(folder_, kKey, some_rates()));
  EXPECT_FALSE(read_rates(folder_, kKey));
  EXPECT_FALSE(write_rates({}, kKey, some_rates()));
}

TEST(Rates, ThatAreNoSecondsAreRefused) {
  for (const double bad : {0.0, -1.0, 1e9}) {
    MachineRates rates = some_rates();
    rates.voxelize = bad;
    EXPECT_THROW(rates_from(to_text(rates)), Error) << bad;
  }
  EXPECT_THROW(rates_from("{}"), Error);
  EXPECT_THROW(rates_from("[1"), Error);
}

}  // namespace
}  // namespace footwall::extract
