#include "storage/formats/other_files.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "storage/base/text.h"
#include "storage/formats/detail/bytes.h"
#include "storage/formats/detail/text_rows.h"

namespace footwall::formats {
namespace {

struct Signature {
  std::string_view bytes;
  std::string_view what;
  std::string_view use;
};

constexpr std::string_view kVolume = "footwall import volume takes it";
constexpr std::string_view kSurface = "footwall import surface takes it";
constexpr std::string_view kPoints =
    "it holds points without sticks: name its columns with --columns if they are picks";
constexpr std::string_view kNothing = "export fault sticks as text from the program that wrote it";
constexpr std::string_view kGrid =
    "grids are not read: export fault sticks as text from the program that wrote it";

constexpr std::array<Signature, 12> kSignatures{{
    {"\x89HDF\r\n", "an HDF5 file",
     "a volume of Footwall belongs into the project's folder: footwall relink"},
    {"SQLite format 3", "a database, perhaps a Footwall project",
     "the project is named first, then the file"},
    {"\x89PNG", "a picture", kNothing},
    {"\x1F\x8B", "a compressed file (gzip)", "decompress it first"},
    {"PK\x03\x04", "a compressed file (zip)", "decompress it first"},
    {"NRRD000", "an NRRD volume", kVolume},
    {"\xFF\xFE", "text in UTF-16", "save it as UTF-8"},
    {"\xFE\xFF", "text in UTF-16", "save it as UTF-8"},
    {"# vtk DataFile", "a VTK file", kNothing},
    {"DSAA", "a Surfer grid", kGrid},
    {"DSBB", "a Surfer grid", kGrid},
    {"%PDF", "a PDF document", kNothing},
}};

bool is_segy(std::string_view head, std::uint64_t size) {
  constexpr std::size_t kTraces = 3600;
  if (head.size() < kTraces + 240) return false;
  const auto* bytes = reinterpret_cast<const std::byte*>(head.data());
  for (const bool swap : {true, false}) {
    const auto code = detail::load<std::uint16_t>(bytes + 3224, swap);
    if (code < 1 || code > 16 || code == 13 || code == 14) continue;
    constexpr std::array<std::uint64_t, 17> kBytes{0, 4, 4, 2, 4, 4, 8, 3, 1, 8, 4, 2, 8, 0, 0, 3, 1};
    const auto samples = detail::load<std::uint16_t>(bytes + 3220, swap);
    const auto texts = std::max<std::int16_t>(detail::load<std::int16_t>(bytes + 3504, swap), 0);
    const std::uint64_t first = kTraces + 3200 * static_cast<std::uint64_t>(texts);
    const std::uint64_t trace = 240 + samples * kBytes[code];
    // The sample count may stand elsewhere, and the last trace may be cut: a NUL among the codes is enough.
    if (samples == 0 || (size > first && (size - first) % trace == 0)) return true;
    if (head.substr(0, kTraces).find('\0') != std::string_view::npos && size >= first + trace) return true;
  }
  return false;
}

bool starts(std::string_view row, std::string_view word) {
  if (row.size() < word.size()) return false;
  for (std::size_t n = 0; n < word.size(); ++n) {
    if (std::toupper(static_cast<unsigned char>(row[n])) !=
        std::toupper(static_cast<unsigned char>(word[n]))) {
      return false;
    }
  }
  return true;
}

// GOCAD's files may hold several objects; sticks among them are worth reading.
std::optional<OtherFile> gocad_object(std::string_view head) {
  bool surface = false, other = false;
  for (detail::Rows rows(head); rows.next();) {
    const std::string_view row = text::trimmed(rows.row());
    if (!starts(row, "GOCAD ")) continue;
    const std::vector<std::string_view> words = text::words(row);
    if (words.size() < 2 || starts(words[1], "PLine") || starts(words[1], "VSet")) return std::nullopt;
    if (words[1].starts_with("_") || words[1].find('_') != std::string_view::npos) continue;
    surface |= starts(words[1], "TSurf");
    other = true;
  }
  if (surface) return OtherFile{"a GOCAD TSurf, a surface", std::string(kSurface)};
  if (other)
    return OtherFile{"a GOCAD file without PLine and VSet",
                     "of GOCAD's objects, PLine holds sticks, VSet points and TSurf surfaces"};
  return std::nullopt;
}

std::optional<OtherFile> text_file(std::string_view head) {
  const std::vector<std::string_view> rows = detail::first_rows(head);
  if (rows.empty()) return std::nullopt;
  if (starts(rows.front(), "<?xml") || starts(rows.front(), "<VTKFile")) {
    return OtherFile{head.find("<VTKFile") != std::string_view::npos ? "a VTK XML file" : "an XML file",
                     std::string(kNothing)};
  }
  if (auto found = gocad_object(head)) return found;
  for (const std::string_view row : rows) {
    if (!row.starts_with('@')) continue;
    for (const std::string_view field : text::split(row, ',')) {
      if (starts(field, "GRID")) return OtherFile{"a ZMAP+ grid", std::string(kGrid)};
    }
  }
  if (text::number(text::words(rows.front()).front()) == -996.0) {
    return OtherFile{"an IRAP classic grid", std::string(kGrid)};
  }
  if (head.starts_with("#Type: scattered data") ||
      head.find("\n#Type: scattered data") != std::string_view::npos) {
    return OtherFile{"scattered data (EarthVision)", std::string(kPoints)};
  }
  for (const std::string_view row : rows) {
    if (starts(row, "FSASCI")) return OtherFile{"a CPS-3 grid", std::string(kGrid)};
  }
  return std::nullopt;
}

}  // namespace

std::optional<OtherFile> recognise_other(std::string_view head, std::uint64_t size) {
  if (is_segy(head, size)) return OtherFile{"a SEG-Y file", std::string(kVolume)};
  for (const Signature& signature : kSignatures) {
    if (head.starts_with(signature.bytes))
      return OtherFile{std::string(signature.what), std::string(signature.use)};
  }
  if (std::count(head.begin(), head.end(), '\0') > 0) {
    return OtherFile{"a binary file", std::string(kNothing)};
  }
  return text_file(head);
}

}  // namespace footwall::formats
