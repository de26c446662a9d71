#include "ui/dialogs/fault_box.h"

namespace footwall::ui {

QComboBox* fault_box(const Workbench& workbench, bool with_all, bool at_active, QWidget* parent) {
  auto* box = new QComboBox(parent);
  box->setObjectName(QStringLiteral("fault"));
  if (with_all) box->addItem(QObject::tr("all faults"));
  for (const Fault& fault : workbench.document.faults()) {
    const QString name = QString::fromStdString(fault.record.name);
    box->addItem(name, name);
    if (at_active && fault.record.id == workbench.selection.active_fault())
      box->setCurrentIndex(box->count() - 1);
  }
  return box;
}

}  // namespace footwall::ui
