// A window on a project that another process edits: it says who holds it, changes nothing, follows what is
// done there, and takes over once the other is gone.
#include <QProcess>
#include <QTest>

#include "ui/interpretation_text.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"
#include "ui/window/actions.h"
#include "ui/window/banner.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

constexpr int kPatience = 60000;

// What the window has of the interpretation, against what is stored.
bool shows_what_is_stored(const Document& document, const std::filesystem::path& path) {
  const project::Project stored = project::Project::open(path, project::OpenMode::kRead);
  const auto faults = stored.faults();
  const auto same = [](const Fault& shown, const project::FaultRecord& record) {
    return shown.record.id == record.id && shown.record.name == record.name &&
           shown.record.revision == record.revision;
  };
  return std::ranges::equal(document.faults(), faults, same) &&
         document.history().size() == stored.history().size();
}

}  // namespace

class SecondEditorTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void follows_another_process_and_takes_over();
};

void SecondEditorTest::follows_another_process_and_takes_over() {
  const SampleProject sample;
  const QString path = QString::fromStdString(sample.path().string());
  QProcess other;
  other.start(QStringLiteral(FOOTWALL_RANDOM_EDITOR), {QStringLiteral("edit"), path, QStringLiteral("8")});
  // Each line it says is one finished gesture.
  const auto hear = [&](int gestures) {
    int heard = 0;
    while (heard < gestures && other.waitForReadyRead(kPatience))
      heard += static_cast<int>(other.readAll().count('\n'));
    return heard >= gestures;
  };
  QVERIFY(hear(3));

  // 1. For reading, and it says who writes.
  MainWindow window{EngineLink::Options{}};
  window.resize(1200, 800);
  window.show();
  QVERIFY(window.open_project(path));
  const Document& document = window.workbench()->document;
  const QString banner = QStringLiteral("read-only");
  QVERIFY(document.read_only());
  QVERIFY2(window.banners().text(banner).contains(QString::number(other.processId())),
           qPrintable(window.banners().text(banner)));
  QVERIFY(!window.actions().action(QStringLiteral("fault.new"))->isEnabled());
  QVERIFY(!window.actions().action(QStringLiteral("edit.undo"))->isEnabled());

  // 2. What is done there appears here, again and again.
  for (int n = 0; n < 3; ++n) {
    const std::size_t steps = document.history().size();
    QVERIFY(hear(10));
    QTRY_VERIFY_WITH_TIMEOUT(document.history().size() != steps, kPatience);
  }

  // 3. The other is killed: the window comes to what it left, and can take over.
  other.kill();
  QVERIFY(other.waitForFinished(kPatience));
  QTRY_VERIFY_WITH_TIMEOUT(shows_what_is_stored(document, sample.path()), kPatience);
  const std::string left = interpretation_text(sample.path());
  QVERIFY(window.banners().press(banner, 0));
  QVERIFY(!window.workbench()->document.read_only());
  QVERIFY(!window.banners().has(banner));
  // The gesture that was being committed may be there now, too: an edit, or a step back or forth in the
  // history.
  Document& taken = window.workbench()->document;
  const auto is_as_left = [&] { return interpretation_text(sample.path()) == left; };
  QVERIFY(is_as_left() || (taken.undo() && is_as_left()) || (taken.redo() && taken.redo() && is_as_left()));
  QVERIFY(taken.project().check().ok());
}

static const RegisterTest<SecondEditorTest> kRegistered;

}  // namespace footwall::ui

#include "second_editor_test.moc"
