// Long work on the open project beside the window.
#include "ui/model/project_job.h"

#include <QElapsedTimer>
#include <QSignalSpy>
#include <QTest>
#include <QTimer>
#include <atomic>
#include <cmath>
#include <fstream>
#include <thread>

#include "engine/tasks/edit_at_holder.h"
#include "engine/tasks/import_sticks.h"
#include "engine/tasks/import_surface.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

// The longest time between two turns of the event loop while it lives.
class LongestBlock final : public QObject {
 public:
  LongestBlock() {
    since_.start();
    connect(&timer_, &QTimer::timeout, this, [this] {
      longest_ = std::max(longest_, since_.restart());
      ++turns_;
    });
    timer_.start(0);
  }
  qint64 ms() const { return longest_; }
  int turns() const { return turns_; }

 private:
  QTimer timer_;
  QElapsedTimer since_;
  qint64 longest_ = 0;
  int turns_ = 0;
};

class ProjectJobTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void imports_while_the_window_goes_on();
  void a_large_surface_comes_in_while_the_window_goes_on();
  void a_cancelled_import_leaves_nothing();
  void a_gesture_meanwhile_is_not_lost();
  void keeps_what_was_stored_before_a_failure();
  void takes_edits_from_the_command_line();
};

// Sticks across the survey: `sticks` of `nodes` each.
static QString sticks_file(const SampleProject& sample, const Document& document, int sticks, int nodes) {
  const std::filesystem::path path = sample.path().parent_path() / "many.dat";
  std::ofstream file(path);
  for (int s = 0; s < sticks; ++s) {
    for (int n = 0; n < nodes; ++n) {
      const double along = static_cast<double>(s) / sticks, down = static_cast<double>(n) / nodes;
      const survey::WorldPoint p =
          document.survey()->world_of({2 + 40 * along, 20 + 3 * std::sin(9 * along), 60 * down});
      file << std::fixed << p.x << ' ' << p.y << ' ' << p.z << ' ' << s + 1 << ' ' << n + 1 << '\n';
    }
  }
  return QString::fromStdString(path.string());
}

static ProjectWork importing(const QString& file) {
  return [file](project::Project& project, const JobContext& job) {
    tasks::import_sticks(project, file.toStdString(), {}, {}, job);
  };
}

