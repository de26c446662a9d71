#include "ui/model/walk.h"

#include <QTest>
#include <algorithm>
#include <cmath>

#include "ui/model/fault_commands.h"
#include "ui/sample_project.h"
#include "ui/test_class.h"

namespace footwall::ui {

class WalkTest final : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void pillars_come_in_their_order_along_the_fault();
  void steps_lead_around_and_back();
  void nodes_are_those_of_the_pillar();
  void what_is_added_stays_selected();
  void sections_follow_those_that_are_linked();
  void a_fault_without_pillars_has_nowhere_to_go();
};

// Three inlines' pillars, made out of order: 30, 10, 20.
static Id out_of_order(Document& document) {
  Id fault = 0;
  document.edit(QStringLiteral("make"), [&](project::Interpretation& now) {
    fault = now.add_fault("walked");
    for (const double line : {30.0, 10.0, 20.0}) {
      std::vector<survey::WorldPoint> nodes;
      for (const double depth : {5.0, 20.0, 40.0})
        nodes.push_back(document.survey()->world_of({line, 12 + depth / 10, depth}));
      now.add_pillar(fault, survey::PillarKind::kInterpreted, nodes);
    }
  });
  return fault;
}

static double line_of(const Document& document, const Item& item) {
  return document.survey()->index_of(document.pillar(item.id)->nodes.front().position).i;
}

void WalkTest::pillars_come_in_their_order_along_the_fault() {
  const SampleProject sample;
  Document document(sample.open());
  const Fault* fault = document.fault(out_of_order(document));
  QVERIFY(fault != nullptr);
  std::vector<double> lines;
  for (const Id id : pillars_along(*fault, *document.survey()))
    lines.push_back(std::round(line_of(document, {.kind = Item::Kind::kPillar, .id = id})));
  QVERIFY((lines == std::vector<double>{10, 20, 30}) || (lines == std::vector<double>{30, 20, 10}));
  // Two pillars have no chart: they come as they were made.
  Fault two = *fault;
  two.pillars.pop_back();
  const std::vector<Id> made = pillars_along(two, *document.survey());
  QVERIFY((made == std::vector<Id>{two.pillars[0].id, two.pillars[1].id}));
}

void WalkTest::steps_lead_around_and_back() {
  const SampleProject sample;
  Document document(sample.open());
  Selection selection(document);
  const Id fault = out_of_order(document);
  const std::vector<Id> along = pillars_along(*document.fault(fault), *document.survey());
  selection.set_active_fault(fault);
  QCOMPARE(next_pillar(document, selection, 1).id, along.front());
  QCOMPARE(next_pillar(document, selection, -1).id, along.back());
  for (const Id expected : {along[0], along[1], along[2], along[0]}) {
    selection.select(next_pillar(document, selection, 1));
    QCOMPARE(selection.current(), (Item{.kind = Item::Kind::kPillar, .id = expected}));
  }
  selection.select(next_pillar(document, selection, -1));
  QCOMPARE(selection.current().id, along[2]);
  // From a node of it the pillar beside is as near.
  selection.select({.kind = Item::Kind::kNode, .id = document.pillar(along[1])->nodes[1].id});
  QCOMPARE(next_pillar(document, selection, 1).id, along[2]);
}

void WalkTest::nodes_are_those_of_the_pillar() {
  const SampleProject sample;
  Document document(sample.open());
  Selection selection(document);
  const std::vector<Id> along = pillars_along(*document.fault(out_of_order(document)), *document.survey());
  selection.select({.kind = Item::Kind::kPillar, .id = along[1]});
  const auto& nodes = document.pillar(along[1])->nodes;
  for (const std::size_t expected : {0, 1, 2, 0}) {
    selection.select(next_node(document, selection, 1));
    QCOMPARE(selection.current(), (Item{.kind = Item::Kind::kNode, .id = nodes[expected].id}));
  }
  selection.select(next_node(document, selection, -1));
  QCOMPARE(selection.current().id, nodes[2].id);
}

void WalkTest::what_is_added_stays_selected() {
  const SampleProject sample;
  Document document(sample.open());
  Selection selection(document);
  const std::vector<Id> along = pillars_along(*document.fault(out_of_order(document)), *document.survey());
  selection.select({.kind = Item::Kind::kPillar, .id = along[0]});
  selection.add(next_pillar(document, selection, 1));
  QCOMPARE(selection.pillars(), (std::set<Id>{along[0], along[1]}));
  // Back over what is selected takes nothing away.
  selection.add(next_pillar(document, selection, -1));
  QCOMPARE(selection.current().id, along[0]);
  QCOMPARE(selection.pillars(), (std::set<Id>{along[0], along[1]}));
}

void WalkTest::sections_follow_those_that_are_linked() {
  const SampleProject sample;
  Document document(sample.open());
  Display display(document);
  const Id linked = display.add_section({.kind = Section::Kind::kInline, .index = 3});
  const Id free = display.add_section({.kind = Section::Kind::kInline, .index = 3});
  display.change_section(
      {.id = free, .section = {.kind = Section::Kind::kInline, .index = 3}, .linked = false});
  const std::vector<Id> along = pillars_along(*document.fault(out_of_order(document)), *document.survey());
  const Item pillar{.kind = Item::Kind::kPillar, .id = along[1]};
  const auto place = place_of(document, pillar);
  QVERIFY(place.has_value());
  bring_sections_to(display, *document.survey(), *place);
  const auto index_of = [&](Id id) {
    return std::ranges::find(display.sections(), id, &Display::ShownSection::id)->section.index;
  };
  QCOMPARE(index_of(linked), std::int64_t{20});
  QCOMPARE(index_of(free), std::int64_t{3});
  const Item node{.kind = Item::Kind::kNode, .id = document.pillar(along[1])->nodes[2].id};
  QVERIFY(std::abs(place_of(document, node)->k - 40) < 1e-6);
  QVERIFY(!place_of(document, {.kind = Item::Kind::kFault, .id = 1}));
}

void WalkTest::a_fault_without_pillars_has_nowhere_to_go() {
  const SampleProject sample;
  Document document(sample.open());
  Selection selection(document);
  selection.set_active_fault(new_fault(document));
  QVERIFY(!next_pillar(document, selection, 1));
  QVERIFY(!next_node(document, selection, 1));
  selection.set_active_fault(0);
  selection.clear();
  QVERIFY(!next_pillar(document, selection, 1));
}

static const RegisterTest<WalkTest> kRegistered;

}  // namespace footwall::ui

#include "walk_test.moc"
