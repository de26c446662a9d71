#include "ui/panels/selection_summary.h"

#include <QCoreApplication>
#include <map>

namespace footwall::ui {
namespace {

constexpr std::size_t kMostFaults = 20;  // that are listed

struct Counts {
  bool is_whole = false;  // the fault itself is selected
  std::size_t pillars = 0, nodes = 0;
};

QString tr(const char* text) {
  return QCoreApplication::translate("Properties", text);
}

// "12 pillars, 3 nodes"
QString counted(std::size_t faults, std::size_t pillars, std::size_t nodes) {
  QStringList parts;
  const auto add = [&parts](std::size_t count, const QString& one, const QString& several) {
    if (count > 0) parts.append(count == 1 ? one : several.arg(count));
  };
  add(faults, tr("1 fault"), tr("%1 faults"));
  add(pillars, tr("1 pillar"), tr("%1 pillars"));
  add(nodes, tr("1 node"), tr("%1 nodes"));
  return parts.join(QStringLiteral(", "));
}

std::map<Id, Counts> count_by_fault(const Selection& selection, const Document& document) {
  std::map<Id, Counts> by_fault;
  for (const Id id : selection.faults()) by_fault[id].is_whole = true;
  for (const Id id : selection.pillars()) {
    if (const Fault* fault = document.fault_of_pillar(id)) ++by_fault[fault->record.id].pillars;
  }
  for (const Id id : selection.nodes()) {
    if (const Fault* fault = document.fault_of_node(id)) ++by_fault[fault->record.id].nodes;
  }
  return by_fault;
}

}  // namespace

Properties selected_properties(const Workbench& bench) {
  const Selection& selection = bench.selection;
  if (selection.faults().size() + selection.pillars().size() + selection.nodes().size() < 2)
    return properties_of(selection.current(), bench);
  const std::map<Id, Counts> by_fault = count_by_fault(selection, bench.document);
  Properties found;
  found.title = counted(selection.faults().size(), selection.pillars().size(), selection.nodes().size());
  for (const auto& [id, counts] : by_fault) {
    const Fault* fault = bench.document.fault(id);
    if (fault == nullptr) continue;
    const QString name = QString::fromStdString(fault->record.name);
    if (by_fault.size() == 1) {
      found.title = tr("%1 of %2").arg(found.title, name);
      found.rows.emplace_back(tr("of"), counted(0, fault->pillars.size(), 0));
    } else if (found.rows.size() < kMostFaults) {
      found.rows.emplace_back(name, counts.is_whole
                                        ? tr("all of %1").arg(counted(0, fault->pillars.size(), 0))
                                        : counted(0, counts.pillars, counts.nodes));
    }
  }
  if (by_fault.size() > 1 && selection.faults().empty())
    found.title = tr("%1 of %2 faults").arg(found.title).arg(by_fault.size());
  if (by_fault.size() > kMostFaults)
    found.rows.emplace_back(tr("and %1 more faults").arg(by_fault.size() - kMostFaults), QString());
  return found;
}

}  // namespace footwall::ui
