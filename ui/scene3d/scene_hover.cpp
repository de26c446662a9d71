// What the mouse is over, and where it is in another view.
#include <algorithm>
#include <cmath>

#include "ui/scene3d/scene_drawing.h"

namespace footwall::ui {
namespace {

// The box around an isosurface, which has no outline: by its fewest triangles, which reach about as far.
// Two of its sides run as the inlines' axis does.
void add_box_lines(std::vector<Line>& lines, const IsosurfaceShape& shape, const render::SceneFrame& frame,
                   const QColor& colour) {
  using render::Vec3;
  const Vec3 side = frame.scene_of(survey::IndexPoint{1, 0, 0}) - frame.scene_of(survey::IndexPoint{0, 0, 0});
  const Vec3 across = side * (1 / length(side));
  const Vec3 along{-across.y, across.x, 0};
  Vec3 lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
  for (const std::uint32_t corner : shape.coarse.back().corners) {
    const Vec3 p(shape.positions[corner]);
    const Vec3 in_box{dot(p, across), dot(p, along), p.z};
    lo = {std::min(lo.x, in_box.x), std::min(lo.y, in_box.y), std::min(lo.z, in_box.z)};
    hi = {std::max(hi.x, in_box.x), std::max(hi.y, in_box.y), std::max(hi.z, in_box.z)};
  }
  const auto corner = [&](unsigned n) {
    return render::Vec3f(across * ((n & 1U) != 0 ? hi.x : lo.x) + along * ((n & 2U) != 0 ? hi.y : lo.y) +
                         Vec3{0, 0, (n & 4U) != 0 ? hi.z : lo.z});
  };
  for (unsigned n = 0; n < 8; ++n) {
    for (const unsigned axis : {1U, 2U, 4U}) {
      if ((n & axis) == 0) lines.push_back({corner(n), corner(n | axis), rgba_of(colour), 1.6F});
    }
  }
}

}  // namespace

// A fault without an outline, or one whose outline is long to find, shows by its pillars.
void SceneDrawing::add_fault_lines(std::vector<Line>& lines, Id fault) const {
  if (!workbench_.display.is_visible({.kind = Item::Kind::kFault, .id = fault})) return;
  const FaultGeometry* mesh = meshes_.geometry(fault);
  if (mesh == nullptr || mesh->face_count() == 0 || mesh->face_count() > kLooseTriangles) {
    for (const survey::Pillar& pillar : workbench_.document.shown_pillars(fault))
      add_pillar_lines(lines, pillar, colours_.text, 2.4F);
    return;
  }
  for (std::size_t n = 0; n + 1 < mesh->outline().size(); n += 2)
    lines.push_back({mesh->outline()[n], mesh->outline()[n + 1], rgba_of(colours_.text), 1.6F});
}

void SceneDrawing::draw_hover(const Pass& pass) {
  const Item& hovered = workbench_.selection.hovered();
  std::vector<Line> lines;
  std::vector<Dot> dots;
  if (hovered.kind == Item::Kind::kFace || hovered.kind == Item::Kind::kFault)
    add_fault_lines(lines, hovered.id);
  for (const IsosurfaceLook& look : shown_shapes()) {
    if (flat_ && hovered == Item{.kind = Item::Kind::kIsosurface, .id = look.id})
      add_box_lines(lines, *shapes_.shape(look.id), *flat_, colours_.text);
  }
  if (hovered.kind == Item::Kind::kFace) add_face_lines(lines, hovered, Qt::white, 2.4F);
  if (hovered.kind == Item::Kind::kPillar || hovered.kind == Item::Kind::kNode) {
    const Fault* fault = hovered.kind == Item::Kind::kPillar ? workbench_.document.fault_of_pillar(hovered.id)
                                                             : workbench_.document.fault_of_node(hovered.id);
    for (const survey::Pillar& pillar : fault == nullptr
                                            ? std::vector<survey::Pillar>()
                                            : workbench_.document.shown_pillars(fault->record.id)) {
      if (hovered.kind == Item::Kind::kPillar) {
        if (pillar.id == hovered.id) add_pillar_lines(lines, pillar, colours_.accent, 3.0F);
        continue;
      }
      for (const survey::PillarNode& node : pillar.nodes) {
        if (node.id != hovered.id) continue;
        dots.push_back({render::Vec3f(flat_of(node.position)), rgba_of(QColor(Qt::white)),
                        rgba_of(colours_.accent), 12.0F});
      }
    }
  }
  // Where the mouse is in another view.
  if (workbench_.display.cursor() && flat_ && !has_mouse) {
    dots.push_back({render::Vec3f(flat_->scene_of(*workbench_.display.cursor())), rgba_of(colours_.accent),
                    rgba_of(QColor(Qt::white)), 8.0F});
  }
  hover_lines_.set(*gl_, lines);
  hover_dots_.set(*gl_, dots);
  marks_.draw(*gl_, pass, hover_lines_, true, 1.5F * Marks::kLift);
  marks_.draw(*gl_, pass, hover_dots_, true);
}

}  // namespace footwall::ui
