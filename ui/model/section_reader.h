// Samples of sections, read on a thread of their own: the window never waits for a disk.
#pragma once
#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "ui/model/document.h"
#include "ui/model/section.h"

namespace footwall::ui {

// One section of one volume: [row][column], v and u of section.h, NaN where null or outside the volume. A
// line's columns are the nearest traces at whole u.
struct SectionSamples {
  Id volume = 0;
  Section section;
  int columns = 0;
  int rows = 0;
  std::vector<float> values;
  float at(int column, int row) const { return values[static_cast<std::size_t>(row) * columns + column]; }
};

class SectionReader final : public QObject {
  Q_OBJECT

 public:
  explicit SectionReader(Document& document, QObject* parent = nullptr);
  // Waits for the read under way.
  ~SectionReader() override;

  // At most one request of each asker waits: a newer one takes its place. Sections read lately answer from
  // memory (at once, before this returns); neighbours in the direction of the last step are read ahead while
  // nothing waits.
  void ask(QObject* asker, Id volume, const Section& section);
  // From memory, or null.
  std::shared_ptr<const SectionSamples> kept(Id volume, const Section& section) const;
  // Clip values by percentile are the volume's own: percentile 0 to 100, nearest; |value| where
  // signed_values.
  struct VolumeFacts {
    bool signed_values = true;
    std::vector<double> percentiles;  // 101
    double max_abs = 0;
  };
  // Null until the volume has been opened.
  const VolumeFacts* facts(Id volume) const;

 Q_SIGNALS:
  void ready(QObject* asker, std::shared_ptr<const footwall::ui::SectionSamples> samples);
  // One line of what happened, one of how to mend it.
  void failed(QObject* asker, const QString& message, const QString& hint);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace footwall::ui
