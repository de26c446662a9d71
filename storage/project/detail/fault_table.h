// Rows of faults, pillars and nodes. The rules of an edit (locks, links, revisions) stand in
// interpretation.cpp.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "storage/project/detail/database.h"
#include "storage/survey/pillar.h"

namespace footwall::project::detail {

class FaultTable {
 public:
  explicit FaultTable(Database& database) : database_(database) {}

  std::vector<FaultRecord> all() const;
  FaultRecord find(std::int64_t fault) const;
  FaultRecord find(const std::string& name) const;
  bool exists(std::int64_t fault) const;
  std::int64_t revision(std::int64_t fault) const;  // 0 if there is no such fault
  void insert(const FaultRecord& fault);
  void update(const FaultRecord& fault);
  void remove(std::int64_t fault);  // with its pillars

  // By pillar id; throws kCorrupt for rows that are no pillars.
  std::vector<survey::Pillar> pillars(std::int64_t fault) const;
  survey::Pillar pillar(std::int64_t pillar) const;
  std::int64_t fault_of_pillar(std::int64_t pillar) const;
  std::int64_t pillar_of_node(std::int64_t node) const;
  std::vector<std::int64_t> children(std::int64_t pillar) const;
  void insert(std::int64_t fault, const survey::Pillar& pillar);
  // Kind, parents and parameter; not the nodes.
  void update(const survey::Pillar& pillar);
  void assign(std::int64_t pillar, std::int64_t fault);
  void remove_pillar(std::int64_t pillar);
  Bytes former(std::int64_t pillar) const;
  void set_former(std::int64_t pillar, const Bytes& positions);

  // Makes the stored nodes of a pillar those given, in this order.
  void set_nodes(std::int64_t pillar, std::span<const survey::PillarNode> nodes);
  void insert_node(std::int64_t pillar, std::int64_t at, const survey::PillarNode& node);
  void move_node(const survey::PillarNode& node);
  void remove_node(std::int64_t pillar, std::int64_t node);

 private:
  std::vector<survey::Pillar> read_pillars(Query& pillars, Query& nodes) const;
  Database& database_;
};

}  // namespace footwall::project::detail
