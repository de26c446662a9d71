// Each *.jsonl beside this file, played in a window on a project without faults, gives the interpretation of
// the *.txt of the same name. To make or change one:
//   FOOTWALL_RECORD_SESSION=FILE.jsonl    opens that window on the screen and writes down what you do until
//   it is closed FOOTWALL_WRITE_SESSIONS=1             writes each *.txt anew from what its session gives;
//   read it before you keep it
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QTest>

#include "ui/sample_project.h"
#include "ui/sessions/session.h"
#include "ui/test_class.h"
#include "ui/window/main_window.h"

namespace footwall::ui {
namespace {

// A window of one size, on the sample's survey and volume without its faults.
struct Desk {
  Desk() {
    {
      project::Project project = sample.open();
      project.edit("a project without faults", [](project::Interpretation& now) {
        for (const auto& fault : now.faults()) now.delete_fault(fault.id);
      });
    }
    window.resize(1500, 950);
    window.show();
    opened = window.open_project(QString::fromStdString(sample.path().string())) &&
             QTest::qWaitForWindowExposed(&window) &&
             QTest::qWaitFor([this] { return window.is_settled(); }, 30000);
  }
  SampleProject sample;
  MainWindow window{EngineLink::Options{}};
  bool opened = false;
};

QString text_of(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

}  // namespace

class SessionsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase();
  void gives_the_same_interpretation_data();
  void gives_the_same_interpretation();
  void a_recording_of_a_session_is_the_session_data() { gives_the_same_interpretation_data(); }
  void a_recording_of_a_session_is_the_session();
  void a_wrong_line_is_named();
};

void SessionsTest::initTestCase() {
  const QString path = qEnvironmentVariable("FOOTWALL_RECORD_SESSION");
  if (path.isEmpty()) return;
  Desk desk;
  QVERIFY(desk.opened);
  const SessionRecorder recorder(desk.window);
  while (desk.window.isVisible()) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
  write_session(path, recorder.lines());
  QSKIP("recorded");
}

void SessionsTest::gives_the_same_interpretation_data() {
  QTest::addColumn<QString>("path");
  const QDir folder(QStringLiteral(FOOTWALL_SESSIONS));
  const QStringList names = folder.entryList({QStringLiteral("*.jsonl")});
  QVERIFY(!names.isEmpty());
  for (const QString& name : names) QTest::newRow(qPrintable(name)) << folder.filePath(name);
}

void SessionsTest::gives_the_same_interpretation() {
  QFETCH(const QString, path);
  Desk desk;
  QVERIFY(desk.opened);
  try {
    play(desk.window, read_session(path));
  } catch (const Error& error) {
    QFAIL(error.what());
  }
  const QString text = text_after(desk.window);
  const QString kept = QString(path).replace(QStringLiteral(".jsonl"), QStringLiteral(".txt"));
  if (qEnvironmentVariableIsSet("FOOTWALL_WRITE_SESSIONS")) {
    QFile file(kept);
    QVERIFY(file.open(QIODevice::WriteOnly) && file.write(text.toUtf8()) > 0);
  }
  QVERIFY2(text == text_of(kept), qPrintable(QStringLiteral("it gives\n") + text));
}

void SessionsTest::a_recording_of_a_session_is_the_session() {
  QFETCH(const QString, path);
  Desk desk;
  QVERIFY(desk.opened);
  const std::vector<QJsonObject> lines = read_session(path);
  const SessionRecorder recorder(desk.window);
  play(desk.window, lines);
  const std::vector<QJsonObject>& recorded = recorder.lines();
  QCOMPARE(recorded.size(), lines.size());
  for (std::size_t n = 0; n < lines.size(); ++n) {
    for (const char* key : {"do", "in", "id", "key", "keys", "button", "by"})
      QCOMPARE(recorded[n][QLatin1String(key)], lines[n][QLatin1String(key)]);
  }
  // Played from the recording it gives the same.
  Desk other;
  QVERIFY(other.opened);
  play(other.window, recorded);
  QCOMPARE(text_after(other.window), text_after(desk.window));
}

void SessionsTest::a_wrong_line_is_named() {
  Desk desk;
  QVERIFY(desk.opened);
  for (const QJsonObject& line : {QJsonObject{{"do", "action"}, {"id", "no.such"}},
                                  QJsonObject{{"do", "press"}, {"in", "attic"}, {"at", QJsonArray{1, 2}}},
                                  QJsonObject{{"do", "press"}, {"in", "inline"}}}) {
    QString said;
    try {
      play(desk.window, {line});
    } catch (const Error& error) {
      said = QString::fromStdString(error.message());
    }
    QVERIFY2(said.contains(line["do"].toString()), qPrintable(said));
  }
}

static const RegisterTest<SessionsTest> kRegistered;

}  // namespace footwall::ui

#include "sessions_test.moc"
