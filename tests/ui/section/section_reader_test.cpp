#include "ui/model/section_reader.h"

#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <map>

#include "engine/tasks/add_volume.h"
#include "storage/volume/volume_reader.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {
namespace {

using Samples = std::shared_ptr<const SectionSamples>;

// Keeps the answers to one asker.
class Asker : public QObject {
 public:
  explicit Asker(SectionReader& reader) : reader_(reader) {
    connect(&reader, &SectionReader::ready, this, [this](QObject* asker, const Samples& samples) {
      if (asker == this) answers.push_back(samples);
    });
    connect(&reader, &SectionReader::failed, this,
            [this](QObject* asker, const QString& message, const QString& hint) {
              if (asker == this) failures.emplace_back(message, hint);
            });
  }
  Samples ask(Id volume, const Section& section) {
    answers.clear();
    reader_.ask(this, volume, section);
    if (!QTest::qWaitFor([&] { return !answers.empty() || !failures.empty(); }, 20000) || answers.empty())
      return nullptr;
    return answers.back();
  }
  std::vector<Samples> answers;
  std::vector<std::pair<QString, QString>> failures;

 private:
  SectionReader& reader_;
};

struct WholeVolume {
  explicit WholeVolume(const std::filesystem::path& path) : reader(path), dims(reader.info().dims) {
    values.resize(static_cast<std::size_t>(dims[0] * dims[1] * dims[2]));
    reader.read({{0, 0, 0}, dims}, values);
  }
  float at(std::int64_t i, std::int64_t j, std::int64_t k) const {
    if (i < 0 || j < 0 || k < 0 || i >= dims[0] || j >= dims[1] || k >= dims[2]) return NAN;
    return values[static_cast<std::size_t>((i * dims[1] + j) * dims[2] + k)];
  }
  volume::VolumeReader reader;
  survey::Index dims;
  std::vector<float> values;
};

bool same(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

// Every sample against the volume read whole, the volume's first voxel at `origin`.
bool holds_the_volume(const SectionSamples& samples, const WholeVolume& volume, const survey::Index& origin) {
  for (int row = 0; row < samples.rows; ++row) {
    for (int column = 0; column < samples.columns; ++column) {
      const survey::IndexPoint p =
          index_of(samples.section, {static_cast<double>(column), static_cast<double>(row)});
      if (!same(samples.at(column, row),
                volume.at(std::llround(p.i) - origin[0], std::llround(p.j) - origin[1],
                          std::llround(p.k) - origin[2]))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

class SectionReaderTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void sections_are_the_volumes_samples();
  void volumes_may_cover_a_part();
  void the_newest_request_wins();
  void answers_from_memory_before_it_returns();
  void reads_ahead_in_the_steps_direction();
  void says_what_is_missing();
  void percentiles_are_of_magnitudes();
};

void SectionReaderTest::sections_are_the_volumes_samples() {
  const SampleProject sample("faulted", {40, 37, 70});
  Document document(sample.open());
  const WholeVolume volume(document.project().volume_path(document.volumes().front()));
  SectionReader reader(document);
  Asker asker(reader);
  const Id id = document.volumes().front().id;
  std::vector<Section> sections;
  for (const std::int64_t n : {0, 31, 32, 36}) {
    for (const auto kind : {Section::Kind::kInline, Section::Kind::kCrossline, Section::Kind::kSlice}) {
      sections.push_back({.kind = kind, .index = n});
    }
  }
  sections.push_back({.kind = Section::Kind::kLine, .index = 0, .from = {-5, 3, 0}, .to = {44, 35.5, 0}});
  sections.push_back({.kind = Section::Kind::kLine, .index = 0, .from = {7, 7, 0}, .to = {7, 7, 0}});
  for (const Section& section : sections) {
    const Samples samples = asker.ask(id, section);
    QVERIFY(samples != nullptr);
    QCOMPARE(samples->section, section);
    QCOMPARE(samples->columns, static_cast<int>(size_of(section, *document.survey()).width));
    QCOMPARE(samples->rows, static_cast<int>(size_of(section, *document.survey()).height));
    QVERIFY(holds_the_volume(*samples, volume, {0, 0, 0}));
  }
}

void SectionReaderTest::volumes_may_cover_a_part() {
  const SampleProject sample;
  project::Project project = sample.open();
  survey::Geometry part = *project.survey();
  const survey::Index origin{10, 5, 20};
  part.map.origin_x = part.world_of({10, 5, 0}).x;
  part.map.origin_y = part.world_of({10, 5, 0}).y;
  part.inlines = {static_cast<std::int32_t>(part.inlines.line_of(10)), part.inlines.step, 12};
  part.crosslines = {static_cast<std::int32_t>(part.crosslines.line_of(5)), part.crosslines.step, 9};
  part.z0 += 20 * part.interval;
  part.samples = 30;
  tasks::VolumeSource source;
  source.geometry = part;
  source.fill = [](const survey::Box& box, std::span<float> values, std::span<std::uint8_t>) {
    std::size_t n = 0;
    for (std::int64_t i = box.lo[0]; i < box.hi[0]; ++i) {
      for (std::int64_t j = box.lo[1]; j < box.hi[1]; ++j) {
        for (std::int64_t k = box.lo[2]; k < box.hi[2]; ++k) {
          values[n++] = k == 3 ? NAN : static_cast<float>(i * 1000 + j * 100 + k);
        }
      }
    }
  };
  tasks::add_volume(project, "part", source, {});
  Document document(std::move(project));
  const project::VolumeRecord& record = document.volumes().back();
  QCOMPARE(record.origin, origin);
  const WholeVolume volume(document.project().volume_path(record));
  SectionReader reader(document);
  Asker asker(reader);
  for (const Section& section : std::vector<Section>{
           {.kind = Section::Kind::kInline, .index = 15},
           {.kind = Section::Kind::kInline, .index = 3},
           {.kind = Section::Kind::kCrossline, .index = 13},
           {.kind = Section::Kind::kSlice, .index = 23},
           {.kind = Section::Kind::kSlice, .index = 49},
           {.kind = Section::Kind::kLine, .index = 0, .from = {0, 0, 0}, .to = {40, 30, 0}}}) {
    const Samples samples = asker.ask(record.id, section);
    QVERIFY(samples != nullptr);
    QVERIFY(holds_the_volume(*samples, volume, origin));
  }
}

void SectionReaderTest::the_newest_request_wins() {
  const SampleProject sample;
  Document document(sample.open());
  SectionReader reader(document);
  Asker asker(reader), other(reader);
  const Id id = document.volumes().front().id;
  for (std::int64_t n = 0; n < 40; ++n) {
    reader.ask(&asker, id, {.kind = Section::Kind::kInline, .index = n});
    reader.ask(&other, id, {.kind = Section::Kind::kSlice, .index = n});
  }
  const auto last_is = [](const Asker& one, std::int64_t index) {
    return !one.answers.empty() && one.answers.back()->section.index == index;
  };
  QTRY_VERIFY_WITH_TIMEOUT(last_is(asker, 39) && last_is(other, 39), 20000);
  // In the order they were asked for, and none after the newest.
  const auto earlier = [](const Samples& a, const Samples& b) { return a->section.index < b->section.index; };
  QVERIFY(std::ranges::is_sorted(asker.answers, earlier));
  // There and back again while it reads: the last word counts.
  for (int n = 0; n < 30; ++n) {
    reader.ask(&asker, id, {.kind = Section::Kind::kCrossline, .index = 1});
    reader.ask(&asker, id, {.kind = Section::Kind::kCrossline, .index = 30});
    reader.ask(&asker, id, {.kind = Section::Kind::kCrossline, .index = 1});
  }
  asker.answers.clear();
  QTRY_VERIFY_WITH_TIMEOUT(
      last_is(asker, 1) || reader.kept(id, {.kind = Section::Kind::kCrossline, .index = 1}), 20000);
}

void SectionReaderTest::answers_from_memory_before_it_returns() {
  const SampleProject sample;
  Document document(sample.open());
  SectionReader reader(document);
  const Id id = document.volumes().front().id;
  const Section section{.kind = Section::Kind::kInline, .index = 4};
  QVERIFY(reader.kept(id, section) == nullptr);
  QVERIFY(reader.facts(id) == nullptr);
  {
    Asker asker(reader);
    QVERIFY(asker.ask(id, section) != nullptr);
    QVERIFY(reader.facts(id) != nullptr);
    asker.answers.clear();
    reader.ask(&asker, id, section);
    QCOMPARE(asker.answers.size(), std::size_t{1});
    QVERIFY(reader.kept(id, section) == asker.answers[0]);
    reader.ask(&asker, id, {.kind = Section::Kind::kInline, .index = 5});
  }  // gone before its answer comes
  QTRY_VERIFY(reader.kept(id, {.kind = Section::Kind::kInline, .index = 5}) != nullptr);
}

void SectionReaderTest::reads_ahead_in_the_steps_direction() {
  const SampleProject sample;
  Document document(sample.open());
  SectionReader reader(document);
  Asker asker(reader);
  const Id id = document.volumes().front().id;
  const auto at = [](std::int64_t n) { return Section{.kind = Section::Kind::kInline, .index = n}; };
  asker.ask(id, at(40));
  asker.ask(id, at(35));
  QTRY_VERIFY(reader.kept(id, at(30)) != nullptr && reader.kept(id, at(25)) != nullptr);
  QVERIFY(reader.kept(id, at(36)) == nullptr);
}

void SectionReaderTest::says_what_is_missing() {
  const SampleProject sample;
  Document document(sample.open());
  const project::VolumeRecord record = document.volumes().front();
  const std::filesystem::path path = document.project().volume_path(record);
  const std::filesystem::path elsewhere = path.string() + ".away";
  std::filesystem::rename(path, elsewhere);
  SectionReader reader(document);
  Asker asker(reader);
  QVERIFY(asker.ask(record.id, {}) == nullptr);
  QVERIFY(asker.failures.at(0).first.contains(QString::fromStdString(path.filename().string())));
  std::filesystem::rename(elsewhere, path);
  asker.failures.clear();
  QVERIFY(asker.ask(record.id, {}) != nullptr);  // no need to start again
  QVERIFY(asker.ask(12345, {}) == nullptr);
  QCOMPARE(asker.failures.size(), std::size_t{1});
  asker.failures.clear();
  const Section endless{.kind = Section::Kind::kLine, .index = 0, .from = {0, 0, 0}, .to = {NAN, 1, 0}};
  QVERIFY(asker.ask(record.id, endless) == nullptr);
  const Section long_line{.kind = Section::Kind::kLine, .index = 0, .from = {-8e6, 0, 0}, .to = {8e6, 1, 0}};
  asker.failures.clear();
  QVERIFY(asker.ask(record.id, long_line) == nullptr);
  QVERIFY(!asker.failures[0].second.isEmpty());
}

void SectionReaderTest::percentiles_are_of_magnitudes() {
  const SampleProject sample;
  Document document(sample.open());
  const WholeVolume volume(document.project().volume_path(document.volumes().front()));
  std::vector<float> magnitudes;
  for (const float value : volume.values) {
    if (!std::isnan(value)) magnitudes.push_back(std::abs(value));
  }
  std::ranges::sort(magnitudes);
  SectionReader reader(document);
  Asker asker(reader);
  const Id id = document.volumes().front().id;
  asker.ask(id, {});
  const auto* facts = reader.facts(id);
  QVERIFY(facts != nullptr && facts->signed_values);
  QCOMPARE(facts->percentiles.size(), std::size_t{101});
  QCOMPARE(facts->max_abs, static_cast<double>(magnitudes.back()));
  for (const int p : {50, 80, 90, 95, 98, 99, 100}) {
    const double truth = magnitudes[(magnitudes.size() - 1) * static_cast<std::size_t>(p) / 100];
    QVERIFY2(std::abs(facts->percentiles[static_cast<std::size_t>(p)] - truth) <
                 0.03 * truth + 1e-3 * facts->max_abs,
             qPrintable(QStringLiteral("%1: %2, not %3")
                            .arg(p)
                            .arg(facts->percentiles[static_cast<std::size_t>(p)])
                            .arg(truth)));
  }
}

static const RegisterTest<SectionReaderTest> kRegistered;

}  // namespace footwall::ui

#include "section_reader_test.moc"
