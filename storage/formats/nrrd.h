// NRRD in and out: a short text header, then the samples, in the same file or in others beside it.
// Based on: the "Definition of NRRD File Format" (NRRD0001 to NRRD0005, Teem project); axes here are named as
// everywhere in Footwall, from the slowest to the fastest, NRRD counts them from the fastest.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "storage/base/job_context.h"
#include "storage/formats/raw.h"
#include "storage/survey/geometry.h"

namespace footwall::formats::nrrd {

enum class Encoding : std::uint8_t { kRaw, kGzip };
enum class SampleType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};
// Any of the spellings of the definition, in any case; nothing for other words.
std::optional<SampleType> type_named(std::string_view word);
std::string_view name_of(SampleType type);  // NRRD's name, e.g. "int16"
std::int64_t size_of(SampleType type);      // bytes

// One axis of the file; numbers that the header does not state are NaN, texts empty.
struct Axis {
  std::int64_t size = 1;
  double spacing;
  double min;
  std::string unit;
  std::vector<double> direction;  // in the file's space; empty where not stated ("none")
  bool stated() const { return spacing == spacing || !direction.empty(); }
};

// What the header says, checked; axes as in the file, the fastest first, always three.
struct Header {
  int version = 4;
  SampleType type = SampleType::kFloat32;
  Encoding encoding = Encoding::kRaw;
  bool big_endian = false;
  std::array<Axis, 3> axes;
  bool is_section = false;  // two axes in the file; the third was added
  std::string content;
  std::string space;
  std::vector<std::string> space_units;
  std::vector<double> space_origin;  // empty where not stated
  std::int64_t line_skip = 0;
  std::int64_t byte_skip = 0;                // -1: the samples are the last bytes
  std::int64_t data_at = 0;                  // of an attached header: where the data part begins
  std::vector<std::filesystem::path> files;  // of a detached one, beside the header; each holds one part
  std::map<std::string, std::string> keys;   // key:=value
  std::vector<std::string> skipped;          // fields that are not used, by name
  std::vector<std::string> notes;            // what was dropped or taken for granted, in words
};

// True for files that begin with NRRD000; never throws for content.
bool looks_like_nrrd(const std::filesystem::path& path);
// Reads the header alone. Throws kNotFound, kIo; kFormat with the line for what makes no sense; kUnsupported
// for other encodings (text, hex, bzip2), blocks, newer versions and more than three axes; kInvalid for
// data files that are named by absolute paths or lie above the header's folder.
Header read_header(const std::filesystem::path& path);

// What an axis order means where none is given: inlines fastest ("kji"), so that dims are in the order of
// the header's sizes; of a file with two axes ("ikj") one inline, crosslines fastest.
raw::AxisOrder default_order(const Header& header);

// How z and lines are to be understood where the file does not say; contradictions with it are refused.
struct Meaning {
  std::optional<survey::Domain> domain;
  std::optional<survey::VerticalUnit> vertical_unit;
  std::optional<double> interval;
  std::string crs;
  // Where neither the file nor the two above say it: the project's survey.
  std::optional<survey::Domain> domain_otherwise;
  std::optional<survey::VerticalUnit> unit_otherwise;
};
// Spacings, directions and origin as a survey's geometry, with everything assumed in `assumed`. `complete`
// tells whether the file itself says where it lies (a space origin with directions, or our own keys).
// Throws kUsage where domain or unit are neither said nor given, kInvalid for contradictions.
struct Placed {
  survey::Geometry geometry;
  bool complete = false;
  bool interval_stated = false;  // by the file
};
Placed geometry_of(const Header& header, const raw::AxisOrder& order, const Meaning& meaning);

// Streams. Of a gzip file the samples are first unpacked into an unnamed file in `scratch`, which the system
// removes even after a crash; never more than the header announces.
class NrrdFile {
 public:
  // Throws what read_header throws; kCorrupt where samples are missing, kIo (no room in scratch), kCancelled.
  NrrdFile(const std::filesystem::path& path, const std::filesystem::path& scratch, const JobContext& job);
  NrrdFile(NrrdFile&&) noexcept;
  NrrdFile& operator=(NrrdFile&&) noexcept;
  ~NrrdFile();

  const Header& header() const;
  // As raw::RawFile::read_block. Integers of more than 24 bits and doubles are rounded to the nearest
  // float; doubles beyond float32 become its largest.
  void read_block(const raw::AxisOrder& order, const survey::Box& box, std::span<float> values) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// float32 little-endian, raw, attached, NRRD0005, axes in `order`; the geometry in space directions (x, y,
// and z positive down) and, for what they cannot say (line numbers, domain, CRS), in keys that
// geometry_of() understands. Nulls are NaN. Throws kIo, what read throws, kCancelled.
void write(const std::filesystem::path& path, const survey::Geometry& geometry, const raw::AxisOrder& order,
           const std::string& content, const raw::BoxReader& read, const JobContext& job = {});

}  // namespace footwall::formats::nrrd
