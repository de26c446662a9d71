#include "ui/dialogs/export_dialog.h"

#include <QFile>
#include <QSignalSpy>
#include <QTest>
#include <set>

#include "ui/dialogs/look.h"
#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

using Kind = ExportChoice::Kind;

class ExportDialogTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { put_on_dark(); }
  void the_suffix_follows_the_kind();
  void writes_sticks_of_one_fault();
  void says_why_faces_cannot_be_written();
  void a_picture_is_left_to_its_view();
  void writes_volumes_as_a_job();
};

namespace {

QByteArray content(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

void ExportDialogTest::the_suffix_follows_the_kind() {
  ExportChoice choice;
  choice.kind = Kind::kTsurf;
  QCOMPARE(with_suffix(QStringLiteral("a.b.csv"), choice), QStringLiteral("a.b.ts"));
  QCOMPARE(with_suffix(QStringLiteral("a.b"), choice), QStringLiteral("a.b.ts"));
  choice.kind = Kind::kPicture;
  QCOMPARE(with_suffix(QStringLiteral("x.VTP"), choice), QStringLiteral("x.png"));
}

void ExportDialogTest::writes_sticks_of_one_fault() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  ExportDialog dialog(workbench, {});
  dialog.choose(Kind::kSticks);
  dialog.findChild<QComboBox*>(QStringLiteral("fault"))->setCurrentIndex(1);
  const QString file = dialog.choice().file;
  QVERIFY(file.endsWith(QLatin1String("sample.dat")));
  QSignalSpy exported(&dialog, &ExportDialog::exported);
  dialog.export_chosen();
  QVERIFY2(exported.wait(60'000), qPrintable(dialog.message()));
  const Fault& fault = workbench.document.faults()[0];
  QVERIFY2(dialog.message().startsWith(QStringLiteral("%1 pillars of 1 fault,").arg(fault.pillars.size())),
           qPrintable(dialog.message()));
  QVERIFY(content(file).contains(fault.record.name.c_str()));
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  keep_picture(dialog, QStringLiteral("export"));
}

void ExportDialogTest::says_why_faces_cannot_be_written() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  // A fault without pillars: those of the sample get their faces in a moment, or have them by now.
  std::set<Id> faults;
  for (const Fault& fault : workbench.document.faults()) faults.insert(fault.record.id);
  QVERIFY(delete_items(workbench.document, faults, {}, {}));
  QVERIFY(new_fault(workbench.document) != 0);
  ExportDialog dialog(workbench, {});
  QVERIFY(!QFile::exists(dialog.choice().file));
  dialog.findChild<QLineEdit*>(QStringLiteral("file"))->setText(QStringLiteral("/nowhere/at/all.csv"));
  QSignalSpy exported(&dialog, &ExportDialog::exported);
  dialog.export_chosen();
  QTRY_COMPARE_WITH_TIMEOUT(dialog.findChild<QPushButton*>(QStringLiteral("export"))->isEnabled(), true,
                            60'000);
  QVERIFY2(dialog.message().contains(QLatin1String("no faces")), qPrintable(dialog.message()));
  QCOMPARE(exported.size(), 0);
}

void ExportDialogTest::a_picture_is_left_to_its_view() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  QString written;
  ExportDialog dialog(workbench, [&](const QString& file) { written = file; });
  dialog.choose(Kind::kPicture);
  dialog.export_chosen();
  QTRY_COMPARE_WITH_TIMEOUT(dialog.message(), QStringLiteral("picture written"), 60'000);
  QVERIFY(written.endsWith(QLatin1String("sample.png")));

  ExportDialog failing(workbench,
                       [](const QString&) { throw Error(ErrorCode::kIo, "the disk is full", ""); });
  failing.choose(Kind::kPicture);
  failing.export_chosen();
  QCOMPARE(failing.message(), QStringLiteral("the disk is full"));
  ExportDialog without(workbench, {});
  QCOMPARE(without.findChild<QComboBox*>(QStringLiteral("kind"))->findData(static_cast<int>(Kind::kPicture)),
           -1);
}

void ExportDialogTest::writes_volumes_as_a_job() {
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  ExportDialog dialog(workbench, {});
  const project::VolumeRecord volume = workbench.document.volumes()[0];
  const std::map<Kind, QByteArray> heads{{Kind::kSegy, QByteArray()},
                                         {Kind::kVti, QByteArray("<?xml")},
                                         {Kind::kNrrd, QByteArray("NRRD")},
                                         {Kind::kRaw, QByteArray()}};
  for (const auto& [kind, head] : heads) {
    dialog.choose(kind);
    QVERIFY(dialog.findChild<QComboBox*>(QStringLiteral("volume"))->isEnabled());
    QVERIFY(!dialog.findChild<QComboBox*>(QStringLiteral("fault"))->isEnabled());
    const QString file = dialog.choice().file;
    QSignalSpy exported(&dialog, &ExportDialog::exported);
    dialog.export_chosen();
    QVERIFY2(exported.wait(60'000), qPrintable(dialog.message()));
    const QByteArray written = content(file);
    const qint64 samples = volume.dims[0] * volume.dims[1] * volume.dims[2] * 4;
    QVERIFY2(written.size() >= samples, qPrintable(file));
    if (kind == Kind::kRaw) QCOMPARE(written.size(), samples);
    QVERIFY2(written.startsWith(head), qPrintable(file));
    QVERIFY2(dialog.message().startsWith(QString::fromStdString(volume.name)), qPrintable(dialog.message()));
  }
}

static const RegisterTest<ExportDialogTest> registered;

}  // namespace footwall::ui

#include "export_dialog_test.moc"
