// Based on: "Definition of NRRD File Format", Teem project.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/letters.h"
#include "storage/formats/detail/nrrd_words.h"
#include "storage/formats/detail/read_only_file.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/nrrd.h"

namespace footwall::formats::nrrd {
namespace {

constexpr double kUnstated = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kMostHeader = std::int64_t{16} << 20;  // bytes; a list may name many files
constexpr std::int64_t kMostFiles = 1000000;
constexpr std::size_t kMostDimension = 16;  // NRRD's own limit

class Parser {
 public:
  Parser(const std::filesystem::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  Header parse();

 private:
  // The next line without its end; false at the end of the file.
  bool next(std::string_view& line);
  void field(const std::string& name, std::string_view value);
  void finish(bool attached);
  void place_data_file(std::string_view value);
  void list_files();
  void numbered_files(const std::vector<std::string_view>& words);
  void add_file(std::string_view name);
  std::vector<double> axis_numbers(std::string_view value);
  void reduce_to_three();
  [[noreturn]] void refuse(ErrorCode code, const std::string& what, const std::string& hint = {}) const {
    throw Error(code, fmt::format("{}, line {}: {}", path_.string(), line_number_, what), hint);
  }
  [[noreturn]] void wrong(const std::string& what) const { refuse(ErrorCode::kFormat, what); }

  std::filesystem::path path_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::int64_t line_number_ = 0;
  Header header_;
  std::size_t dimension_ = 0;
  bool typed_ = false, encoded_ = false, endian_said_ = false, detached_ = false;
  std::vector<std::int64_t> sizes_;
  std::vector<double> spacings_, mins_;
  std::vector<std::string> units_;
  std::vector<std::vector<double>> directions_;
};

bool Parser::next(std::string_view& line) {
  if (at_ >= bytes_.size()) return false;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  line = bytes_.substr(at_, end - at_);
  at_ = std::min(end + 1, bytes_.size());
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ++line_number_;
  return true;
}

std::vector<double> Parser::axis_numbers(std::string_view value) {
  std::vector<double> numbers;
  for (const std::string_view word : text::words(value)) {
    const auto one = text::number(word);
    if (!one) wrong(fmt::format("'{}' is no number", word));
    numbers.push_back(*one);
  }
  if (numbers.size() != dimension_) {
    wrong(fmt::format("{} numbers for {} axes", numbers.size(), dimension_));
  }
  return numbers;
}

void Parser::add_file(std::string_view name) {
  const std::string text(text::trimmed(name));
  if (text.empty() || text.find('\0') != std::string::npos) wrong("a data file without a name");
  const std::filesystem::path file(text);
  const bool upward = std::find(file.begin(), file.end(), "..") != file.end();
  if (file.is_absolute() || upward) {
    refuse(ErrorCode::kInvalid,
           fmt::format("the data file '{}' is not in the header's folder or below", detail::as_utf8(text)),
           "put the files together and name them relative to the header");
  }
  if (static_cast<std::int64_t>(header_.files.size()) >= kMostFiles) wrong("more than a million data files");
  header_.files.push_back(path_.parent_path() / file);
}

void Parser::list_files() {
  for (std::string_view line; next(line);) {
    if (!text::trimmed(line).empty()) add_file(line);
  }
}

// "name.%03d 1 93 1 [axes a file]"
void Parser::numbered_files(const std::vector<std::string_view>& words) {
  const std::string_view pattern = words[0];
  const auto first = text::integer(words[1]);
  const auto last = text::integer(words[2]);
  const auto step = text::integer(words[3]);
  const std::size_t percent = pattern.find('%');
  std::size_t end = percent == std::string_view::npos ? percent : percent + 1;
  bool zeros = false;
  int width = 0;
  while (end < pattern.size() && pattern[end] >= '0' && pattern[end] <= '9') {
    zeros = zeros || (pattern[end] == '0' && end == percent + 1);
    width = std::min(100, width * 10 + (pattern[end] - '0'));
    ++end;
  }
  if (!first || !last || !step || *step == 0 || end >= pattern.size() || pattern[end] != 'd' ||
      pattern.find('%', end) != std::string_view::npos) {
    wrong("data files are numbered as in 'slice.%03d 1 93 1'");
  }
  const auto sensible = [](std::int64_t number) { return number >= 0 && number <= 1000 * kMostFiles; };
  if (!sensible(*first) || !sensible(*last) || (*last - *first) / *step < 0 ||
      (*last - *first) / *step >= kMostFiles) {
    wrong("the data files' numbers make no range");
  }
  const std::int64_t count = (*last - *first) / *step + 1;
  for (std::int64_t n = 0; n < count; ++n) {
    const std::int64_t number = *first + n * *step;
    const std::string digits =
        zeros ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width);
    add_file(fmt::format("{}{}{}", pattern.substr(0, percent), digits, pattern.substr(end + 1)));
  }
}

void Parser::place_data_file(std::string_view value) {
  detached_ = true;
  const auto words = text::words(value);
  if (words.empty()) wrong("the data file has no name");
  const bool list = words[0] == "LIST";
  const bool numbered = !list && words.size() >= 4 && words[0].find('%') != std::string_view::npos;
  const std::size_t optional = list ? 1 : 4;
  if ((list || numbered) && words.size() > optional) {
    // How many axes a file holds; only the usual one less than all is read as such.
    const auto axes = text::integer(words[optional]);
    if (!axes || *axes < 1 || (dimension_ > 0 && static_cast<std::size_t>(*axes) > dimension_)) {
      wrong(fmt::format("'{}' is no number of axes a file", words[optional]));
    }
    if (dimension_ > 0 && static_cast<std::size_t>(*axes) + 1 < dimension_) {
      refuse(ErrorCode::kUnsupported, "data files that hold less than a slice are not read",
             "join them to one file");
    }
  }
  if (list) {
    list_files();
  } else if (numbered) {
    numbered_files(words);
  } else {
    add_file(value);
  }
}

void Parser::field(const std::string& name, std::string_view value) {
  if (name == "dimension") {
    const auto n = text::integer(value);
    if (!n || *n < 1 || *n > static_cast<std::int64_t>(kMostDimension)) wrong("the dimension is 1 to 16");
    dimension_ = static_cast<std::size_t>(*n);
    return;
  }
  if (name == "type") {
    const auto type = type_named(value);
    if (!type) {
      refuse(detail::lower(value) == "block" ? ErrorCode::kUnsupported : ErrorCode::kFormat,
             fmt::format("samples of type '{}' are not read", detail::as_utf8(value)));
    }
    header_.type = *type;
    typed_ = true;
    return;
  }
  if (name == "encoding") {
    const std::string wanted = detail::lower(value);
    encoded_ = true;
    if (wanted == "raw") {
      header_.encoding = Encoding::kRaw;
    } else if (wanted == "gzip" || wanted == "gz") {
      header_.encoding = Encoding::kGzip;
    } else {
      refuse(ErrorCode::kUnsupported, fmt::format("encoding '{}' is not read", detail::as_utf8(value)),
             "rewrite it with encoding raw or gzip, e.g. unu save -e gzip");
    }
    return;
  }
  if (name == "endian") {
    const std::string wanted = detail::lower(value);
    if (wanted != "little" && wanted != "big") wrong(fmt::format("'{}' is no byte order", value));
    header_.big_endian = wanted == "big";
    endian_said_ = true;
    return;
  }
  if (name == "content") {
    header_.content = detail::as_utf8(value);
    return;
  }
  if (name == "space") {
    header_.space = detail::lower(value);
    return;
  }
  if (name == "datafile") return place_data_file(value);
  const bool needs_dimension = name == "sizes" || name == "spacings" || name == "axismins" ||
                               name == "units" || name == "spacedirections";
  if (needs_dimension && dimension_ == 0) wrong("the dimension must come first");
  if (name == "sizes") {
    sizes_.clear();
    for (const std::string_view word : text::words(value)) {
      const auto n = text::integer(word);
      if (!n || *n < 1) wrong(fmt::format("'{}' is no number of samples", word));
      sizes_.push_back(*n);
    }
    if (sizes_.size() != dimension_) wrong(fmt::format("{} sizes for {} axes", sizes_.size(), dimension_));
  } else if (name == "spacings") {
    spacings_ = axis_numbers(value);
  } else if (name == "axismins") {
    mins_ = axis_numbers(value);
  } else if (name == "units") {
    units_ = quoted_words(value);
    if (units_.size() != dimension_) wrong(fmt::format("{} units for {} axes", units_.size(), dimension_));
  } else if (name == "spaceunits") {
    header_.space_units = quoted_words(value);
  } else if (name == "spaceorigin") {
    const auto origin = vector_from(value);
    if (!origin) wrong("the space origin is written as (x,y,z)");
    header_.space_origin = *origin;
  } else if (name == "spacedirections") {
    directions_.clear();
    for (const std::string_view word : vector_words(value)) {
      const auto direction = vector_from(word);
      if (!direction && word != "none") wrong(fmt::format("'{}' is no direction", word));
      directions_.push_back(direction.value_or(std::vector<double>{}));
    }
    if (directions_.size() != dimension_) {
      wrong(fmt::format("{} directions for {} axes", directions_.size(), dimension_));
    }
  } else if (name == "lineskip" || name == "byteskip") {
    const auto n = text::integer(value);
    if (!n || *n < (name == "byteskip" ? -1 : 0)) wrong(fmt::format("'{}' cannot be skipped", value));
    (name == "byteskip" ? header_.byte_skip : header_.line_skip) = *n;
  } else if (name != "spacedimension" && name != "kinds" && name != "labels" && name != "centers" &&
             name != "centerings" && name != "axismaxs" && name != "number" && name != "min" &&
             name != "max") {
    header_.skipped.push_back(name);
  }
}

// Axes of one sample are dropped from files of more than three, and added to files of less.
void Parser::reduce_to_three() {
  std::vector<Axis> axes(dimension_);
  for (std::size_t n = 0; n < dimension_; ++n) {
    axes[n].size = sizes_[n];
    axes[n].spacing = spacings_.empty() ? kUnstated : spacings_[n];
    axes[n].min = mins_.empty() ? kUnstated : mins_[n];
    if (!units_.empty()) axes[n].unit = units_[n];
    if (!directions_.empty()) axes[n].direction = directions_[n];
  }
  while (axes.size() > 3) {
    const auto single =
        std::find_if(axes.begin(), axes.end(), [](const Axis& axis) { return axis.size == 1; });
    if (single == axes.end()) {
      refuse(ErrorCode::kUnsupported,
             fmt::format("{} axes: a volume has three, of one value a sample", dimension_),
             "take one component out of it, e.g. with unu slice");
    }
    axes.erase(single);
    header_.notes.emplace_back("an axis of one sample is left out");
  }
  if (axes.size() < 2) wrong("a volume needs at least two axes");
  header_.is_section = axes.size() == 2;
  if (header_.is_section) axes.push_back({1, kUnstated, kUnstated, "", {}});
  std::copy(axes.begin(), axes.end(), header_.axes.begin());
  std::int64_t bytes = size_of(header_.type);
  for (const Axis& axis : header_.axes) {
    if (__builtin_mul_overflow(bytes, axis.size, &bytes))
      wrong("the sizes make more samples than any file holds");
  }
}

void Parser::finish(bool attached) {
  if (dimension_ == 0 || sizes_.empty() || !typed_ || !encoded_) {
    wrong("the header ends without dimension, sizes, type and encoding");
  }
  if (attached && !detached_) header_.data_at = static_cast<std::int64_t>(at_);
  if (!attached && !detached_) wrong("the header has neither samples behind it nor a data file");
  if (detached_ && header_.files.empty()) wrong("the list of data files is empty");
  if (size_of(header_.type) > 1 && !endian_said_) {
    header_.notes.emplace_back("the byte order is not stated: little-endian is assumed");
  }
  if (header_.byte_skip == -1 && header_.encoding != Encoding::kRaw)
    wrong("byte skip -1 goes with encoding raw only");
  reduce_to_three();
  const auto files = static_cast<std::int64_t>(header_.files.size());
  // The file's slowest axis is cut into equal parts.
  std::int64_t slowest = sizes_.back();
  if (files > 1 && slowest % files != 0) {
    wrong(fmt::format("{} data files do not share {} slices evenly", files, slowest));
  }
}

Header Parser::parse() {
  std::string_view line;
  next(line);
  if (line.size() != 8 || line.substr(0, 7) != "NRRD000" || line[7] < '1' || line[7] > '9') {
    wrong("this is not NRRD: it does not begin with NRRD0001 to NRRD0005");
  }
  header_.version = line[7] - '0';
  if (header_.version > 5) {
    refuse(ErrorCode::kUnsupported,
           fmt::format("NRRD version {} is newer than this program", header_.version));
  }
  bool attached = false;
  while (next(line)) {
    if (line.empty()) {
      attached = true;
      break;
    }
    if (line.front() == '#') continue;
    const std::size_t key = line.find(":=");
    const std::size_t colon = line.find(": ");
    const std::size_t bare = line.find(':');
    if (key != std::string_view::npos && (colon == std::string_view::npos || key < colon)) {
      header_.keys[detail::as_utf8(line.substr(0, key))] = detail::as_utf8(line.substr(key + 2));
      continue;
    }
    if (bare == std::string_view::npos) wrong("neither 'field: value' nor 'key:=value'");
    std::string name = detail::lower(text::trimmed(line.substr(0, bare)));
    std::erase(name, ' ');
    field(name, text::trimmed(line.substr(bare + 1)));
    if (name == "datafile" && at_ >= bytes_.size()) break;
  }
  finish(attached);
  return std::move(header_);
}

}  // namespace

bool looks_like_nrrd(const std::filesystem::path& path) {
  try {
    const detail::ReadOnlyFile file(path);
    char first[7];
    if (file.size() < 8) return false;
    file.read_at(0, std::as_writable_bytes(std::span(first)));
    return std::string_view(first, 7) == "NRRD000";
  } catch (const Error&) {
    return false;  // the question was only whether it looks like one
  }
}

Header read_header(const std::filesystem::path& path) {
  const detail::ReadOnlyFile file(path);
  // Headers are short; what is longer is read on until its end is found.
  std::string bytes;
  for (std::int64_t size = 1 << 16;; size *= 16) {
    const std::int64_t wanted = std::min({size, kMostHeader, file.size()});
    bytes.resize(static_cast<std::size_t>(wanted));
    file.read_at(0, std::as_writable_bytes(std::span(bytes)));
    const bool whole = wanted == file.size();
    const bool ended = bytes.find("\n\n") != std::string::npos || bytes.find("\n\r\n") != std::string::npos;
    if (whole || ended) break;
    if (wanted == kMostHeader) {
      throw Error(ErrorCode::kFormat, fmt::format("{}: the NRRD header has no end within {} MiB",
                                                  path.string(), kMostHeader >> 20));
    }
  }
  return Parser(path, bytes).parse();
}

raw::AxisOrder default_order(const Header& header) {
  return header.is_section ? raw::AxisOrder{0, 2, 1} : raw::AxisOrder{2, 1, 0};
}

}  // namespace footwall::formats::nrrd
