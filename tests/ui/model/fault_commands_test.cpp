#include "ui/model/fault_commands.h"

#include <QTest>
#include <random>

#include "rounds.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class FaultCommandsTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void new_faults_have_free_names_and_different_colours();
  void deletes_what_is_chosen_twice_once();
  void merges_and_splits();
  void smooths_and_resamples();
  void resamples_by_metres();
  void reorders_nodes_from_end_to_end();
  void turns_and_scales_about_the_middle();
  void random_commands_can_all_be_undone_and_redone();
};

namespace {

// Everything of the interpretation, as text: equal texts, equal tables.
std::string tables(const Document& document) {
  std::string text;
  for (const Fault& fault : document.faults()) {
    const auto& f = fault.record;
    text +=
        fmt::format("fault {} {} {} {} {} {}\n", f.id, f.name, f.colour, f.revision, f.locked, f.modified);
    for (const survey::Pillar& p : fault.pillars) {
      text += fmt::format("  pillar {} {} {} {} {}\n", p.id, static_cast<int>(p.kind), p.parent_a, p.parent_b,
                          p.parameter);
      for (const auto& n : p.nodes) {
        text += fmt::format("    {} {:a} {:a} {:a}\n", n.id, n.position.x, n.position.y, n.position.z);
      }
    }
  }
  return text;
}

std::set<Id> some_pillars(const Document& document, std::mt19937_64& random, std::size_t most) {
  std::set<Id> chosen;
  for (const Fault& fault : document.faults()) {
    for (const survey::Pillar& pillar : fault.pillars) {
      if (chosen.size() < most && random() % 8 == 0) chosen.insert(pillar.id);
    }
  }
  return chosen;
}

void do_something(Document& document, std::mt19937_64& random) {
  const auto& faults = document.faults();
  const Id fault = faults.empty() ? 0 : faults[random() % faults.size()].record.id;
  const std::set<Id> pillars = some_pillars(document, random, 3);
  switch (random() % 10) {
    case 0:
      new_fault(document);
      return;
    case 1:
      if (fault != 0) rename_fault(document, fault, QStringLiteral("R%1").arg(random() % 1000));
      return;
    case 2:
      if (fault != 0) set_fault_colour(document, {fault}, next_fault_colour(document));
      return;
    case 3:
      delete_items(document, {}, pillars.size() > 1 ? std::set<Id>{*pillars.begin()} : std::set<Id>{}, {});
      return;
    case 4:
      split_fault(document, pillars);
      return;
    case 5:
      if (fault != 0 && !pillars.empty()) assign_pillars(document, pillars, fault);
      return;
    case 6:
      if (!pillars.empty() && random() % 2 == 0) {
        reverse_pillars(document, pillars);
      } else if (!pillars.empty()) {
        reorder_pillars(document, pillars);
      }
      return;
    case 7:
      if (!pillars.empty()) resample_pillars(document, pillars, 2 + static_cast<int>(random() % 5));
      return;
    case 8:
      if (!pillars.empty()) smooth_pillars(document, pillars);
      return;
    default:
      transform_items(document, {}, pillars, {},
                      {.move = {static_cast<double>(random() % 7), 1, -2}, .rotate_degrees = 3});
      return;
  }
}

}  // namespace

void FaultCommandsTest::new_faults_have_free_names_and_different_colours() {
  const SampleProject sample;
  Document document(sample.open());
  std::set<std::string> names, colours;
  for (const Fault& fault : document.faults()) colours.insert(fault.record.colour);
  const std::size_t before = document.faults().size();
  QVERIFY(before > 1);
  for (int n = 0; n < 5; ++n) {
    const Id made = new_fault(document);
    QVERIFY(made != 0);
    names.insert(document.fault(made)->record.name);
    colours.insert(document.fault(made)->record.colour);
  }
  QCOMPARE(names.size(), std::size_t{5});
  QCOMPARE(colours.size(), before + 5);
}

void FaultCommandsTest::deletes_what_is_chosen_twice_once() {
  const SampleProject sample;
  Document document(sample.open());
  const Fault first = document.faults()[0];
  const std::size_t pillars = first.pillars.size();
  std::set<Id> nodes;
  for (const auto& node : first.pillars[0].nodes)
    nodes.insert(node.id);  // all of a pillar: it goes with them
  nodes.insert(first.pillars[1].nodes[0].id);
  QVERIFY(delete_items(document, {}, {first.pillars[1].id}, nodes));
  QCOMPARE(document.faults()[0].pillars.size(), pillars - 2);
  QVERIFY(document.undo());
  QCOMPARE(document.faults()[0].pillars.size(), pillars);
  QVERIFY(delete_items(document, {first.record.id}, {first.pillars[1].id}, nodes));
  QVERIFY(document.fault(first.record.id) == nullptr);
}

void FaultCommandsTest::merges_and_splits() {
  const SampleProject sample;
  Document document(sample.open());
  QVERIFY(document.faults().size() >= 2);
  const Id into = document.faults()[0].record.id;
  const Id other = document.faults()[1].record.id;
  const std::size_t both = document.faults()[0].pillars.size() + document.faults()[1].pillars.size();
  QVERIFY(merge_faults(document, into, {other}));
  QCOMPARE(document.fault(into)->pillars.size(), both);
  QVERIFY(document.fault(other) == nullptr);
  const Id made =
      split_fault(document, {document.fault(into)->pillars[0].id, document.fault(into)->pillars[1].id});
  QCOMPARE(document.fault(made)->pillars.size(), std::size_t{2});
  QCOMPARE(document.fault(into)->pillars.size(), both - 2);
}

