#include "engine/tasks/edit_script.h"

#include <fmt/format.h>

#include <istream>
#include <set>

#include "storage/base/error.h"
#include "storage/base/text.h"

namespace footwall::tasks {
namespace {

using nlohmann::json;
using project::Interpretation;
using project::Project;
using survey::WorldPoint;

constexpr std::size_t kLongestLine = std::size_t{16} << 20;

// The fields of one object; remembers which were asked for, so that a misspelt one does not pass unnoticed.
class Fields {
 public:
  explicit Fields(const json& object) : object_(object) {
    if (!object.is_object()) throw Error(ErrorCode::kInvalid, "expected a JSON object");
  }
  bool has(const std::string& key) const { return object_.contains(key); }
  const json& get(const std::string& key) {
    const auto found = object_.find(key);
    if (found == object_.end())
      throw Error(ErrorCode::kInvalid, fmt::format("the field \"{}\" is missing", key));
    used_.insert(key);
    return *found;
  }
  double number(const std::string& key) {
    const json& value = get(key);
    if (!value.is_number()) throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" must be a number", key));
    return value.get<double>();
  }
  double number(const std::string& key, double otherwise) { return has(key) ? number(key) : otherwise; }
  std::int64_t integer(const std::string& key) {
    const json& value = get(key);
    if (!value.is_number_integer())
      throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" must be an integer", key));
    return value.get<std::int64_t>();
  }
  std::string text(const std::string& key) {
    const json& value = get(key);
    if (!value.is_string()) throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" must be text", key));
    return value.get<std::string>();
  }
  // "pillar":3, or "id":3.
  std::int64_t id(const std::string& what) { return integer(has(what) ? what : "id"); }
  void refuse_unused() const {
    for (const auto& [key, value] : object_.items()) {
      if (!used_.contains(key))
        throw Error(ErrorCode::kInvalid, fmt::format("the field \"{}\" is not known here", key));
    }
  }

 private:
  const json& object_;
  std::set<std::string> used_;
};

WorldPoint from_array(const json& values) {
  const bool good =
      values.size() == 3 && values[0].is_number() && values[1].is_number() && values[2].is_number();
  if (!good) throw Error(ErrorCode::kInvalid, "a position as an array is three numbers, [x, y, z]");
  return {values[0].get<double>(), values[1].get<double>(), values[2].get<double>()};
}

WorldPoint position(const Project& project, Fields& fields) {
  if (fields.has("position")) return from_array(fields.get("position"));
  const double z = fields.number("z");
  if (!fields.has("inline") && !fields.has("crossline")) return {fields.number("x"), fields.number("y"), z};
  const auto survey = project.survey();
  if (!survey) {
    throw Error(ErrorCode::kInvalid, "the project has no survey, so line numbers have no place",
                "give x and y");
  }
  const double i = (fields.number("inline") - survey->inlines.first) / survey->inlines.step;
  const double j = (fields.number("crossline") - survey->crosslines.first) / survey->crosslines.step;
  WorldPoint point = survey->world_of({i, j, 0});
  point.z = z;
  return point;
}

std::vector<WorldPoint> positions(const Project& project, const json& nodes) {
  if (!nodes.is_array()) throw Error(ErrorCode::kInvalid, "\"nodes\" must be an array of positions");
  std::vector<WorldPoint> points;
  for (const json& node : nodes) {
    if (node.is_array()) {
      points.push_back(from_array(node));
      continue;
    }
    Fields fields(node);
    points.push_back(position(project, fields));
    fields.refuse_unused();
  }
  return points;
}

std::int64_t fault_of(const Interpretation& picks, Fields& fields) {
  const char* key = fields.has("fault") ? "fault" : fields.has("id") ? "id" : "name";
  const json& value = fields.get(key);
  if (value.is_string()) return picks.fault_id(value.get<std::string>());
  return picks.fault(fields.integer(key)).id;
}

WorldPoint shift(Fields& fields) {
  return {fields.number("dx", 0), fields.number("dy", 0), fields.number("dz", 0)};
}

// "add", "fault" from op and what, or from the short form in op alone.
std::pair<std::string, std::string> verb_and_noun(Fields& fields) {
  std::string op = fields.text("op");
  const std::size_t gap = op.find_first_of(" _");
  if (gap == std::string::npos) return {op, fields.text("what")};
  std::string noun = op.substr(gap + 1);
  if (fields.has("what") && fields.text("what") != noun) {
    throw Error(ErrorCode::kInvalid, fmt::format("\"op\" speaks of a {}, \"what\" of another thing", noun));
  }
  return {op.substr(0, gap), std::move(noun)};
}

json change_fault(Interpretation& picks, const std::string& verb, Fields& fields) {
  if (verb == "add") {
    const auto fault = picks.add_fault(fields.text("name"));
    for (const char* property : {"colour", "interpreter", "status", "note"}) {
      if (fields.has(property)) picks.set_fault_property(fault, property, fields.text(property));
    }
    return {{"fault", fault}};
  }
  const auto fault = fault_of(picks, fields);
  if (verb == "rename") {
    picks.rename_fault(fault, fields.text("name"));
  } else if (verb == "set") {
    const json& value = fields.get("value");
    picks.set_fault_property(fault, fields.text("property"),
                             value.is_string() ? value.get<std::string>() : value.dump());
  } else if (verb == "move") {
    const WorldPoint by = shift(fields);
    if (picks.surface_of(fault)) {
      throw Error(ErrorCode::kInvalid, "the fault is an imported surface: it stays where its file has it",
                  "import it again with other coordinates");
    }
    for (const survey::Pillar& pillar : picks.pillars(fault)) {
      if (pillar.kind != survey::PillarKind::kInterpolated) picks.move_pillar(pillar.id, by);
    }
  } else if (verb == "delete") {
    picks.delete_fault(fault);
  } else {
    throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" cannot be done with a fault", verb),
                "there is add, rename, set, move, delete");
  }
  return {{"fault", fault}};
}

