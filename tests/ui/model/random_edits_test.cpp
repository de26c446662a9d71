// Many random gestures, all taken back, all done again: the interpretation's tables are byte for byte what
// they were, and what the editor keeps in memory is at any time what is on disk. Prints what an edit costs
// early and late.
#include <fmt/format.h>

#include <QElapsedTimer>
#include <QTest>
#include <algorithm>
#include <ctime>

#include "rounds.h"
#include "ui/crowded_project.h"
#include "ui/interpretation_text.h"
#include "ui/model/history_list.h"
#include "ui/model/project_tree.h"
#include "ui/random_hand.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

constexpr int kEdits = 200;
constexpr int kProbes = 40;

double processor_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

bool same(const survey::Pillar& a, const survey::Pillar& b) {
  const auto same_node = [](const survey::PillarNode& m, const survey::PillarNode& n) {
    return m.id == n.id && m.position == n.position;
  };
  return a.id == b.id && a.kind == b.kind && a.parent_a == b.parent_a && a.parent_b == b.parent_b &&
         a.parameter == b.parameter && std::ranges::equal(a.nodes, b.nodes, same_node);
}

// The first thing in which what the editor keeps differs from the project; empty where nothing does.
std::string difference(const Document& document, const HistoryList& list) {
  const auto stored = document.project().faults();
  if (stored.size() != document.faults().size()) return "number of faults";
  for (std::size_t f = 0; f < stored.size(); ++f) {
    const Fault& fault = document.faults()[f];
    if (fault.record.id != stored[f].id || fault.record.revision != stored[f].revision ||
        fault.record.name != stored[f].name || fault.record.locked != stored[f].locked)
      return "fault " + stored[f].name;
    if (!std::ranges::equal(fault.pillars, document.project().pillars(stored[f].id), same))
      return "pillars of " + stored[f].name;
    for (const survey::Pillar& pillar : fault.pillars) {
      if (document.fault_of_pillar(pillar.id) != &fault) return fmt::format("fault of pillar {}", pillar.id);
      for (const survey::PillarNode& node : pillar.nodes) {
        if (document.fault_of_node(node.id) != &fault) return fmt::format("fault of node {}", node.id);
      }
    }
  }
  const auto same_step = [](const project::HistoryStep& a, const project::HistoryStep& b) {
    return a.id == b.id && a.name == b.name && a.when == b.when && a.undone == b.undone;
  };
  const auto history = document.project().history();
  if (!std::ranges::equal(history, document.history(), same_step)) return "history";
  if (list.rowCount() != static_cast<int>(history.size()) + 1) return "length of the history's list";
  for (std::size_t n = 0; n < history.size(); ++n) {
    const QModelIndex row = list.index(static_cast<int>(n) + 1);
    if (row.data(HistoryList::kStep).toLongLong() != history[n].id ||
        row.data(HistoryList::kUndone).toBool() != history[n].undone)
      return fmt::format("row {} of the history's list", n + 1);
  }
  return {};
}

}  // namespace

class RandomEditsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void undone_are_the_start_and_redone_the_end();
};

void RandomEditsTest::undone_are_the_start_and_redone_the_end() {
  const unsigned seed = qEnvironmentVariableIntValue("FOOTWALL_TEST_SEED") + 8U;
  const int edits = rounds(kEdits);
  const bool many = edits > kEdits;
  const SampleProject sample;
  {
    project::Project project = sample.open();
    interpolate_samples(project, 6);
    add_sheets(project, many ? 200 : 10, many ? 20 : 5, many ? 20 : 5);
  }
  Document document(sample.open());
  Selection selection(document);
  Display display(document);
  Picking picking(document, selection, display);
  const HistoryList list(document);
  const ProjectTree tree(document, display);
  RandomHand hand(document, selection, picking, seed);
  const auto last_step = [&] { return document.history().back().id; };
  const auto about = [&](int step, const std::string& what) {
    return QByteArray::fromStdString(fmt::format("{} (seed {}, edit {})", what, seed, step));
  };
  // Median time of the clock and of this thread's processor, which others on the machine do not lengthen.
  const auto probe = [&] {
    std::vector<double> clock_ms, processor_ms;
    for (int n = 0; n < kProbes; ++n) {
      QElapsedTimer timer;
      timer.start();
      const double before = processor_time_ms();
      if (!hand.move_a_node()) continue;
      clock_ms.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
      processor_ms.push_back(processor_time_ms() - before);
    }
    std::ranges::sort(clock_ms);
    std::ranges::sort(processor_ms);
    return fmt::format("{:.2f} ms ({:.2f} of the processor)", clock_ms[clock_ms.size() / 2],
                       processor_ms[processor_ms.size() / 2]);
  };

  const std::string start = interpretation_text(sample.path());
  const std::size_t before = document.history().size();
  std::string early;
  std::set<QString> kinds;
  int done = 0;
  for (Id last = last_step(); done < edits;) {
    const QString what = hand.act();
    if (last_step() > last) {
      ++done;
      last = last_step();
      kinds.insert(what);
      if (done == 100) early = probe();
    }
    if (done % (edits / 20) == 0) {
      const std::string differs = difference(document, list);
      QVERIFY2(differs.empty(), about(done, differs + " after " + what.toStdString()));
    }
  }
  const std::string late = probe();
  qInfo("a node moved: %s at edit 100, %s at edit %d, of %zu kinds", early.c_str(), late.c_str(), edits,
        kinds.size());
  QVERIFY2(kinds.size() >= 15, about(done, "too few kinds of gestures came to something"));

  // 1. Back to the start, forth to the end.
  while (document.can_redo()) QVERIFY2(document.redo(), about(done, "redo"));
  const std::string end = interpretation_text(sample.path());
  QVERIFY(end != start);
  const std::size_t steps = document.history().size() - before;
  QElapsedTimer timer;
  timer.start();
  for (std::size_t n = steps; n > 0; --n) QVERIFY2(document.undo(), about(static_cast<int>(n), "undo"));
  const double undo_ms = static_cast<double>(timer.elapsed()) / static_cast<double>(steps);
  QVERIFY2(interpretation_text(sample.path()) == start, about(0, "the start is another one"));
  QVERIFY2(difference(document, list).empty(), about(0, difference(document, list)));
  timer.start();
  for (std::size_t n = 0; n < steps; ++n) QVERIFY2(document.redo(), about(static_cast<int>(n), "redo"));
  qInfo("%zu steps: undo %.2f ms, redo %.2f ms each", steps, undo_ms,
        static_cast<double>(timer.elapsed()) / static_cast<double>(steps));
  QVERIFY2(interpretation_text(sample.path()) == end, about(done, "the end is another one"));
  QVERIFY2(difference(document, list).empty(), about(done, difference(document, list)));

  // 2. The same by one click in the history.
  QVERIFY(document.go_to_step(document.history()[before - 1].id));
  QVERIFY2(interpretation_text(sample.path()) == start,
           about(0, "the start is another one, gone to at once"));
  QVERIFY(document.project().check().ok());
}

static const RegisterTest<RandomEditsTest> kRegistered;

}  // namespace footwall::ui

#include "random_edits_test.moc"
