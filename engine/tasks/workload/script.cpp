#include "engine/tasks/workload/script.h"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <iterator>
#include <ostream>
#include <type_traits>

#include "storage/base/error.h"

namespace footwall::tasks {
namespace {

using mesh::LatticePoint;
using mesh::Operation;

constexpr std::string_view kMagic = "footwall-workload 1";
constexpr std::int64_t kLongestAxis = std::int64_t{1} << 22;

// The words of one line.
class Words {
 public:
  Words(std::string_view line, std::int64_t number) : rest_(line), number_(number) {}

  std::string_view word() {
    const std::size_t from = rest_.find_first_not_of(" \t\r");
    if (from == rest_.npos) {
      rest_ = {};
      return {};
    }
    rest_.remove_prefix(from);
    const std::size_t size = std::min(rest_.find_first_of(" \t\r"), rest_.size());
    const std::string_view found = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return found;
  }
  template <typename T = std::int32_t>
  T integer(const char* what) {
    const std::string_view text = word();
    T value = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || failure != std::errc() || end != text.data() + text.size())
      fail(fmt::format("{} should be a whole number, not '{}'", what, text));
    return value;
  }
  LatticePoint point() {
    LatticePoint p;
    p.i = integer("the position along inlines");
    p.j = integer("the position along crosslines");
    p.k = integer("the position along samples");
    return p;
  }
  void end() {
    const std::string_view more = word();
    if (!more.empty()) fail(fmt::format("nothing should follow here, but '{}' does", more));
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ErrorCode::kFormat, fmt::format("line {}: {}", number_, what),
                "docs/workloads.md describes the format");
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
  std::int64_t number_;
};

mesh::CreateMesh create(Words& words) {
  const auto vertices = words.integer<std::uint32_t>("the number of vertices");
  const auto faces = words.integer<std::uint32_t>("the number of faces");
  // A number takes two characters at the least.
  if (6 * (std::size_t{vertices} + faces) > words.left() + 6) words.fail("the line holds fewer numbers");
  mesh::CreateMesh made;
  for (std::uint32_t n = 0; n < vertices; ++n) made.positions.push_back(words.point());
  for (std::uint32_t n = 0; n < faces; ++n) {
    auto& face = made.faces.emplace_back();
    for (mesh::VertexId& corner : face) corner = words.integer("a face's vertex");
  }
  return made;
}

Operation parse_operation(std::string_view verb, Words& words) {
  if (verb == "create") return create(words);
  const mesh::MeshId mesh = words.integer("the mesh");
  if (verb == "destroy") return mesh::DestroyMesh{mesh};
  if (verb == "remove") return mesh::RemoveFaces{mesh, words.integer("the vertex")};
  if (verb == "remove-face") return mesh::RemoveFace{mesh, words.integer("the face")};
  if (verb == "move") {
    const mesh::VertexId vertex = words.integer("the vertex");
    return mesh::MoveVertex{mesh, vertex, words.point()};
  }
  const mesh::EdgeId edge = words.integer("the edge");
  if (verb == "close") return mesh::AddFace{mesh, edge, words.integer("the vertex")};
  if (verb == "split") return mesh::SplitEdge{mesh, edge, words.point()};
  return mesh::AddFace{mesh, edge, words.point()};  // add
}

bool is_verb(std::string_view word) {
  static constexpr std::array<std::string_view, 8> kVerbs{"create", "destroy",     "add",  "close",
                                                          "remove", "remove-face", "move", "split"};
  return std::find(kVerbs.begin(), kVerbs.end(), word) != kVerbs.end();
}

survey::Index parse_size(Words& words) {
  survey::Index size{};
  for (std::int64_t& count : size) {
    count = words.integer<std::int64_t>("the number of voxels");
    if (count < 1 || count > kLongestAxis)
      words.fail(fmt::format("a survey cannot have {} voxels along an axis", count));
  }
  return size;
}

// Reads line after line; the state is what stands before the line.
class Parser {
 public:
  void line(std::string_view text, std::int64_t number) {
    Words words(text.substr(0, text.find('#')), number);
    const std::string_view verb = words.word();
    if (verb.empty()) return;
    if (verb == "size" && workload_.size[0] == 0) {
      workload_.size = parse_size(words);
    } else if (workload_.size[0] == 0) {
      words.fail("the first line should be 'size INLINES CROSSLINES SAMPLES'");
    } else if (verb == "repeat") {
      workload_.repeats.emplace_back();
    } else if (verb != "extract" && !is_verb(verb)) {
      words.fail(fmt::format("'{}' is no operation", verb));
    } else if (workload_.repeats.empty()) {
      words.fail("the operations should follow a line 'repeat'");
    } else if (verb == "extract") {
      open_step().extract = true;
    } else {
      open_step().operations.push_back(parse_operation(verb, words));
    }
    words.end();
  }
  Workload take(std::int64_t lines) {
    if (workload_.size[0] == 0) Words("", lines).fail("the script ends before it tells the survey's size");
    return std::move(workload_);
  }

