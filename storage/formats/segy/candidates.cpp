// Based on: the observation that line numbers of a stacked survey number its traces without repetition, fill
// the rectangle between their lowest and highest values, and go with the coordinates through an affine map.
// Words that fail one of the three are no line numbers, whatever the order of the traces.
#include "storage/formats/segy/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "storage/formats/segy/line_steps.h"
#include "storage/formats/segy/map_fit.h"
#include "storage/formats/segy/presets.h"

namespace footwall::formats::segy {
namespace {

constexpr std::int64_t kWindow = 2000;  // traces at the start, the middle and the end
constexpr double kLargestLine = 2e8;    // beyond, a word is no line number
constexpr double kLargestCoordinate = 1e10;
constexpr std::size_t kMostColumns = 40;
constexpr std::size_t kMostCandidates = 16;
constexpr double kGoodFit = 0.1;      // bins
constexpr double kLeastScore = 0.05;  // chance alone makes candidates below

struct Sample {
  std::size_t header_bytes = 0;
  std::vector<std::byte> headers;
  std::vector<std::int64_t> traces;

  std::size_t size() const { return traces.size(); }
  std::span<const std::byte> header(std::size_t n) const {
    return std::span(headers).subspan(n * header_bytes, header_bytes);
  }
};

Sample read_sample(const detail::ReadOnlyFile& file, const Layout& layout) {
  Sample sample;
  sample.header_bytes = static_cast<std::size_t>(layout.header_bytes());
  if (layout.traces <= 3 * kWindow) {
    sample.traces.resize(static_cast<std::size_t>(layout.traces));
    std::iota(sample.traces.begin(), sample.traces.end(), std::int64_t{0});
  } else {
    for (const std::int64_t start :
         {std::int64_t{0}, (layout.traces - kWindow) / 2, layout.traces - kWindow}) {
      for (std::int64_t n = 0; n < kWindow; ++n) sample.traces.push_back(start + n);
    }
  }
  sample.headers.resize(sample.size() * sample.header_bytes);
  for (std::size_t n = 0; n < sample.size(); ++n) {
    file.read_at(layout.offset_of(sample.traces[n]),
                 std::span(sample.headers).subspan(n * sample.header_bytes, sample.header_bytes));
  }
  // Dead traces and padding often have no numbers.
  std::size_t kept = 0;
  for (std::size_t n = 0; n < sample.size(); ++n) {
    if (read_trace_header(sample.header(n), {}, layout.swap, 0).dead) continue;
    if (kept != n) {
      std::copy_n(sample.headers.begin() + static_cast<std::ptrdiff_t>(n * sample.header_bytes),
                  sample.header_bytes,
                  sample.headers.begin() + static_cast<std::ptrdiff_t>(kept * sample.header_bytes));
      sample.traces[kept] = sample.traces[n];
    }
    ++kept;
  }
  if (kept > 0) {
    sample.traces.resize(kept);
    sample.headers.resize(kept * sample.header_bytes);
  }
  return sample;
}

// One word of all sampled traces that could be a line number.
struct Column {
  HeaderWord word;
  std::vector<std::int32_t> values;
  LineSteps steps;
  std::int64_t changes = 0;  // between traces that follow each other in the file
};

bool follow(const Sample& sample, std::size_t n) {
  return sample.traces[n] == sample.traces[n - 1] + 1;
}

// Nothing for constants and for what cannot be line numbers.
std::optional<Column> line_column(const Sample& sample, const HeaderWord& word, bool swap) {
  Column column{word, {}, {}, 0};
  column.values.reserve(sample.size());
  StepsSoFar steps;
  bool above_one = false;
  for (std::size_t n = 0; n < sample.size(); ++n) {
    const double value = value_of(word, sample.header(n), swap, sample.traces[n]);
    if (!(std::fabs(value) <= kLargestLine) || value != std::nearbyint(value)) return std::nullopt;
    above_one = above_one || std::fabs(value) >= 1;
    const auto line = static_cast<std::int32_t>(value);
    steps.add(line);
    if (n > 0 && follow(sample, n) && line != column.values.back()) ++column.changes;
    column.values.push_back(line);
  }
  column.steps = steps.steps();
  if (column.steps.lowest == column.steps.highest || !above_one) return std::nullopt;
  return column;
}

// The more usual the place, the lower; line numbers that several words hold come from the lowest.
int rank_of(const HeaderWord& word) {
  constexpr std::array kUsual{189, 193, 21, 181, 185, 9, 13, 5, 17, 213, 217, 197, 25, 1};
  const auto at = std::find(kUsual.begin(), kUsual.end(), word.byte);
  const int type = word.type == WordType::kInt32 ? 0 : word.type == WordType::kInt16 ? 200 : 100;
  return static_cast<int>(at - kUsual.begin()) + type;
}

bool overlaps(const HeaderWord& a, const HeaderWord& b) {
  return a.byte < b.byte + size_of(b.type) && b.byte < a.byte + size_of(a.type);
}

// True where b = p a + q for all traces.
bool same_lines(const Column& a, const Column& b) {
  const double along = static_cast<double>(a.steps.highest - a.steps.lowest);
  const auto lowest =
      static_cast<std::size_t>(std::min_element(a.values.begin(), a.values.end()) - a.values.begin());
  const auto highest =
      static_cast<std::size_t>(std::max_element(a.values.begin(), a.values.end()) - a.values.begin());
  const double slope = (static_cast<double>(b.values[highest]) - b.values[lowest]) / along;
  if (slope == 0) return false;
  for (std::size_t n = 0; n < a.values.size(); ++n) {
    const double expected = b.values[lowest] + slope * (static_cast<double>(a.values[n]) - a.values[lowest]);
    if (std::fabs(expected - b.values[n]) > 1e-6 * (1 + std::fabs(expected))) return false;
  }
  return true;
}

// All words that could be line numbers, each set of numbers once, the most usual places first.
std::vector<Column> line_columns(const Sample& sample, bool swap) {
  std::vector<HeaderWord> words;
  const auto last = static_cast<int>(kTraceHeaderBytes);
  for (int byte = 1; byte + 3 <= last; byte += 4) {
    for (const WordType type : {WordType::kInt32, WordType::kIeee, WordType::kIbm})
      words.emplace_back(byte, type);
  }
  for (int byte = 1; byte < last; byte += 2) words.emplace_back(byte, WordType::kInt16);
  std::stable_sort(words.begin(), words.end(),
                   [](const HeaderWord& a, const HeaderWord& b) { return rank_of(a) < rank_of(b); });
  std::vector<Column> columns;
  for (const HeaderWord& word : words) {
    if (columns.size() == kMostColumns) break;
    auto column = line_column(sample, word, swap);
    if (!column) continue;
    const bool known = std::any_of(columns.begin(), columns.end(), [&](const Column& other) {
      return overlaps(word, other.word) || same_lines(other, *column);
    });
    if (!known) columns.push_back(std::move(*column));
  }
  return columns;
}

// Coordinates of all sampled traces.
struct Positions {
  HeaderWord x, y;
  std::vector<std::array<double, 2>> at;
};

// Integers of coordinates are below the bits of 1.0f, or as floats are absurd: whole numbers beyond both are
// floats. As integers they would be as regular, since the bits of floats rise with them.
bool is_float(const HeaderWord& word, const Sample& sample, bool swap) {
  bool any = false;
  for (std::size_t n = 0; n < sample.size(); ++n) {
    if (value_of(word, sample.header(n), swap, 0) == 0) continue;
    const double size = std::fabs(value_of({word.byte, WordType::kIeee}, sample.header(n), swap, 0));
    if (!(size >= 1 && size < kLargestCoordinate)) return false;
    any = true;
  }
  return any;
}

std::vector<Positions> position_pairs(const Sample& sample, const Layout& layout) {
  std::vector<std::array<HeaderWord, 2>> words;
  if (layout.has_extension) {
    words.push_back({HeaderWord(401, WordType::kFloat64), HeaderWord(409, WordType::kFloat64)});
  }
  for (const WordType type : {WordType::kInt32, WordType::kIeee, WordType::kIbm}) {
    for (const int byte : {181, 73, 81, 189})
      words.push_back({HeaderWord(byte, type), HeaderWord(byte + 4, type)});
  }
  std::vector<Positions> pairs;
  for (const auto& [x, y] : words) {
    if (x.type == WordType::kInt32 && is_float(x, sample, layout.swap) && is_float(y, sample, layout.swap))
      continue;
    HeaderBytes at;
    at.x = x;
    at.y = y;
    Positions pair{x, y, {}};
    pair.at.reserve(sample.size());
    bool usable = true, moves = false;
    for (std::size_t n = 0; n < sample.size() && usable; ++n) {
      const TraceHeader header = read_trace_header(sample.header(n), at, layout.swap, sample.traces[n]);
      pair.at.push_back({header.x, header.y});
      usable = std::fabs(header.x) < kLargestCoordinate && std::fabs(header.y) < kLargestCoordinate;
      moves = moves || pair.at[n] != pair.at[0];
    }
    if (usable && moves) pairs.push_back(std::move(pair));
  }
  return pairs;
}

// How well the lines go with the coordinates that suit them best.
template <class LineOf>
void fit_positions(const std::vector<Positions>& pairs, const LineOf& lines_of, double bins_per_u,
                   double bins_per_v, LineCandidate& candidate) {
  candidate.x = candidate.y = kNoWord;
  candidate.misfit = std::numeric_limits<double>::quiet_NaN();
  for (const Positions& pair : pairs) {
    const auto taken = [&](const HeaderWord& line) {
      return overlaps(line, pair.x) || overlaps(line, pair.y);
    };
    if (taken(candidate.inline_word) || taken(candidate.crossline_word)) continue;
    Moments moments;
    for (std::size_t n = 0; n < pair.at.size(); ++n) {
      const auto [u, v] = lines_of(n);
      if (pair.at[n][0] != 0 || pair.at[n][1] != 0)
        moments.add(u * bins_per_u, v * bins_per_v, pair.at[n][0], pair.at[n][1]);
    }
    const double misfit = misfit_in_bins(fit_map(moments));
    // A pair that fits well is taken before later ones that happen to fit a little better.
    const bool better =
        std::isnan(candidate.misfit) || (candidate.misfit > kGoodFit && misfit < candidate.misfit);
    if (!std::isnan(misfit) && better) {
      candidate.misfit = misfit;
      candidate.x = pair.x;
      candidate.y = pair.y;
    }
  }
}

double fit_score(double misfit) {
  if (std::isnan(misfit)) return 0.5;
  return misfit <= kGoodFit ? 1 : 0.1;
}

void name_preset(LineCandidate& candidate) {
  const Preset* lines_alone = nullptr;
  for (const Preset& preset : presets()) {
    if (preset.inline_word != candidate.inline_word || preset.crossline_word != candidate.crossline_word)
      continue;
    if (preset.x == candidate.x && preset.y == candidate.y) {
      candidate.preset = preset.name;
      return;
    }
    if (lines_alone == nullptr) lines_alone = &preset;
  }
  if (lines_alone != nullptr && candidate.x == kNoWord) candidate.preset = lines_alone->name;
}

bool is_preset(const HeaderWord& inline_word, const HeaderWord& crossline_word) {
  return std::any_of(presets().begin(), presets().end(), [&](const Preset& preset) {
    return preset.name != "swapped" && preset.inline_word == inline_word &&
           preset.crossline_word == crossline_word;
  });
}

// Share of sampled traces whose pair of lines no other sampled trace has.
double unique_share(const Column& a, const Column& b) {
  std::vector<std::array<std::int32_t, 2>> pairs(a.values.size());
  for (std::size_t n = 0; n < pairs.size(); ++n) pairs[n] = {a.values[n], b.values[n]};
  std::sort(pairs.begin(), pairs.end());
  const auto end = std::unique(pairs.begin(), pairs.end());
  return static_cast<double>(end - pairs.begin()) / static_cast<double>(a.values.size());
}

// Share of traces that follow each other in the file and are neighbours on a line of the one kind or the
// other.
double neighbour_share(const Sample& sample, const Column& a, const Column& b) {
  std::int64_t pairs = 0, neighbours = 0;
  for (std::size_t n = 1; n < sample.size(); ++n) {
    if (!follow(sample, n)) continue;
    ++pairs;
    const std::int64_t da = std::int64_t{a.values[n]} - a.values[n - 1];
    const std::int64_t db = std::int64_t{b.values[n]} - b.values[n - 1];
    if ((da == 0 && std::abs(db) == b.steps.step) || (db == 0 && std::abs(da) == a.steps.step)) ++neighbours;
  }
  return pairs == 0 ? 0 : static_cast<double>(neighbours) / static_cast<double>(pairs);
}

std::optional<LineCandidate> pair_candidate(const Sample& sample, const Layout& layout, const Column& first,
                                            const Column& second, const std::vector<Positions>& positions) {
  constexpr double kLeastUnique = 0.98;
  constexpr double kLeastFill = 0.02;
  const double bins = static_cast<double>(first.steps.count()) * static_cast<double>(second.steps.count());
  const double fill = static_cast<double>(layout.traces) / bins;
  if (fill < kLeastFill || unique_share(first, second) < kLeastUnique) return std::nullopt;
  // Which of them is the inline cannot be told; the one that changes more slowly mostly is.
  const bool forward = is_preset(first.word, second.word) ||
                       (!is_preset(second.word, first.word) && first.changes <= second.changes);
  const Column& a = forward ? first : second;
  const Column& b = forward ? second : first;
  LineCandidate candidate;
  candidate.inline_word = a.word;
  candidate.crossline_word = b.word;
  candidate.inlines = a.steps.count();
  candidate.crosslines = b.steps.count();
  candidate.fill = std::min(fill, 1.0);
  candidate.hits = neighbour_share(sample, a, b);
  fit_positions(
      positions,
      [&](std::size_t n) {
        return std::array{static_cast<double>(a.values[n]), static_cast<double>(b.values[n])};
      },
      1.0 / static_cast<double>(a.steps.step), 1.0 / static_cast<double>(b.steps.step), candidate);
  candidate.score = candidate.fill * (0.5 + 0.5 * candidate.hits) * fit_score(candidate.misfit);
  name_preset(candidate);
  return candidate;
}

// A 2-D line: one word, or the order in the file, that numbers the traces along it.
std::optional<LineCandidate> line_candidate(const Sample& sample, const Layout& layout, const Column& column,
                                            const std::vector<Positions>& positions) {
  const double fill = static_cast<double>(layout.traces) / static_cast<double>(column.steps.count());
  if (column.changes + 1 < static_cast<std::int64_t>(sample.size()) &&
      layout.traces == static_cast<std::int64_t>(sample.size()))
    return std::nullopt;
  Column constant = column;
  std::fill(constant.values.begin(), constant.values.end(), 1);
  if (fill < 0.5 || fill > 1 || unique_share(column, constant) < 1) return std::nullopt;
  LineCandidate candidate;
  candidate.inline_word = kNoWord;
  candidate.crossline_word = column.word;
  candidate.crosslines = column.steps.count();
  candidate.fill = fill;
  candidate.hits = neighbour_share(sample, constant, column);
  fit_positions(
      positions,
      [&](std::size_t n) {
        return std::array{1.0, static_cast<double>(column.values[n])};
      },
      1, 1.0 / static_cast<double>(column.steps.step), candidate);
  // Lines are seldom straight: neither a good nor a bad fit says much.
  candidate.score = candidate.fill * candidate.hits * (candidate.misfit <= kGoodFit ? 1 : 0.5);
  name_preset(candidate);
  return candidate;
}

bool offsets_agree(const Sample& sample, bool swap) {
  for (std::size_t n = 1; n < sample.size(); ++n) {
    if (value_of(37, sample.header(n), swap, 0) != value_of(37, sample.header(0), swap, 0)) return false;
  }
  return true;
}

}  // namespace

std::vector<LineCandidate> find_candidates(const detail::ReadOnlyFile& file, const Layout& layout) {
  const Sample sample = read_sample(file, layout);
  if (sample.size() < 2) return {};
  const std::vector<Column> columns = line_columns(sample, layout.swap);
  const std::vector<Positions> positions = position_pairs(sample, layout);
  std::vector<LineCandidate> candidates;
  for (std::size_t n = 0; n < columns.size(); ++n) {
    for (std::size_t m = n + 1; m < columns.size(); ++m) {
      if (auto found = pair_candidate(sample, layout, columns[n], columns[m], positions))
        candidates.push_back(std::move(*found));
    }
  }
  const bool stacked = offsets_agree(sample, layout.swap);
  const bool any_grid = std::any_of(candidates.begin(), candidates.end(), [](const LineCandidate& candidate) {
    return candidate.inlines > 1 && candidate.crosslines > 1 && candidate.misfit <= kGoodFit;
  });
  if (stacked && !any_grid) {
    bool numbered = false;  // the order of the file is no better than a number that says the same
    const auto order = line_column(sample, kOrderWord, layout.swap);
    for (const Column& column : columns) {
      auto found = line_candidate(sample, layout, column, positions);
      if (!found) continue;
      numbered = numbered || (found->misfit <= kGoodFit && order && same_lines(column, *order));
      candidates.push_back(std::move(*found));
    }
    if (order && !numbered) {
      auto found = line_candidate(sample, layout, *order, positions);
      // The order of the file is a line only where the traces lie along one.
      if (found && found->misfit <= kGoodFit) candidates.push_back(std::move(*found));
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const LineCandidate& a, const LineCandidate& b) { return a.score > b.score; });
  std::erase_if(candidates, [](const LineCandidate& candidate) { return candidate.score < kLeastScore; });
  if (candidates.size() > kMostCandidates) candidates.resize(kMostCandidates);
  for (LineCandidate& candidate : candidates) candidate.one_offset = stacked;
  return candidates;
}

std::optional<LineCandidate> beyond_doubt(const std::vector<LineCandidate>& candidates) {
  constexpr double kNear = 0.7;
  if (candidates.empty()) return std::nullopt;
  const LineCandidate& best = candidates.front();
  if (!best.one_offset || !(best.misfit <= kGoodFit)) return std::nullopt;
  if (candidates.size() > 1 && candidates[1].score > kNear * best.score) return std::nullopt;
  return best;
}

}  // namespace footwall::formats::segy
