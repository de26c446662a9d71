#include "ui/model/unit_text.h"

namespace footwall::ui {

QString unit_text(const std::string& unit_rule) {
  QString unit = QString::fromStdString(unit_rule);
  if (unit == QStringLiteral("1")) return {};
  unit.replace(QStringLiteral("^2"), QStringLiteral("\u00b2"))
      .replace(QStringLiteral("^3"), QStringLiteral("\u00b3"));
  return unit;
}

}  // namespace footwall::ui
