#include "ui/dialogs/import_segy_dialog.h"

#include <QComboBox>
#include <QDirIterator>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>

#include "storage/volume/volume_reader.h"
#include "ui/dialogs/import_jobs.h"
#include "ui/dialogs/look.h"
#include "ui/dialogs/segy_files.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

namespace segy = formats::segy;

class ImportSegyDialogTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { put_on_dark(); }
  void says_what_is_missing();
  void shows_holes_and_duplicates();
  void a_changed_byte_updates_map_and_preview();
  void the_newest_fields_win();
  void a_bad_byte_is_said_not_read();
  void the_scalar_of_coordinates_can_be_said();
  void shows_the_text_header();
  void a_click_on_the_map_chooses_the_line();
  void imports_into_the_open_project();
  void refuses_what_does_not_fit_the_survey();
  void makes_a_new_project();
  void a_cancelled_import_leaves_nothing();
  void looks_at_a_real_file();
  void looks_at_every_real_file_without_harm();
  void says_that_a_file_is_none();
};

namespace {

constexpr int kLong = 60'000;

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

void choose(QWidget& dialog, const char* name, int row) {
  dialog.findChild<QComboBox*>(QLatin1String(name))->setCurrentIndex(row);
}

bool has_look(const ImportSegyDialog& dialog) {
  return QTest::qWaitFor(
      [&] { return dialog.look() != nullptr && !dialog.message().contains(QLatin1String("being read")); },
      kLong);
}

void choose_time_in_ms(ImportSegyDialog& dialog) {
  choose(dialog, "domain", 1);
  choose(dialog, "unit", 1);
}

bool becomes_ready(const ImportSegyDialog& dialog) {
  return QTest::qWaitFor([&] { return dialog.can_import(); }, kLong);
}

}  // namespace

void ImportSegyDialogTest::says_what_is_missing() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  QVERIFY(has_look(dialog));
  QVERIFY(!dialog.can_import());
  QVERIFY2(dialog.message().contains(QLatin1String("time or depth")), qPrintable(dialog.message()));
  QVERIFY(dialog.message().contains(QLatin1String("vertical unit")));
  choose(dialog, "domain", 1);
  choose(dialog, "unit", 2);
  QVERIFY2(dialog.message().contains(QLatin1String("time is in ms")), qPrintable(dialog.message()));
  QVERIFY(!dialog.can_import());
  choose(dialog, "unit", 1);
  QVERIFY(becomes_ready(dialog));
  QCOMPARE(dialog.message(), QString());
  QCOMPARE(dialog.button_text(),
           QStringLiteral("Import 107 traces (read 51.1 kB, write 21.6 kB)")
               .replace(QLatin1String("51.1 kB"),
                        bytes_text(static_cast<std::int64_t>(std::filesystem::file_size(made.path())))));
}

void ImportSegyDialogTest::shows_holes_and_duplicates() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  const segy::TraceMap& map = dialog.look()->survey->map();
  QCOMPARE(map.rows, std::int64_t{MadeSegy::kInlines});
  QCOMPARE(map.columns, std::int64_t{MadeSegy::kCrosslines});
  for (std::int64_t i = 0; i < map.rows; ++i) {
    for (std::int64_t j = 0; j < map.columns; ++j) {
      const segy::Bin wanted = i == 3 && j == 4   ? segy::Bin::kHole
                               : i == 0 && j == 0 ? segy::Bin::kDuplicate
                                                  : segy::Bin::kLive;
      QCOMPARE(map.at(i, j), wanted);
    }
  }
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  auto* view = dialog.findChild<SegyMapView*>();
  const QImage seen = view->grab().toImage();
  const auto colour = [&](std::int64_t i, std::int64_t j) {
    return seen.pixelColor((view->position_of(i, j) * seen.devicePixelRatio()).toPoint());
  };
  QCOMPARE(colour(0, 0), SegyMapView::colour_of(segy::Bin::kDuplicate, view->palette()));
  QCOMPARE(colour(3, 4), SegyMapView::colour_of(segy::Bin::kHole, view->palette()));
  QCOMPARE(colour(9, 7), SegyMapView::colour_of(segy::Bin::kLive, view->palette()));
  keep_picture(dialog, QStringLiteral("import-made"));

  const segy::LinePreview& line = dialog.look()->line;
  QCOMPARE(line.line, 112);
  QCOMPARE(line.traces, std::int64_t{MadeSegy::kCrosslines});
  for (std::int64_t j = 0; j < line.traces; ++j) {
    for (std::int64_t k = 0; k < line.samples; ++k) {
      QCOMPARE(line.values[static_cast<std::size_t>(j * line.samples + k)], MadeSegy::sample(6, j, k));
    }
  }
}

