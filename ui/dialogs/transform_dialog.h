// What is selected (nodes, pillars, faults) moved, turned and scaled by numbers. The views show it as the
// numbers change; OK is one edit, Cancel puts back what was.
#pragma once
#include <QDialog>
#include <QDoubleSpinBox>

#include "ui/model/fault_commands.h"
#include "ui/model/workbench.h"

namespace footwall::ui {

class TransformDialog final : public QDialog {
  Q_OBJECT

 public:
  // Of what is selected now; the project has a survey.
  explicit TransformDialog(Workbench& workbench, QWidget* parent = nullptr);

  Transform transform() const;

 public Q_SLOTS:
  void accept() override;
  void reject() override;

 private:
  QDoubleSpinBox* field(const char* name, double low, double high, int decimals, double step,
                        const QString& unit);
  bool changes_nothing() const;
  void preview();

  Workbench& workbench_;
  const std::set<Id> faults_, pillars_, nodes_;
  QDoubleSpinBox *x_, *y_, *z_, *rotate_, *scale_, *scale_z_;
};

}  // namespace footwall::ui
