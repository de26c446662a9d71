// The numbers that views show of the faces: those known now (Surfaces), or those of a stored run
// (FaceLook::run). What a run says never mixes with what is known now, which goes on being kept up to date
// meanwhile: tours, shifts, "Update all" and the live run ask Surfaces.
#pragma once
#include <QObject>
#include <QStringList>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "ui/model/display.h"
#include "ui/model/face_values.h"
#include "ui/model/run_reader.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

// "base", or for a run without a name "live", "run 3".
QString name_of(const project::RunRecord& run);
// "run base": within a text.
QString words_for(const project::RunRecord& run);

class ShownNumbers final : public QObject {
  Q_OBJECT

 public:
  ShownNumbers(Document& document, Display& display, const Surfaces& surfaces, QObject* parent = nullptr);
  ~ShownNumbers() override;

  // Whose numbers are shown; nothing: those known now.
  const std::optional<project::RunRecord>& run() const { return run_; }
  // Some of its faults may come yet.
  bool is_reading() const { return reading_; }
  // Whether the statistic is shown as the run has it: what follows from the faces' places alone is that of
  // their places now.
  bool is_of_run(const QString& statistic) const;
  // Of a run that is_of_run(): which, of what time, and of which volume where that is another than the
  // sections'; a line each.
  QStringList origin() const;

  // As Surfaces has them. Of a run: a face that stands elsewhere now is stale and hatched, one that the run
  // does not have is NaN.
  std::shared_ptr<const FaceNumbers> numbers(Id fault, const QString& statistic) const;
  // Of a run never fresh or following: kKept, kStale where a face has moved since, kPlain where the run has
  // nothing of it.
  Freshness freshness(Id fault, const QString& statistic) const;
  std::optional<std::pair<double, double>> range(const std::set<Id>& faults, const QString& statistic) const;

 Q_SIGNALS:
  // Another run is shown, or none, or it has another name.
  void run_changed();
  // Of a run: they have been read.
  void numbers_changed(const std::set<footwall::ui::Id>& faults);

 private:
  struct Entry {
    std::shared_ptr<const FaultOfRun> run;
    std::shared_ptr<const FaultSurface> surface;  // that the values are of
    FaceValues values;
    std::map<QString, std::shared_ptr<const FaceNumbers>> numbers;
  };
  struct KeptRange {
    std::set<Id> faults;
    QString statistic;
    std::optional<std::pair<double, double>> range;
  };

  void follow_display();
  void follow_name();
  void start_reading();
  void came(std::uint64_t request, const std::shared_ptr<const FaultOfRun>& fault);
  void ended(std::uint64_t request, const std::optional<Error>& failure);
  void give_up(const Error& error);
  static void take(const std::string& statistic, Entry& entry);
  // Whether what is shown of the fault is what the run has of it.
  bool is_of_run(Id fault, const QString& statistic) const;
  // On the fault's surface now; null where the run, or the project, has none.
  Entry* placed(Id fault) const;

  Document& document_;
  Display& display_;
  const Surfaces& surfaces_;
  std::optional<project::RunRecord> run_;
  bool reading_ = false;
  std::uint64_t request_ = 0;
  std::unique_ptr<RunReader> reader_;    // from the first run that is shown
  mutable std::map<Id, Entry> entries_;  // of the run; placed when asked for
  mutable std::optional<KeptRange> kept_range_;
};

}  // namespace footwall::ui
