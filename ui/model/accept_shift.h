// What the statistic `offset` suggests: a face, or a pillar, moved along the fault's normal to where the
// volume is most discontinuous. As nodes and where they would go, so that the window can say it before and do
// it in one edit.
//
// A face moves by the nodes between which its middle lies: on each pillar that bounds its panel the two
// around the point nearest to the middle. Their weights w are linear along the pillar and go with one over
// the distance between pillars; each node moves by w / sum(w^2) of the shift, the smallest moves that move
// the middle by the whole of it. Of a pillar each node moves by the mean offset, along the mean normal, of
// the faces that touch the pillar nearer to this node than to its others; a node without such a face stays.
#pragma once
#include <QString>
#include <map>
#include <optional>

#include "ui/model/selection.h"
#include "ui/model/surfaces.h"

namespace footwall::ui {

struct Shift {
  std::map<Id, survey::WorldPoint> moved;  // node -> where it goes
  double voxels = 0;  // along the fault's normal; of several nodes that of the one that moves farthest
};

// face: number in the surface; offsets: of it, in voxels. Pillars that bound the face's panel are told by the
// surface's vertices. Nothing where the offset is not known, is of before the face moved, or is zero; or no
// pillar is there.
std::optional<Shift> shift_of_face(const survey::Geometry& survey, const std::vector<survey::Pillar>& pillars,
                                   const FaultSurface& surface, const FaceNumbers& offsets, std::size_t face);
std::optional<Shift> shift_of_pillar(const survey::Geometry& survey, const survey::Pillar& pillar,
                                     const FaultSurface& surface, const FaceNumbers& offsets);

// Of the current face, or of all selected pillars, by what is known now, also while views show a stored run.
// Nothing where there is none; why (may be null) says so in a line, and is left empty where neither a face
// nor a pillar is selected.
std::optional<Shift> suggested_shift(const Document& document, const Surfaces& surfaces,
                                     const Selection& selection, QString* why);
// What Enter would do, in a line; empty where it would do nothing.
QString shift_hint(const Document& document, const Surfaces& surfaces, const Selection& selection);
// One edit, "Accept shift". False where there is nothing to accept or the project refused it:
// Document::failed has said why.
bool accept_shift(Document& document, const Surfaces& surfaces, const Selection& selection);

}  // namespace footwall::ui
