// From pillar to pillar and from node to node: what the keyboard selects where the mouse would click.
#pragma once
#include <vector>

#include "ui/model/display.h"
#include "ui/model/selection.h"

namespace footwall::ui {

// The fault's pillars in their order along it, and those that run across it (a time slice's) likewise; those
// of a fault with fewer than three in the order they were made.
std::vector<Id> pillars_along(const Fault& fault, const survey::Geometry& survey);

// The pillar `by` (1 or -1) beside the one that is selected, or that a selected node belongs to; where none
// is, the first of the active fault, or the last where by is -1. Behind the last comes the first. Nothing
// where the fault has no pillars.
Item next_pillar(const Document& document, const Selection& selection, int by);
// The same among the nodes of that pillar, from its top to its end.
Item next_node(const Document& document, const Selection& selection, int by);

// The linked sections along lines and slices move to the place; how large they show it stays.
void bring_sections_to(Display& display, const survey::Geometry& survey, const survey::IndexPoint& place);
// Where sections have to be to show the item: of a pillar the middle of its nodes. Nothing for other items.
std::optional<survey::IndexPoint> place_of(const Document& document, const Item& item);

}  // namespace footwall::ui