void ProjectJobTest::imports_while_the_window_goes_on() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  QTRY_VERIFY_WITH_TIMEOUT(workbench.surfaces.is_settled(), 60'000);
  const QString file = sticks_file(sample, workbench.document, 1000, 100);
  const std::size_t faults = workbench.document.faults().size();
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  LongestBlock block;
  start_on_project(workbench, QStringLiteral("Import"), importing(file));
  QVERIFY(ended.wait(120'000));
  QVERIFY2(ended[0][1].value<Jobs::State>() == Jobs::State::kDone, qPrintable(ended[0][2].toString()));
  QCOMPARE(workbench.document.faults().size(), faults + 1);
  const Fault& made = workbench.document.faults().back();
  QCOMPARE(made.pillars.size(), std::size_t{1000});
  const Id node = made.pillars[7].nodes[3].id;
  QCOMPARE(workbench.document.fault_of_node(node)->record.id, made.record.id);
  qInfo("import of 100,000 nodes: the window waited for %lld ms at most, in %d turns", block.ms(),
        block.turns());
  QVERIFY(block.turns() > 20);
  QVERIFY(workbench.document.undo());
  QCOMPARE(workbench.document.faults().size(), faults);
  QVERIFY(workbench.document.fault_of_node(node) == nullptr);
}

void ProjectJobTest::a_large_surface_comes_in_while_the_window_goes_on() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  QTRY_VERIFY_WITH_TIMEOUT(workbench.surfaces.is_settled(), 60'000);
  const std::filesystem::path path = sample.path().parent_path() / "large.ts";
  {
    // Two triangles for each of the squares of a gently bent sheet.
    const int side = qEnvironmentVariableIsSet("FOOTWALL_LARGE") ? 708 : 160;
    std::ofstream file(path);
    file << "GOCAD TSurf 1\nHEADER {\nname:large\n}\nGOCAD_ORIGINAL_COORDINATE_SYSTEM\nNAME "
            "Default\nAXIS_NAME \"X\" "
            "\"Y\" \"Z\"\nAXIS_UNIT \"m\" \"m\" \"ms\"\nZPOSITIVE "
            "Depth\nEND_ORIGINAL_COORDINATE_SYSTEM\nTFACE\n";
    for (int a = 0; a < side; ++a) {
      for (int b = 0; b < side; ++b) {
        const double u = static_cast<double>(a) / side, v = static_cast<double>(b) / side;
        const survey::WorldPoint p =
            workbench.document.survey()->world_of({2 + 44 * u, 18 + 4 * std::sin(3 * u), 60 * v});
        file << "VRTX " << a * side + b + 1 << ' ' << std::fixed << p.x << ' ' << p.y << ' ' << p.z << '\n';
      }
    }
    for (int a = 0; a + 1 < side; ++a) {
      for (int b = 0; b + 1 < side; ++b) {
        const int n = a * side + b + 1;
        file << "TRGL " << n << ' ' << n + side << ' ' << n + 1 << "\nTRGL " << n + 1 << ' ' << n + side
             << ' ' << n + side + 1 << '\n';
      }
    }
    file << "END\n";
  }
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  LongestBlock block;
  start_on_project(workbench, QStringLiteral("Import"),
                   [path](project::Project& project, const JobContext& job) {
                     tasks::import_surface(project, path, {}, job);
                   });
  QVERIFY(ended.wait(300'000));
  QVERIFY2(ended[0][1].value<Jobs::State>() == Jobs::State::kDone, qPrintable(ended[0][2].toString()));
  const Id fault = workbench.document.faults().back().record.id;
  QTRY_VERIFY_WITH_TIMEOUT(workbench.surfaces.surface(fault) != nullptr, 300'000);
  const std::size_t faces = workbench.surfaces.surface(fault)->faces.size();
  QVERIFY(faces > 50'000);
  QCOMPARE(workbench.surfaces.freshness(fault, "dip"), Freshness::kFresh);
  qInfo("import of %zu triangles: the window waited for %lld ms at most, in %d turns", faces, block.ms(),
        block.turns());
  QVERIFY(block.turns() > 20);
}

void ProjectJobTest::a_cancelled_import_leaves_nothing() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  const QString file = sticks_file(sample, workbench.document, 1000, 50);
  const std::size_t faults = workbench.document.faults().size(), steps = workbench.document.history().size();
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  const int job = start_on_project(workbench, QStringLiteral("Import"), importing(file));
  workbench.jobs.cancel(job);
  QVERIFY(ended.wait(60'000));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kCancelled);
  QCOMPARE(workbench.document.faults().size(), faults);
  QCOMPARE(workbench.document.history().size(), steps);
}

void ProjectJobTest::a_gesture_meanwhile_is_not_lost() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  Document& document = workbench.document;
  const survey::Pillar pillar = document.faults().front().pillars.front();
  auto inside = std::make_shared<std::atomic<bool>>(false);
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  QSignalSpy failed(&document, &Document::failed);
  start_on_project(workbench, QStringLiteral("Slow"), [inside](project::Project& project, const JobContext&) {
    project.edit("slow", [&](project::Interpretation& now) {
      now.add_fault("slowly");
      *inside = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(200));  // the transaction is open meanwhile
    });
  });
  QTRY_VERIFY(inside->load());
  QVERIFY(document.edit(QStringLiteral("Move"), [&](project::Interpretation& now) {
    now.move_pillar(pillar.id, {5, 0, 0});
  }));
  QTRY_COMPARE(ended.size(), 1);
  QCOMPARE(failed.size(), 0);
  QCOMPARE(document.pillar(pillar.id)->nodes[0].position.x, pillar.nodes[0].position.x + 5);
  QVERIFY(std::ranges::any_of(document.faults(),
                              [](const Fault& fault) { return fault.record.name == "slowly"; }));
  QCOMPARE(document.history().back().name, std::string("Move"));
}

void ProjectJobTest::keeps_what_was_stored_before_a_failure() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  start_on_project(workbench, QStringLiteral("Half"), [](project::Project& project, const JobContext&) {
    project.edit("first", [](project::Interpretation& now) { now.add_fault("first"); });
    throw Error(ErrorCode::kInvalid, "the second cannot be");
  });
  QVERIFY(ended.wait(60'000));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kFailed);
  QCOMPARE(ended[0][2].toString(), QStringLiteral("the second cannot be"));
  QCOMPARE(workbench.document.faults().back().record.name, std::string("first"));
}

void ProjectJobTest::takes_edits_from_the_command_line() {
  const SampleProject sample;
  QString held;
  const auto workbench = open_workbench(sample.path(), {}, &held);
  QVERIFY(workbench->edits != nullptr);
  const std::string socket = project::edit_socket_of(sample.path());
  QCOMPARE(socket, workbench->edits->path());
  const auto folder = std::filesystem::status(std::filesystem::path(socket).parent_path()).permissions();
  QVERIFY((folder & (std::filesystem::perms::group_all | std::filesystem::perms::others_all)) ==
          std::filesystem::perms::none);
  Document& document = workbench->document;
  const std::size_t steps = document.history().size();
  QSignalSpy facts(&document, &Document::faults_changed);
  struct Said {
    nlohmann::json fault, failure;
    std::atomic<bool> over = false;
  } said;
  std::thread client([&] {
    try {
      tasks::EditAtHolder holder(socket);
      said.fault = holder.apply(R"({"op":"add","what":"fault","name":"from afar"})", 1);
      holder.apply(R"({"op":"rename","what":"fault","fault":"nobody","name":"x"})", 4);
    } catch (const Error& error) {
      said.failure = tasks::edit_failure(error);
    }
    said.over = true;
  });
  QTRY_VERIFY(said.over.load());
  client.join();
  QVERIFY(said.fault.contains("fault"));
  QCOMPARE(said.failure["error"]["code"].get<std::string>(), std::string("not_found"));
  QVERIFY(said.failure["error"]["message"].get<std::string>().starts_with("line 4: "));
  QCOMPARE(document.history().size(), steps + 1);
  QCOMPARE(document.faults().back().record.name, std::string("from afar"));
  QCOMPARE(facts.size(), 1);
  QVERIFY(document.undo());
  QVERIFY(std::ranges::none_of(document.faults(),
                               [](const Fault& fault) { return fault.record.name == "from afar"; }));
}

static const RegisterTest<ProjectJobTest> registered;

}  // namespace footwall::ui

#include "project_job_test.moc"