void ImportSegyDialogTest::a_changed_byte_updates_map_and_preview() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  const auto before = dialog.look();
  dialog.findChild<QLineEdit*>(QStringLiteral("inline_byte"))->setText(QStringLiteral("193"));
  dialog.findChild<QLineEdit*>(QStringLiteral("crossline_byte"))->setText(QStringLiteral("189"));
  QVERIFY(!dialog.can_import());  // what is shown is not of these bytes
  QVERIFY(becomes_ready(dialog));
  QVERIFY(dialog.look()->survey != before->survey);
  QCOMPARE(dialog.look()->survey->map().rows, std::int64_t{MadeSegy::kCrosslines});
  QCOMPARE(dialog.look()->line.line, 304);
}

void ImportSegyDialogTest::the_newest_fields_win() {
  const MadeSegy made;
  SegyLooker looker(made.path());
  QSignalSpy looked(&looker, &SegyLooker::looked);
  segy::Options turned;
  turned.inline_byte = 193;
  turned.crossline_byte = 189;
  std::uint64_t newest = 0;
  for (int n = 0; n < 20; ++n) newest = looker.look(n % 2 == 0 ? segy::Options() : turned);
  std::shared_ptr<const SegyLook> last;
  QVERIFY(QTest::qWaitFor(
      [&] {
        if (!looked.empty()) last = looked.back()[0].value<std::shared_ptr<const SegyLook>>();
        return last && last->request == newest;
      },
      kLong));
  QCOMPARE(last->survey->map().rows, std::int64_t{MadeSegy::kCrosslines});
  QVERIFY(looked.size() < 20);
}

void ImportSegyDialogTest::a_bad_byte_is_said_not_read() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  auto* field = dialog.findChild<QLineEdit*>(QStringLiteral("inline_byte"));
  field->setText(QStringLiteral("banana"));
  QVERIFY2(dialog.message().contains(QLatin1String("banana")), qPrintable(dialog.message()));
  QVERIFY(!dialog.can_import());
  field->setText(QStringLiteral("300"));
  QSignalSpy looked(&dialog, &ImportSegyDialog::looked);
  QVERIFY(looked.wait(kLong));
  QVERIFY(!dialog.can_import());
  QVERIFY2(dialog.message().contains(QLatin1String("300")), qPrintable(dialog.message()));
  field->clear();
  QVERIFY(becomes_ready(dialog));
}

void ImportSegyDialogTest::the_scalar_of_coordinates_can_be_said() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  const auto spacing = [&] { return dialog.look()->survey->found().geometry->map.per_inline_y; };
  const double before = spacing();
  const int scalar = dialog.look()->survey->found().report.coordinate_scalar;
  auto* field = dialog.findChild<QLineEdit*>(QStringLiteral("scalar"));
  field->setText(QStringLiteral("ten"));
  QTRY_VERIFY(dialog.message().contains(QLatin1String("scalar")));
  const double factor = scalar >= 0 ? std::max(1, scalar) : -1.0 / scalar;
  field->setText(QStringLiteral("10"));
  QTRY_VERIFY(dialog.can_import() && std::abs(spacing() - before * 10 / factor) < 1e-6 * spacing());
}

void ImportSegyDialogTest::shows_the_text_header() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  QVERIFY(has_look(dialog));
  dialog.show();
  const auto* words = dialog.findChild<QPlainTextEdit*>(QStringLiteral("text_header"));
  QVERIFY(!words->isVisible());
  dialog.findChild<QPushButton*>(QStringLiteral("shows_text"))->click();
  QVERIFY(words->isVisible());
  QCOMPARE(words->toPlainText().split(u'\n').size(), 40);
  QVERIFY(words->toPlainText().startsWith(QLatin1String("C 1")) ||
          words->toPlainText().startsWith(QLatin1String("C01")));
}

