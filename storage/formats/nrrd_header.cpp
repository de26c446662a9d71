// Based on: "Definition of NRRD File Format", Teem project.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/detail/read_only_file.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/nrrd.h"

namespace footwall::formats::nrrd {
namespace {

constexpr double kUnstated = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kMostHeader = std::int64_t{16} << 20;  // bytes; a list may name many files
constexpr std::int64_t kMostFiles = 1000000;
constexpr std::size_t kMostDimension = 16;  // NRRD's own limit

struct TypeName {
  std::string_view name;
  SampleType type;
};
// All the spellings that the definition lists.
constexpr TypeName kTypes[] = {{"signed char", SampleType::kInt8},
                               {"int8", SampleType::kInt8},
                               {"int8_t", SampleType::kInt8},
                               {"uchar", SampleType::kUint8},
                               {"unsigned char", SampleType::kUint8},
                               {"uint8", SampleType::kUint8},
                               {"uint8_t", SampleType::kUint8},
                               {"short", SampleType::kInt16},
                               {"short int", SampleType::kInt16},
                               {"signed short", SampleType::kInt16},
                               {"signed short int", SampleType::kInt16},
                               {"int16", SampleType::kInt16},
                               {"int16_t", SampleType::kInt16},
                               {"ushort", SampleType::kUint16},
                               {"unsigned short", SampleType::kUint16},
                               {"unsigned short int", SampleType::kUint16},
                               {"uint16", SampleType::kUint16},
                               {"uint16_t", SampleType::kUint16},
                               {"int", SampleType::kInt32},
                               {"signed int", SampleType::kInt32},
                               {"int32", SampleType::kInt32},
                               {"int32_t", SampleType::kInt32},
                               {"uint", SampleType::kUint32},
                               {"unsigned int", SampleType::kUint32},
                               {"uint32", SampleType::kUint32},
                               {"uint32_t", SampleType::kUint32},
                               {"longlong", SampleType::kInt64},
                               {"long long", SampleType::kInt64},
                               {"long long int", SampleType::kInt64},
                               {"signed long long", SampleType::kInt64},
                               {"signed long long int", SampleType::kInt64},
                               {"int64", SampleType::kInt64},
                               {"int64_t", SampleType::kInt64},
                               {"ulonglong", SampleType::kUint64},
                               {"unsigned long long", SampleType::kUint64},
                               {"unsigned long long int", SampleType::kUint64},
                               {"uint64", SampleType::kUint64},
                               {"uint64_t", SampleType::kUint64},
                               {"float", SampleType::kFloat32},
                               {"double", SampleType::kFloat64}};

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& letter : out) {
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  }
  return out;
}

// Numbers as NRRD has them: "nan" and "inf" too.
std::optional<double> number(std::string_view word) {
  return text::number(word);
}

// "(1,2,3)" or "none".
std::optional<std::vector<double>> vector_from(std::string_view word) {
  if (word.size() < 3 || word.front() != '(' || word.back() != ')') return std::nullopt;
  std::vector<double> values;
  for (const std::string_view part : text::split(word.substr(1, word.size() - 2), ',')) {
    const auto value = number(part);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

// Vectors may have blanks inside their brackets.
std::vector<std::string_view> vector_words(std::string_view value) {
  std::vector<std::string_view> words;
  std::size_t at = 0;
  while ((at = value.find_first_not_of(" \t", at)) != std::string_view::npos) {
    std::size_t end = value[at] == '(' ? value.find(')', at) : value.find_first_of(" \t", at);
    if (value[at] == '(' && end != std::string_view::npos) ++end;
    if (end == std::string_view::npos) end = value.size();
    words.push_back(value.substr(at, end - at));
    at = end;
  }
  return words;
}

std::vector<std::string> quoted_words(std::string_view value) {
  std::vector<std::string> words;
  std::size_t at = 0;
  while ((at = value.find_first_not_of(" \t", at)) != std::string_view::npos) {
    const bool quoted = value[at] == '"';
    if (quoted) ++at;
    const std::size_t end = std::min(value.find_first_of(quoted ? "\"" : " \t", at), value.size());
    words.push_back(detail::as_utf8(value.substr(at, end - at)));
    at = end + (quoted && end < value.size() ? 1 : 0);
  }
  return words;
}

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
    const auto one = number(word);
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
    const std::string wanted = lower(value);
    const auto* found = std::find_if(std::begin(kTypes), std::end(kTypes),
                                     [&](const TypeName& row) { return row.name == wanted; });
    if (found == std::end(kTypes)) {
      refuse(wanted == "block" ? ErrorCode::kUnsupported : ErrorCode::kFormat,
             fmt::format("samples of type '{}' are not read", detail::as_utf8(value)));
    }
    header_.type = found->type;
    typed_ = true;
    return;
  }
  if (name == "encoding") {
    const std::string wanted = lower(value);
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
    const std::string wanted = lower(value);
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
    header_.space = lower(value);
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
    std::string name = lower(text::trimmed(line.substr(0, bare)));
    std::erase(name, ' ');
    field(name, text::trimmed(line.substr(bare + 1)));
    if (name == "datafile" && at_ >= bytes_.size()) break;
  }
  finish(attached);
  return std::move(header_);
}

}  // namespace

std::string_view name_of(SampleType type) {
  constexpr std::string_view kNames[] = {"int8",   "uint8", "int16",  "uint16", "int32",
                                         "uint32", "int64", "uint64", "float",  "double"};
  return kNames[static_cast<std::size_t>(type)];
}

std::int64_t size_of(SampleType type) {
  constexpr std::int64_t kSizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

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