json change_pillar(const Project& project, Interpretation& picks, const std::string& verb, Fields& fields) {
  if (verb == "add") {
    const auto fault = fault_of(picks, fields);
    const auto pillar =
        picks.add_pillar(fault, survey::PillarKind::kInterpreted, positions(project, fields.get("nodes")));
    json ids = json::array();
    for (const survey::PillarNode& node : pillar.nodes) ids.push_back(node.id);
    return {{"pillar", pillar.id}, {"nodes", std::move(ids)}};
  }
  const auto pillar = fields.id("pillar");
  if (verb == "move") {
    picks.move_pillar(pillar, shift(fields));
  } else if (verb == "accept") {
    picks.accept_pillar(pillar);
  } else if (verb == "delete") {
    picks.delete_pillar(pillar);
  } else {
    throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" cannot be done with a pillar", verb),
                "there is add, move, accept, delete");
  }
  return {{"pillar", pillar}};
}

json change_node(const Project& project, Interpretation& picks, const std::string& verb, Fields& fields) {
  if (verb == "add") {
    const auto pillar = fields.integer("pillar");
    const auto last = static_cast<std::int64_t>(picks.pillar(pillar).nodes.size());
    const auto at = fields.has("at") ? fields.integer("at") : last;
    return {{"node", picks.insert_node(pillar, at, position(project, fields))}};
  }
  const auto node = fields.id("node");
  if (verb == "move") {
    picks.move_node(node, position(project, fields));
  } else if (verb == "delete") {
    picks.delete_node(node);
  } else {
    throw Error(ErrorCode::kInvalid, fmt::format("\"{}\" cannot be done with a node", verb),
                "there is add, move, delete");
  }
  return {{"node", node}};
}

// What the log calls the step, e.g. "move node 7"; text from the line is cut, and control characters
// replaced.
std::string step_name(const std::string& verb, const std::string& noun, const json& line) {
  for (const char* key : {noun == "fault" ? "name" : noun.c_str(), noun.c_str(), "fault", "pillar", "id"}) {
    const auto found = line.find(key);
    if (found == line.end()) continue;
    if (found->is_number_integer()) return fmt::format("{} {} {}", verb, noun, found->get<std::int64_t>());
    if (!found->is_string() || found->get_ref<const std::string&>().size() > 100) continue;
    std::string named = found->get<std::string>();
    for (char& c : named) {
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    return fmt::format("{} {} '{}'", verb, noun, named);
  }
  return fmt::format("{} {}", verb, noun);
}

json applied(Project& project, std::string_view text) {
  const json line = json::parse(text, nullptr, false);
  if (line.is_discarded()) throw Error(ErrorCode::kInvalid, "this is not JSON", "one JSON object per line");
  Fields fields(line);
  const auto [verb, noun] = verb_and_noun(fields);
  if (noun != "fault" && noun != "pillar" && noun != "node") {
    throw Error(ErrorCode::kInvalid, "only a fault, a pillar or a node can be edited", "say so in \"what\"");
  }
  json reply;
  const auto change = [&, &verb = verb, &noun = noun](Interpretation& picks) {
    reply = noun == "fault"    ? change_fault(picks, verb, fields)
            : noun == "pillar" ? change_pillar(project, picks, verb, fields)
                               : change_node(project, picks, verb, fields);
    fields.refuse_unused();
  };
  // A verb from the line stands in the step's name only if one of the functions above knows it.
  const bool known = std::set<std::string>{"add", "move", "rename", "set", "accept", "delete"}.contains(verb);
  const auto result = project.edit(known ? step_name(verb, noun, line) : "edit", change);
  reply["step"] = result.step;
  if (!result.regenerated.empty()) reply["regenerated"] = result.regenerated;
  if (!result.removed.empty()) reply["removed"] = result.removed;
  return reply;
}

}  // namespace

json apply_edit_line(Project& project, std::string_view line, std::int64_t line_number) {
  try {
    return applied(project, line);
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("line {}: {}", line_number, error.message()), error.hint());
  }
}

std::int64_t apply_edit_script(Project& project, std::istream& script,
                               const std::function<void(const json&)>& reply, const JobContext& job) {
  const auto apply = [&](std::string_view line, std::int64_t number) {
    return apply_edit_line(project, line, number);
  };
  return apply_edit_script(apply, script, reply, job);
}

std::int64_t apply_edit_script(const ApplyLine& apply, std::istream& script,
                               const std::function<void(const json&)>& reply, const JobContext& job) {
  std::int64_t number = 0;
  std::int64_t done = 0;
  std::string line;
  const auto check = [&] {
    if (!job.cancelled()) return;
    throw Error(ErrorCode::kCancelled, fmt::format("cancelled after {} edits", done),
                done > 0 ? "they stay; footwall undo takes them back one by one" : "nothing was changed");
  };
  while (std::getline(script, line)) {
    check();
    ++number;
    const auto content = text::trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    if (content.size() > kLongestLine) {
      throw Error(ErrorCode::kInvalid,
                  fmt::format("line {}: longer than {} MiB", number, kLongestLine >> 20));
    }
    reply(apply(content, number));
    ++done;
  }
  check();  // a signal ends the reading, too
  return done;
}

}  // namespace footwall::tasks
