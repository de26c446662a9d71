// Between two colours: share 0 is a, 1 is b.
#pragma once
#include <QColor>

namespace footwall::ui {

inline QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto channel = [share](float from, float to) {
    return static_cast<float>(from + (to - from) * share);
  };
  return QColor::fromRgbF(channel(a.redF(), b.redF()), channel(a.greenF(), b.greenF()),
                          channel(a.blueF(), b.blueF()));
}

}  // namespace footwall::ui