void ImportSegyDialogTest::a_click_on_the_map_chooses_the_line() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  QVERIFY(has_look(dialog));
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  const auto survey = dialog.look()->survey;
  auto* view = dialog.findChild<SegyMapView*>();
  QTest::mouseClick(view, Qt::LeftButton, {}, view->position_of(3, 2).toPoint());
  QTRY_COMPARE_WITH_TIMEOUT(dialog.look()->line.line, 106, kLong);
  QVERIFY(dialog.look()->survey == survey);  // no second pass
  const segy::LinePreview& line = dialog.look()->line;
  QVERIFY(std::isnan(line.values[static_cast<std::size_t>(4 * line.samples)]));  // the hole
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("turn")), Qt::LeftButton);
  QTRY_VERIFY_WITH_TIMEOUT(!dialog.look()->line.of_inline, kLong);
  QCOMPARE(dialog.look()->line.line, 304);
}

void ImportSegyDialogTest::imports_into_the_open_project() {
  const MadeSegy made;
  const auto path = made.folder() / "empty.footwall";
  tasks::new_empty_project(path);
  Workbench workbench(project::Project::open(path, project::OpenMode::kWrite), {});
  QSignalSpy surveys(&workbench.document, &Document::survey_changed);
  QSignalSpy failures(&workbench.document, &Document::failed);
  ImportSegyDialog dialog(text(made.path()), &workbench);
  choose_time_in_ms(dialog);
  dialog.findChild<QLineEdit*>(QStringLiteral("crs"))->setText(QStringLiteral("EPSG:23031"));
  dialog.findChild<QLineEdit*>(QStringLiteral("name"))->setText(QStringLiteral("stack"));
  QVERIFY(becomes_ready(dialog));
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  dialog.import();
  QCOMPARE(dialog.result(), int{QDialog::Accepted});
  QVERIFY(ended.wait(kLong));
  QCOMPARE(ended[0][1].value<Jobs::State>(), Jobs::State::kDone);
  QCOMPARE(failures.size(), 0);
  QCOMPARE(surveys.size(), 1);
  QCOMPARE(workbench.document.survey()->crs, std::string("EPSG:23031"));
  QCOMPARE(workbench.document.volumes().size(), std::size_t{1});
  const project::VolumeRecord& volume = workbench.document.volumes()[0];
  QCOMPARE(volume.name, std::string("stack"));
  QCOMPARE(workbench.display.volume(), volume.id);
  volume::VolumeReader reader(workbench.document.project().volume_path(volume));
  QCOMPARE(reader.info().dims[0], std::int64_t{MadeSegy::kInlines});
  std::vector<float> one(1);
  reader.read({{5, 2, 7}, {6, 3, 8}}, one);
  QCOMPARE(one[0], MadeSegy::sample(5, 2, 7));

  // The same name again is refused before anything is read.
  ImportSegyDialog again(text(made.path()), &workbench);
  choose_time_in_ms(again);
  again.findChild<QLineEdit*>(QStringLiteral("name"))->setText(QStringLiteral("stack"));
  QVERIFY(has_look(again));
  QVERIFY2(again.message().contains(QLatin1String("'stack'")), qPrintable(again.message()));
}

void ImportSegyDialogTest::refuses_what_does_not_fit_the_survey() {
  const MadeSegy made;
  const SampleProject sample;
  Workbench workbench(sample.open(), {});
  ImportSegyDialog dialog(text(made.path()), &workbench);
  choose_time_in_ms(dialog);
  QVERIFY(has_look(dialog));
  QTRY_VERIFY_WITH_TIMEOUT(dialog.message().contains(QLatin1String("does not fit")), kLong);
  QVERIFY(!dialog.can_import());
}

void ImportSegyDialogTest::makes_a_new_project() {
  const MadeSegy made;
  ImportSegyDialog dialog(text(made.path()), nullptr);
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  QSignalSpy projects(&dialog, &ImportSegyDialog::project_made);
  dialog.import();
  QVERIFY(!dialog.can_import());
  QVERIFY(projects.wait(kLong));
  const QString path = projects[0][0].toString();
  QCOMPARE(path, text(made.folder() / "made.footwall"));
  const auto project = project::Project::open(path.toStdString(), project::OpenMode::kRead);
  QCOMPARE(project.volumes().size(), std::size_t{1});
}

void ImportSegyDialogTest::a_cancelled_import_leaves_nothing() {
  const MadeSegy made;
  const auto path = made.folder() / "empty.footwall";
  tasks::new_empty_project(path);
  Workbench workbench(project::Project::open(path, project::OpenMode::kWrite), {});
  const auto survey = segy::SegyFile::scan(made.path(), {}).geometry();
  QSignalSpy ended(&workbench.jobs, &Jobs::finished);
  const int job = import_segy(workbench, made.path(), {}, survey, "stack");
  QVERIFY_EXCEPTION_THROWN(import_segy(workbench, made.path(), {}, survey, ""), Error);
  workbench.jobs.cancel(job);
  QVERIFY(ended.wait(kLong));
  if (ended[0][1].value<Jobs::State>() == Jobs::State::kDone) QSKIP("the job was quicker than its cancel");
  QVERIFY(workbench.document.volumes().empty());
  workbench.jobs.clear_finished();
  QVERIFY(!std::filesystem::exists(workbench.document.project().volumes_folder()));
}

