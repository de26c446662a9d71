// What is selected, and what lies under the mouse: the same in the tree, sections, scene and inspector.
#pragma once
#include <QObject>
#include <set>
#include <variant>

#include "ui/model/document.h"

namespace footwall::ui {

// One thing that can be pointed at.
struct Item {
  enum class Kind {
    kNone,
    kSurvey,
    kVolume,
    kFault,
    kPillar,
    kNode,
    kFace,
    kIsosurface,
    kSection,
    kRun,
    kView
  };
  Kind kind = Kind::kNone;
  Id id = 0;          // of a face: the fault's
  Id panel = 0;       // of a face
  int number = 0;     // of a face, in its panel
  QString name = {};  // of a view, which has no number
  explicit operator bool() const { return kind != Kind::kNone; }
  friend bool operator==(const Item&, const Item&) = default;
};

class Selection final : public QObject {
  Q_OBJECT

 public:
  explicit Selection(Document& document, QObject* parent = nullptr);

  // The item last selected; the inspector shows it.
  const Item& current() const { return current_; }
  // What it belongs to that has a name: the fault of faces, pillars and nodes, else the item itself. Nothing
  // where they are of several faults.
  Item owner() const;
  // The fault of the current item, or 0: where picks go.
  Id active_fault() const { return active_fault_; }
  const std::set<Id>& faults() const { return faults_; }
  const std::set<Id>& pillars() const { return pillars_; }
  const std::set<Id>& nodes() const { return nodes_; }
  const Item& hovered() const { return hovered_; }

  // extend: adds, or takes away what was selected already, as Ctrl does.
  void select(const Item& item, bool extend = false);
  // To what is selected already; the item becomes the current one.
  void add(const Item& item);
  void select_all(std::set<Id> faults, std::set<Id> pillars, std::set<Id> nodes, bool extend = false);
  // What a lasso caught, instead of what was selected; says so where pillars without a fault are among it.
  void select_by_lasso(std::set<Id> faults, std::set<Id> pillars, std::set<Id> nodes);
  void set_active_fault(Id fault);
  void clear();
  void hover(const Item& item);

 Q_SIGNALS:
  void changed();
  void active_fault_changed(footwall::ui::Id fault);
  void hover_changed();
  // A lasso caught these, which belong to no fault yet and may be given to one.
  void unassigned_caught(const std::set<footwall::ui::Id>& pillars);

 private:
  // The one thing that is selected; nothing where there are several.
  Item only_one() const;
  void drop_what_is_gone();
  void announce(Id active);

  Document& document_;
  Item current_, hovered_;
  Id active_fault_ = 0;
  std::set<Id> faults_, pillars_, nodes_;
};

}  // namespace footwall::ui
