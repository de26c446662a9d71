// A hand that picks, drags and gives commands at random, as a user does in a day: the same gestures for the
// same seed.
#pragma once
#include <QString>
#include <random>
#include <set>

#include "ui/model/picking.h"

namespace footwall::ui {

class RandomHand {
 public:
  // Undoes no step that is there already.
  RandomHand(Document& document, Selection& selection, Picking& picking, unsigned seed);

  // One gesture or command; what it was. It may be refused, or come to nothing.
  QString act();
  // Moves one node that can be moved, as one edit.
  bool move_a_node();

 private:
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }
  double between(double low, double high);
  const Fault* some_fault(bool with_pillars);
  std::set<Id> some_pillars(const Fault& fault, std::size_t most);
  Section some_section();
  Section section_through(const survey::PillarNode& node);
  PlanePoint some_place(const Section& section);
  Pointer at(const Section& section, const PlanePoint& place, const Item& under = {},
             Qt::KeyboardModifiers modifiers = {});

  void click(const Pointer& pointer);
  void drag(const Pointer& from, const PlanePoint& to, bool gives_up, std::chrono::milliseconds pace);
  QString pick(std::size_t what);
  QString command(std::size_t what);
  QString step_in_history();

  Document& document_;
  Selection& selection_;
  Picking& picking_;
  std::mt19937 random_;
  std::size_t first_steps_ = 0, first_faults_ = 0, first_pillars_ = 0;
  std::chrono::milliseconds clock_{0};
};

}  // namespace footwall::ui
