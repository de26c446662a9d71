#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "storage/base/error.h"
#include "storage/base/partial_file.h"
#include "storage/base/text.h"
#include "storage/formats/detail/utf8.h"
#include "storage/formats/gocad_tsurf.h"

namespace footwall::formats::gocad_tsurf {
namespace {

constexpr std::size_t kMostWarnings = 1000;

// One "GOCAD TSurf ... END" after the other.
class Parser {
 public:
  void add_line(std::int64_t number, std::string_view line) {
    line_number_ = number;
    const auto words = text::words(line);
    if (words.empty() || words[0].starts_with('#')) return;
    if (words[0] == "GOCAD" && words.size() >= 2) return begin(words[1]);
    if (!inside_) return;
    if (words[0] == "END") return end();
    if (in_header_ || words[0].starts_with("HEADER")) return header(line);
    const std::string_view word = words[0];
    if (word == "ZPOSITIVE" && words.size() > 1) {
      z_stated_ = true;
      z_up_ = words[1] != "Depth" && words[1] != "depth" && words[1] != "DEPTH";
    } else if (word == "VRTX" || word == "PVRTX") {
      vertex(words);
    } else if (word == "ATOM" || word == "PATOM") {
      atom(words);
    } else if (word == "TRGL") {
      triangle(words);
    }
  }

  ReadResult finish() {
    if (inside_) {
      warn("the last object has no END");
      end();
    }
    if (result_.surfaces.empty()) {
      throw Error(ErrorCode::kFormat, "there is no TSurf with triangles",
                  "the file should start with 'GOCAD TSurf 1'");
    }
    return std::move(result_);
  }

 private:
  void warn(const std::string& what) {
    if (result_.report.warnings.size() < kMostWarnings) {
      result_.report.warnings.push_back(fmt::format("line {}: {}", line_number_, what));
    }
  }

  void begin(std::string_view kind) {
    if (inside_) {
      warn("a new object starts before END");
      end();
    }
    inside_ = kind == "TSurf" || kind == "TSURF" || kind == "tsurf";
    in_header_ = z_stated_ = false;
    z_up_ = true;  // GOCAD's own default
    surface_ = {};
    vertex_of_id_.clear();
    if (!inside_) warn(fmt::format("a {} object is skipped", kind));
  }

  // "HEADER {" ... "name:F1" ... "}", on one line or several, blanks anywhere.
  void header(std::string_view line) {
    const bool first = !in_header_;
    in_header_ = true;
    std::string_view content = text::trimmed(line);
    if (first) content = text::trimmed(content.substr(std::string_view("HEADER").size()));
    if (content.starts_with('{')) content = text::trimmed(content.substr(1));
    if (content.ends_with('}')) {
      in_header_ = false;
      content = text::trimmed(content.substr(0, content.size() - 1));
    }
    if (content.starts_with('*')) content.remove_prefix(1);
    if (content.starts_with("name:") || content.starts_with("name :")) {
      surface_.name = detail::as_utf8(text::trimmed(content.substr(content.find(':') + 1)));
    }
  }

  std::optional<std::int64_t> id_at(const std::vector<std::string_view>& words, std::size_t place) {
    if (place >= words.size()) return std::nullopt;
    return text::integer(words[place]);
  }

  void set_vertex(std::int64_t id, const survey::WorldPoint& position) {
    if (surface_.vertices.size() >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw Error(ErrorCode::kMemory, fmt::format("surface {} has too many vertices", surface_.name));
    }
    // A later TFACE may number its vertices anew; its triangles mean the newest.
    vertex_of_id_[id] = static_cast<std::int32_t>(surface_.vertices.size());
    surface_.vertices.push_back(position);
  }

  void vertex(const std::vector<std::string_view>& words) {
    const auto id = id_at(words, 1);
    std::optional<double> xyz[3];
    for (std::size_t n = 0; n < 3 && n + 2 < words.size(); ++n) xyz[n] = text::number(words[n + 2]);
    const bool good = id && xyz[0] && xyz[1] && xyz[2] && std::isfinite(*xyz[0]) && std::isfinite(*xyz[1]) &&
                      std::isfinite(*xyz[2]);
    if (!good) return warn("a vertex without id and three numbers is left out");
    set_vertex(*id, {*xyz[0], *xyz[1], *xyz[2]});
  }

  // A node of its own at the position of another one, told by id: parts that touch there stay parts.
  void atom(const std::vector<std::string_view>& words) {
    const auto id = id_at(words, 1);
    const auto reference = id_at(words, 2);
    if (!id || !reference) return warn("an ATOM without two ids is left out");
    const auto found = vertex_of_id_.find(*reference);
    if (found == vertex_of_id_.end())
      return warn(fmt::format("ATOM {} names vertex {}, which is not there", *id, *reference));
    const survey::WorldPoint position = surface_.vertices[static_cast<std::size_t>(found->second)];
    set_vertex(*id, position);
  }

  void triangle(const std::vector<std::string_view>& words) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t n = 0; n < 3; ++n) {
      const auto id = id_at(words, n + 1);
      const auto found = id ? vertex_of_id_.find(*id) : vertex_of_id_.end();
      if (found == vertex_of_id_.end()) {
        return warn(fmt::format("a triangle whose corner {} names no vertex is left out", n + 1));
      }
      corners[n] = found->second;
    }
    surface_.triangles.push_back(corners);
  }

  void end() {
    inside_ = false;
    if (surface_.name.empty()) surface_.name = "unnamed";
    if (surface_.triangles.empty())
      return warn(fmt::format("surface {} has no triangles and is skipped", surface_.name));
    if (!z_stated_) {
      result_.report.assumed.push_back(
          fmt::format("z of {} is elevation: it has no ZPOSITIVE", surface_.name));
    }
    if (z_up_) {
      for (survey::WorldPoint& p : surface_.vertices) p.z = -p.z;
    }
    result_.surfaces.push_back(std::move(surface_));
    surface_ = {};
  }

  ReadResult result_;
  survey::Surface surface_;
  std::unordered_map<std::int64_t, std::int32_t> vertex_of_id_;
  std::int64_t line_number_ = 0;
  bool inside_ = false;
  bool in_header_ = false;
  bool z_stated_ = false;
  bool z_up_ = true;
};

}  // namespace

ReadResult parse(std::string_view text) {
  Parser parser;
  std::int64_t number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    parser.add_line(++number, text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return parser.finish();
}

ReadResult read(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no file {}", path.string()));
  }
  try {
    return parse(read_whole_file(path, std::size_t{2} << 30));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kFormat) throw;
    throw Error(error.code(), fmt::format("{}: {}", path.string(), error.message()), error.hint());
  }
}

}  // namespace footwall::formats::gocad_tsurf
