#include "storage/volume/min_max_builder.h"

#include <limits>

#include "unit/volume/volume_fixture.h"

namespace footwall::volume {
namespace {

TEST_F(VolumeTest, EveryEntryOfEveryLevelIsTheBruteForceOne) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto value = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    if (i >= 9 && j >= 9 && k <= 16) return nan;  // whole entries without a value
    return (i * 5 + j * 3 + k) % 97 == 0 ? nan : wavy(i, j, k);
  };
  const std::vector<std::pair<survey::Index, survey::Index>> shapes{
      {{1, 1, 1}, {8, 8, 8}},    {{8, 9, 10}, {4, 4, 4}},     {{9, 9, 9}, {8, 8, 8}},
      {{17, 18, 33}, {5, 7, 8}}, {{40, 25, 70}, {16, 8, 64}}, {{2, 130, 3}, {1, 64, 3}}};
  for (const auto& [dims, chunk] : shapes) {
    WriteOptions options = options_for(dims);
    options.chunk = chunk;
    write_volume(path_, options, source_of(value), JobContext());
    const VolumeReader reader(path_);
    std::vector<float> v(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
    reader.read(options.geometry.box(), v);
    const int levels = min_max_levels(dims);
    for (int level = 0; level < levels; ++level) {
      const MinMaxLevel got = reader.min_max(level);
      const std::int64_t s = got.step;
      ASSERT_EQ(s, std::int64_t{8} << level);
      for (int axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(got.dims[axis], std::max<std::int64_t>(1, (dims[axis] - 1 + s - 1) / s));
      }
      for (std::int64_t a = 0; a < got.dims[0]; ++a) {
        for (std::int64_t b = 0; b < got.dims[1]; ++b) {
          for (std::int64_t c = 0; c < got.dims[2]; ++c) {
            float least = std::numeric_limits<float>::infinity();
            float most = -least;
            int null = 0;
            for (std::int64_t i = a * s; i <= std::min(a * s + s, dims[0] - 1); ++i) {
              for (std::int64_t j = b * s; j <= std::min(b * s + s, dims[1] - 1); ++j) {
                for (std::int64_t k = c * s; k <= std::min(c * s + s, dims[2] - 1); ++k) {
                  const float x = v[static_cast<std::size_t>((i * dims[1] + j) * dims[2] + k)];
                  if (std::isnan(x)) {
                    null = 1;
                  } else {
                    least = std::min(least, x);
                    most = std::max(most, x);
                  }
                }
              }
            }
            const std::size_t at = got.at(a, b, c);
            ASSERT_EQ(got.min[at], least) << level << ": " << a << ' ' << b << ' ' << c;
            ASSERT_EQ(got.max[at], most);
            ASSERT_EQ(got.has_null[at], null);
          }
        }
      }
    }
    EXPECT_EQ(reader.min_max(levels - 1).min.size(), 1U);
    EXPECT_THROW(reader.min_max(levels), Error);
    EXPECT_THROW(reader.min_max(-1), Error);
  }
}

// Parts of a volume bring parts of the same rows, which merge into those of the whole.
TEST(MinMaxBuilder, RowsOfPartsMergeIntoThoseOfTheWhole) {
  const survey::Index dims{41, 9, 12};
  const auto values_of = [&](const survey::Box& box) {
    std::vector<float> values(static_cast<std::size_t>(box.count()));
    std::vector<std::uint8_t> live(static_cast<std::size_t>(box.size(0) * box.size(1)));
    source_of(wavy)(box, values, live);
    return values;
  };
  const survey::Box all{{0, 0, 0}, dims};
  MinMaxBuilder whole(dims);
  whole.add(all, values_of(all));
  const std::vector<MinMaxRow> wanted = whole.take_finished(dims[0]);
  ASSERT_EQ(wanted.size(), 5U);
  for (std::int64_t cut = 1; cut < dims[0]; ++cut) {
    std::vector<MinMaxRow> rows(5, empty_row(2 * 1 * 1));
    for (const auto& [lo, hi] : {std::pair<std::int64_t, std::int64_t>{0, cut}, {cut, dims[0]}}) {
      const survey::Box part{{lo, 0, 0}, {hi, dims[1], dims[2]}};
      MinMaxBuilder builder(dims, lo);
      builder.add(part, values_of(part));
      const std::vector<MinMaxRow> some = builder.take_finished(dims[0]);
      const RowRange touched = rows_touched_by(part, dims);
      ASSERT_EQ(static_cast<std::int64_t>(some.size()), touched.end - touched.first) << cut;
      for (std::size_t n = 0; n < some.size(); ++n)
        merge_row(rows[static_cast<std::size_t>(touched.first) + n], some[n]);
    }
    EXPECT_EQ(rows, wanted) << cut;
  }
}

}  // namespace
}  // namespace footwall::volume