void ImportSegyDialogTest::looks_at_a_real_file() {
  const QString file = real_segy(QStringLiteral("equinor+segyio/test-data/f3.sgy"));
  if (file.isEmpty()) QSKIP("no ../shared/data: the real SEG-Y is not looked at");
  ImportSegyDialog dialog(file, nullptr);
  dialog.findChild<QLineEdit*>(QStringLiteral("project"))->setText(QStringLiteral("/nowhere/f3.footwall"));
  choose_time_in_ms(dialog);
  QVERIFY(becomes_ready(dialog));
  QCOMPARE(dialog.button_text(), QStringLiteral("Import 414 traces (read 0.2 MB, write 0.1 MB)"));
  const segy::Inspection& found = dialog.look()->survey->found();
  QVERIFY2(evidence_of(found).startsWith(QString::fromUtf8("189/193: 23 × 18 lines, 0 gaps, fit ")),
           qPrintable(evidence_of(found)));
  QVERIFY(!found.candidates.empty());
  QVERIFY2(
      evidence_of(found.candidates[0]).startsWith(QString::fromUtf8("189/193: 23 × 18 lines, 100 % filled")),
      qPrintable(evidence_of(found.candidates[0])));
  dialog.show();
  QVERIFY(QTest::qWaitForWindowExposed(&dialog));
  keep_picture(dialog, QStringLiteral("import-f3"));
}

void ImportSegyDialogTest::looks_at_every_real_file_without_harm() {
  const QString folder = real_segy(QStringLiteral("equinor+segyio"));
  if (folder.isEmpty()) QSKIP("no ../shared/data: the real SEG-Y is not looked at");
  int looked = 0, importable = 0;
  QDirIterator files(folder, {QStringLiteral("*.sgy")}, QDir::Files, QDirIterator::Subdirectories);
  while (files.hasNext()) {
    const QString file = files.next();
    ImportSegyDialog dialog(file, nullptr);
    dialog.findChild<QLineEdit*>(QStringLiteral("project"))->setText(QStringLiteral("/nowhere/a.footwall"));
    choose_time_in_ms(dialog);
    QVERIFY2(QTest::qWaitFor([&] { return !dialog.message().contains(QLatin1String("being read")); }, kLong),
             qPrintable(file));
    ++looked;
    if (!dialog.look()) {
      QVERIFY(!dialog.can_import());
      continue;
    }
    const auto survey = dialog.look()->survey;
    QVERIFY2(dialog.can_import() == survey->found().geometry.has_value(),
             qPrintable(file + dialog.message()));
    if (!dialog.can_import()) {
      QVERIFY2(!dialog.message().isEmpty(), qPrintable(file));
    } else {
      ++importable;
      // The map counts what the report counts.
      std::int64_t holes = 0;
      for (const segy::Bin bin : survey->map().cells) holes += bin == segy::Bin::kHole ? 1 : 0;
      QVERIFY2(holes == survey->found().report.missing_bins, qPrintable(file));
    }
    dialog.grab();
    if (file.endsWith(QLatin1String("/small-ps.sgy")))
      keep_picture(dialog, QStringLiteral("import-prestack"));
  }
  QVERIFY(looked > 10);
  QVERIFY(importable > 5);
}

void ImportSegyDialogTest::says_that_a_file_is_none() {
  const QTemporaryDir folder;
  const QString path = folder.path() + QStringLiteral("/none.sgy");
  {
    std::ofstream out(path.toStdString());
    out << "no SEG-Y";
  }
  ImportSegyDialog dialog(path, nullptr);
  choose_time_in_ms(dialog);
  QTRY_VERIFY_WITH_TIMEOUT(!dialog.message().contains(QLatin1String("being read")), kLong);
  QVERIFY(!dialog.can_import());
  QVERIFY(!dialog.message().isEmpty());
}

static const RegisterTest<ImportSegyDialogTest> registered;

}  // namespace footwall::ui

#include "import_segy_dialog_test.moc"
