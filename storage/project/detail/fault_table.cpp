#include "storage/project/detail/fault_table.h"

#include <fmt/format.h>
#include <cmath>

#include "storage/project/detail/names.h"

namespace footwall::project::detail {
namespace {

FaultRecord fault_from(const Query& row) {
  FaultRecord f;
  f.id = row.integer(0);
  f.name = row.text(1);
  f.colour = row.text(2);
  f.interpreter = row.text(3);
  f.status = row.text(4);
  f.note = row.text(5);
  f.modified = row.text(6);
  f.revision = row.integer(7);
  f.locked = row.integer(8) != 0;
  f.tie_tolerance = row.real(9);
  f.chart = row.blob(10);
  return f;
}

Error no_fault(std::int64_t id) {
  return {ErrorCode::kNotFound, fmt::format("there is no fault with id {}", id),
          "footwall faults lists them"};
}

}  // namespace

std::vector<FaultRecord> FaultTable::all() const {
  std::vector<FaultRecord> faults;
  Query row(
      database_,
      "SELECT id, name, colour, interpreter, status, note, modified, revision, locked, tie_tolerance, chart"
      " FROM fault ORDER BY id");
  while (row.next()) faults.push_back(fault_from(row));
  return faults;
}

FaultRecord FaultTable::find(std::int64_t fault) const {
  Query row(
      database_,
      "SELECT id, name, colour, interpreter, status, note, modified, revision, locked, tie_tolerance, chart"
      " FROM fault WHERE id = ?",
      fault);
  if (!row.next()) throw no_fault(fault);
  return fault_from(row);
}

FaultRecord FaultTable::find(const std::string& name) const {
  {
    Query row(
        database_,
        "SELECT id, name, colour, interpreter, status, note, modified, revision, locked, tie_tolerance, chart"
        " FROM fault WHERE name = ?",
        name);
    if (row.next()) return fault_from(row);
  }
  std::vector<std::string> names;
  Query row(database_, "SELECT name FROM fault ORDER BY id");
  while (row.next()) names.push_back(row.text(0));
  throw Error(ErrorCode::kNotFound, fmt::format("there is no fault '{}'", name), "there is " + listed(names));
}

std::int64_t FaultTable::revision(std::int64_t fault) const {
  Query row(database_, "SELECT revision FROM fault WHERE id = ?", fault);
  return row.next() ? row.integer(0) : 0;
}

bool FaultTable::exists(std::int64_t fault) const {
  Query row(database_, "SELECT 1 FROM fault WHERE id = ?", fault);
  return row.next();
}

void FaultTable::insert(const FaultRecord& f) {
  Query(database_,
        "INSERT INTO fault(id, name, colour, interpreter, status, note, modified, revision, locked, "
        "tie_tolerance,"
        " chart) VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        f.id, f.name, f.colour, f.interpreter, f.status, f.note, f.modified, f.revision, f.locked,
        f.tie_tolerance, f.chart)
      .run();
}

void FaultTable::update(const FaultRecord& f) {
  Query(database_,
        "UPDATE fault SET name = ?, colour = ?, interpreter = ?, status = ?, note = ?, modified = ?, "
        "revision = ?,"
        " locked = ?, tie_tolerance = ?, chart = ? WHERE id = ?",
        f.name, f.colour, f.interpreter, f.status, f.note, f.modified, f.revision, f.locked, f.tie_tolerance,
        f.chart, f.id)
      .run();
}

void FaultTable::remove(std::int64_t fault) {
  Query(database_, "DELETE FROM pillar_node WHERE pillar IN (SELECT id FROM pillar WHERE fault = ?)", fault)
      .run();
  Query(database_, "DELETE FROM pillar WHERE fault = ?", fault).run();
  Query(database_, "DELETE FROM fault WHERE id = ?", fault).run();
}

std::vector<survey::Pillar> FaultTable::read_pillars(Query& rows, Query& nodes) const {
  std::vector<survey::Pillar> pillars;
  while (rows.next()) {
    survey::Pillar p;
    p.id = rows.integer(0);
    const std::int64_t kind = rows.integer(1);
    if (kind < 0 || kind > static_cast<int>(survey::PillarKind::kSnapped)) {
      throw Error(ErrorCode::kCorrupt, fmt::format("pillar {} is of the unknown kind {}", p.id, kind));
    }
    p.kind = static_cast<survey::PillarKind>(kind);
    p.parent_a = rows.integer(2);
    p.parent_b = rows.integer(3);
    p.parameter = rows.real(4);
    pillars.push_back(std::move(p));
  }
  auto at = pillars.begin();
  while (nodes.next()) {
    const std::int64_t pillar = nodes.integer(1);
    while (at != pillars.end() && at->id < pillar) ++at;
    const survey::WorldPoint position{nodes.real(2), nodes.real(3), nodes.real(4)};
    const bool finite = std::isfinite(position.x) && std::isfinite(position.y) && std::isfinite(position.z);
    if (at == pillars.end() || at->id != pillar || !finite) {
      throw Error(ErrorCode::kCorrupt,
                  fmt::format("node {} of the project cannot be used", nodes.integer(0)));
    }
    at->nodes.push_back({nodes.integer(0), position});
  }
  return pillars;
}

std::vector<survey::Pillar> FaultTable::pillars(std::int64_t fault) const {
  Query rows(database_,
             "SELECT id, kind, parent_a, parent_b, parameter FROM pillar WHERE fault = ? ORDER BY id", fault);
  Query nodes(database_,
              "SELECT n.id, n.pillar, n.x, n.y, n.z FROM pillar p JOIN pillar_node n ON n.pillar = p.id"
              " WHERE p.fault = ? ORDER BY n.pillar, n.ordinal",
              fault);
  return read_pillars(rows, nodes);
}

survey::Pillar FaultTable::pillar(std::int64_t pillar) const {
  Query rows(database_, "SELECT id, kind, parent_a, parent_b, parameter FROM pillar WHERE id = ?", pillar);
  Query nodes(database_, "SELECT id, pillar, x, y, z FROM pillar_node WHERE pillar = ? ORDER BY ordinal",
              pillar);
  auto found = read_pillars(rows, nodes);
  if (found.empty()) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no pillar with id {}", pillar),
                "footwall faults lists them");
  }
  return std::move(found.front());
}