void FaultCommandsTest::smooths_and_resamples() {
  const SampleProject sample;
  Document document(sample.open());
  const survey::Pillar before = document.faults()[0].pillars[0];
  QVERIFY(resample_pillars(document, {before.id}, 7));
  const survey::Pillar after = *document.pillar(before.id);
  QCOMPARE(after.nodes.size(), std::size_t{7});
  QCOMPARE(after.nodes.front().position.z, before.nodes.front().position.z);
  QCOMPARE(after.nodes.back().position.z, before.nodes.back().position.z);
  document.edit("kink", [&](project::Interpretation& now) {
    survey::WorldPoint p = after.nodes[3].position;
    p.x += 30;
    now.move_node(after.nodes[3].id, p);
  });
  QVERIFY(smooth_pillars(document, {before.id}));
  const survey::Pillar smooth = *document.pillar(before.id);
  QVERIFY(std::abs(smooth.nodes[3].position.x - after.nodes[3].position.x) < 21);
  QCOMPARE(smooth.nodes[0].position.x, after.nodes[0].position.x);
}

void FaultCommandsTest::resamples_by_metres() {
  const SampleProject sample;
  Document document(sample.open());
  document.store().set_setting("velocity", "3000");
  const survey::Pillar before = document.faults()[0].pillars[0];
  // As a time survey: half the velocity makes metres of milliseconds.
  const auto metres = [&](const survey::WorldPoint& a, const survey::WorldPoint& b) {
    return std::hypot(a.x - b.x, a.y - b.y, (a.z - b.z) * 1.5);
  };
  double length = 0;
  for (std::size_t n = 1; n < before.nodes.size(); ++n)
    length += metres(before.nodes[n - 1].position, before.nodes[n].position);
  QVERIFY(resample_by_spacing(document, {before.id}, length / 6.2));
  const survey::Pillar after = *document.pillar(before.id);
  QCOMPARE(after.nodes.size(), std::size_t{7});
  QCOMPARE(after.nodes.front().position, before.nodes.front().position);
  QCOMPARE(after.nodes.back().position, before.nodes.back().position);
  for (std::size_t n = 1; n < after.nodes.size(); ++n) {
    QVERIFY(metres(after.nodes[n - 1].position, after.nodes[n].position) <= length / 6 + 1e-6);
  }
  // Longer than the pillar: its ends stay.
  QVERIFY(resample_by_spacing(document, {before.id}, 1e6));
  QCOMPARE(document.pillar(before.id)->nodes.size(), std::size_t{2});
  QVERIFY(!resample_by_spacing(document, {before.id}, 0));
}

void FaultCommandsTest::reorders_nodes_from_end_to_end() {
  const SampleProject sample;
  Document document(sample.open());
  const Id id = document.faults()[0].pillars[0].id;
  QVERIFY(resample_pillars(document, {id}, 9));
  const survey::Pillar before = *document.pillar(id);
  const std::size_t steps = document.history().size();
  QVERIFY(!reorder_pillars(document, {id}));  // in order already
  QCOMPARE(document.history().size(), steps);
  std::mt19937_64 random(6);
  for (int round = 0; round < 20; ++round) {
    // The first stays near its end, or the other end would be the start.
    std::vector<Id> order;
    for (const auto& node : before.nodes) order.push_back(node.id);
    std::shuffle(order.begin() + 1, order.end(), random);
    document.edit("tangle", [&](project::Interpretation& now) { now.reorder_nodes(id, order); });
    QVERIFY(reorder_pillars(document, {id}) || order[1] == before.nodes[1].id);
    const auto& after = document.pillar(id)->nodes;
    QVERIFY(std::ranges::equal(after, before.nodes, {}, &survey::PillarNode::id, &survey::PillarNode::id));
  }
}

void FaultCommandsTest::turns_and_scales_about_the_middle() {
  const SampleProject sample;
  Document document(sample.open());
  const survey::Pillar before = document.faults()[0].pillars[0];
  const survey::WorldPoint centre{before.nodes[0].position.x, before.nodes[0].position.y - 100, 0};
  QVERIFY(transform_items(document, {}, {}, {before.nodes[0].id}, {.rotate_degrees = 90, .centre = centre}));
  // 100 north of the centre, a quarter turn clockwise: 100 east of it.
  const survey::WorldPoint now = document.pillar(before.id)->nodes[0].position;
  QVERIFY(std::abs(now.x - (centre.x + 100)) < 1e-6);
  QVERIFY(std::abs(now.y - centre.y) < 1e-6);
  QCOMPARE(now.z, before.nodes[0].position.z);
  QVERIFY(transform_items(document, {document.faults()[0].record.id}, {}, {}, {.move = {0, 0, 4}}));
  QCOMPARE(document.pillar(before.id)->nodes[1].position.z, before.nodes[1].position.z + 4);
}

void FaultCommandsTest::random_commands_can_all_be_undone_and_redone() {
  const SampleProject sample;
  Document document(sample.open());
  const std::string start = tables(document);
  const std::size_t known = document.history().size();
  std::mt19937_64 random(7);
  for (int n = 0; n < rounds(200); ++n) do_something(document, random);
  const std::string end = tables(document);
  QVERIFY(document.history().size() > known + 50);
  QVERIFY(document.go_to_step(document.history()[known - 1].id));
  QCOMPARE(QString::fromStdString(tables(document)), QString::fromStdString(start));
  QVERIFY(document.go_to_step(document.history().back().id));
  QCOMPARE(QString::fromStdString(tables(document)), QString::fromStdString(end));
}

static const RegisterTest<FaultCommandsTest> kRegistered;

}  // namespace footwall::ui

#include "fault_commands_test.moc"