 private:
  WorkloadStep& open_step() {
    auto& steps = workload_.repeats.back().steps;
    if (steps.empty() || steps.back().extract) steps.emplace_back();
    return steps.back();
  }
  Workload workload_;
};

using Text = fmt::memory_buffer;

void put(const LatticePoint& p, Text& text) {
  fmt::format_to(std::back_inserter(text), " {} {} {}", p.i, p.j, p.k);
}

void put(const Operation& operation, Text& text) {
  const auto out = std::back_inserter(text);
  std::visit(
      [&](const auto& o) {
        using T = std::decay_t<decltype(o)>;
        if constexpr (std::is_same_v<T, mesh::CreateMesh>) {
          fmt::format_to(out, "create {} {}", o.positions.size(), o.faces.size());
          for (const LatticePoint& p : o.positions) put(p, text);
          for (const auto& face : o.faces) fmt::format_to(out, " {} {} {}", face[0], face[1], face[2]);
        } else if constexpr (std::is_same_v<T, mesh::DestroyMesh>) {
          fmt::format_to(out, "destroy {}", o.mesh);
        } else if constexpr (std::is_same_v<T, mesh::AddFace>) {
          if (const auto* vertex = std::get_if<mesh::VertexId>(&o.apex)) {
            fmt::format_to(out, "close {} {} {}", o.mesh, o.border_edge, *vertex);
          } else {
            fmt::format_to(out, "add {} {}", o.mesh, o.border_edge);
            put(std::get<LatticePoint>(o.apex), text);
          }
        } else if constexpr (std::is_same_v<T, mesh::RemoveFaces>) {
          fmt::format_to(out, "remove {} {}", o.mesh, o.vertex);
        } else if constexpr (std::is_same_v<T, mesh::RemoveFace>) {
          fmt::format_to(out, "remove-face {} {}", o.mesh, o.face);
        } else if constexpr (std::is_same_v<T, mesh::MoveVertex>) {
          fmt::format_to(out, "move {} {}", o.mesh, o.vertex);
          put(o.to, text);
        } else {
          fmt::format_to(out, "split {} {}", o.mesh, o.edge);
          put(o.at, text);
        }
      },
      operation);
  text.push_back('\n');
}

}  // namespace

void add_counts(const WorkloadRepeat& repeat, OperationCounts& counts) {
  const auto count = [&](const Operation& operation) {
    counts.create_mesh += std::holds_alternative<mesh::CreateMesh>(operation);
    counts.destroy_mesh += std::holds_alternative<mesh::DestroyMesh>(operation);
    counts.add_face += std::holds_alternative<mesh::AddFace>(operation);
    counts.remove_faces += std::holds_alternative<mesh::RemoveFaces>(operation);
    counts.remove_face += std::holds_alternative<mesh::RemoveFace>(operation);
    counts.move_vertex += std::holds_alternative<mesh::MoveVertex>(operation);
    counts.split_edge += std::holds_alternative<mesh::SplitEdge>(operation);
  };
  for (const WorkloadStep& step : repeat.steps) {
    std::for_each(step.operations.begin(), step.operations.end(), count);
    counts.extract_all += step.extract;
  }
}

OperationCounts counts_of(const Workload& workload) {
  OperationCounts counts;
  for (const WorkloadRepeat& repeat : workload.repeats) add_counts(repeat, counts);
  return counts;
}

void write_script_head(const survey::Index& size, std::string_view title, std::ostream& out) {
  out << kMagic << '\n';
  for (std::size_t at = 0; at < title.size();) {
    const std::size_t end = std::min(title.find('\n', at), title.size());
    out << "# " << title.substr(at, end - at) << '\n';
    at = end + 1;
  }
  out << fmt::format("size {} {} {}\n", size[0], size[1], size[2]);
}

void write_script_repeat(std::ostream& out) {
  out << "repeat\n";
}

void write_script_step(const WorkloadStep& step, std::ostream& out) {
  Text text;
  for (const Operation& operation : step.operations) put(operation, text);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  if (step.extract) out << "extract\n";
}

Workload parse_script(std::string_view text) {
  Parser parser;
  std::int64_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    ++number;
    at = end + 1;
    if (number > 1) {
      parser.line(line, number);
    } else if (line != kMagic && line != std::string(kMagic) + "\r") {
      throw Error(ErrorCode::kFormat,
                  fmt::format("line 1: this is no workload: it should begin with '{}'", kMagic),
                  "footwall workload make writes one");
    }
  }
  return parser.take(number + 1);
}

}  // namespace footwall::tasks