std::int64_t FaultTable::fault_of_pillar(std::int64_t pillar) const {
  Query row(database_, "SELECT fault FROM pillar WHERE id = ?", pillar);
  if (!row.next()) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no pillar with id {}", pillar),
                "footwall faults lists them");
  }
  return row.integer(0);
}

std::int64_t FaultTable::pillar_of_node(std::int64_t node) const {
  Query row(database_, "SELECT pillar FROM pillar_node WHERE id = ?", node);
  if (!row.next()) {
    throw Error(ErrorCode::kNotFound, fmt::format("there is no node with id {}", node),
                "footwall faults lists them");
  }
  return row.integer(0);
}

std::vector<std::int64_t> FaultTable::children(std::int64_t pillar) const {
  std::vector<std::int64_t> ids;
  Query row(database_,
            "SELECT id FROM pillar WHERE parent_a = ? AND parent_a <> 0 UNION"
            " SELECT id FROM pillar WHERE parent_b = ? AND parent_b <> 0",
            pillar, pillar);
  while (row.next()) ids.push_back(row.integer(0));
  return ids;
}

void FaultTable::insert(std::int64_t fault, const survey::Pillar& p) {
  Query(database_,
        "INSERT INTO pillar(id, fault, kind, parent_a, parent_b, parameter, former) VALUES(?, ?, ?, ?, ?, ?, "
        "x'')",
        p.id, fault, static_cast<int>(p.kind), p.parent_a, p.parent_b, p.parameter)
      .run();
  set_nodes(p.id, p.nodes);
}

void FaultTable::update(const survey::Pillar& p) {
  Query(database_, "UPDATE pillar SET kind = ?, parent_a = ?, parent_b = ?, parameter = ? WHERE id = ?",
        static_cast<int>(p.kind), p.parent_a, p.parent_b, p.parameter, p.id)
      .run();
}

void FaultTable::assign(std::int64_t pillar, std::int64_t fault) {
  Query(database_, "UPDATE pillar SET fault = ? WHERE id = ?", fault, pillar).run();
}

void FaultTable::remove_pillar(std::int64_t pillar) {
  Query(database_, "DELETE FROM pillar_node WHERE pillar = ?", pillar).run();
  Query(database_, "DELETE FROM pillar WHERE id = ?", pillar).run();
}

Bytes FaultTable::former(std::int64_t pillar) const {
  Query row(database_, "SELECT former FROM pillar WHERE id = ?", pillar);
  return row.next() ? row.blob(0) : Bytes{};
}

void FaultTable::set_former(std::int64_t pillar, const Bytes& positions) {
  Query(database_, "UPDATE pillar SET former = ? WHERE id = ?", positions, pillar).run();
}

void FaultTable::set_nodes(std::int64_t pillar, std::span<const survey::PillarNode> nodes) {
  Query(database_, "DELETE FROM pillar_node WHERE pillar = ?", pillar).run();
  Query insert(database_, "INSERT INTO pillar_node(id, pillar, ordinal, x, y, z) VALUES(?, ?, ?, ?, ?, ?)");
  std::int64_t ordinal = 0;
  for (const survey::PillarNode& node : nodes) {
    insert.run_with(node.id, pillar, ordinal++, node.position.x, node.position.y, node.position.z);
  }
}

void FaultTable::insert_node(std::int64_t pillar, std::int64_t at, const survey::PillarNode& node) {
  Query(database_, "UPDATE pillar_node SET ordinal = ordinal + 1 WHERE pillar = ? AND ordinal >= ?", pillar,
        at)
      .run();
  Query(database_, "INSERT INTO pillar_node(id, pillar, ordinal, x, y, z) VALUES(?, ?, ?, ?, ?, ?)", node.id,
        pillar, at, node.position.x, node.position.y, node.position.z)
      .run();
}

void FaultTable::move_node(const survey::PillarNode& node) {
  Query(database_, "UPDATE pillar_node SET x = ?, y = ?, z = ? WHERE id = ?", node.position.x,
        node.position.y, node.position.z, node.id)
      .run();
}

void FaultTable::remove_node(std::int64_t pillar, std::int64_t node) {
  Query(database_,
        "UPDATE pillar_node SET ordinal = ordinal - 1 WHERE pillar = ?"
        " AND ordinal > (SELECT ordinal FROM pillar_node WHERE id = ?)",
        pillar, node)
      .run();
  Query(database_, "DELETE FROM pillar_node WHERE id = ?", node).run();
}

}  // namespace footwall::project::detail
