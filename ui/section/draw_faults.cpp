#include <QLineF>
#include <algorithm>
#include <cmath>
#include <optional>

#include "ui/section/fault_shapes.h"

namespace footwall::ui {
namespace {

constexpr double kNodePixels = 8;
constexpr double kHoveredPixels = 11;
constexpr double kHoveredLine = 3.5;
constexpr double kSelectedLine = 5;  // is seen beside a hovered one

// Liang and Barsky's: painters are slow and coarse with ends that are far outside.
std::optional<QLineF> clipped(const QLineF& line, const QRectF& to) {
  double low = 0, high = 1;
  const auto cut = [&](double start, double step, double least, double most) {
    if (step == 0) return start >= least && start <= most;
    double a = (least - start) / step, b = (most - start) / step;
    if (a > b) std::swap(a, b);
    low = std::max(low, a);
    high = std::min(high, b);
    return low <= high;
  };
  if (!cut(line.x1(), line.dx(), to.left(), to.right()) || !cut(line.y1(), line.dy(), to.top(), to.bottom()))
    return {};
  return QLineF(line.pointAt(low), line.pointAt(high));
}

double distance_to_line(const QPointF& p, const QPointF& a, const QPointF& b) {
  const QPointF along = b - a, to = p - a;
  const double length = std::hypot(along.x(), along.y());
  if (length < 1e-9) return std::hypot(to.x(), to.y());
  return std::abs(along.x() * to.y() - along.y() * to.x()) / length;
}

// Of the line's pixels, those that it takes to stay within a quarter of a pixel: a mesh has many more.
QPolygonF in_pixels(const CutLine& line, const ViewTransform& view) {
  constexpr double kOff = 0.25;
  constexpr qsizetype kMostSkipped = 40;
  QPolygonF kept, skipped;
  for (const PlanePoint& p : line) {
    const QPointF at = view.to_pixels(p);
    const auto is_off = [&](const QPointF& before) {
      return distance_to_line(before, kept.back(), at) > kOff;
    };
    if (!skipped.isEmpty() && (skipped.size() == kMostSkipped || std::ranges::any_of(skipped, is_off))) {
      kept << skipped.back();
      skipped.clear();
    }
    (kept.isEmpty() ? kept : skipped) << at;
  }
  if (!skipped.isEmpty()) kept << skipped.back();
  return kept;
}

void draw_cut(QPainter& painter, const std::vector<CutLine>& lines, const ViewTransform& view,
              const QPen& pen) {
  const QRectF near = view.area().adjusted(-8, -8, 8, 8);
  painter.setPen(pen);
  painter.setBrush(Qt::NoBrush);
  QPolygonF piece;
  const auto finish = [&] {
    if (piece.size() > 1) painter.drawPolyline(piece);
    piece.clear();
  };
  for (const CutLine& line : lines) {
    const QPolygonF points = in_pixels(line, view);
    for (qsizetype n = 1; n < points.size(); ++n) {
      const auto shown = clipped({points[n - 1], points[n]}, near);
      if (!shown || piece.isEmpty() || piece.back() != shown->p1()) finish();
      if (shown) {
        if (piece.isEmpty()) piece << shown->p1();
        piece << shown->p2();
      }
    }
    finish();
  }
}

std::vector<CutLine> cut_of_face(const ShapedFault& fault, const Item& face) {
  std::vector<CutLine> lines;
  for (const CutSegment& segment : fault.cut) {
    const project::MeshFace& one = fault.surface->faces[segment.face];
    if (one.panel == face.panel && one.n == face.number) lines.push_back({segment[0], segment[1]});
  }
  return lines;
}

// 1 on the section, falling to 0 at the fade distance.
double strength_at(double distance, double fade_distance) {
  const double off = std::abs(distance);
  if (off <= kOnSection) return 1;
  if (!(off < fade_distance)) return 0;
  return 0.75 * (1 - (off - kOnSection) / (fade_distance - kOnSection));
}

void draw_segment(QPainter& painter, const ShapedNode& a, const ShapedNode& b, const ViewTransform& view,
                  const QColor& colour, double width, bool interpolated, double fade_distance) {
  const int parts = static_cast<int>(std::clamp(std::ceil(std::abs(a.distance - b.distance)), 1.0, 64.0));
  const QRectF near = view.area().adjusted(-8, -8, 8, 8);
  for (int n = 0; n < parts; ++n) {
    const auto between = [&](double part) {
      return PlanePoint{a.at.u + part * (b.at.u - a.at.u), a.at.v + part * (b.at.v - a.at.v)};
    };
    const double middle = (n + 0.5) / parts;
    const double strength = strength_at(a.distance + middle * (b.distance - a.distance), fade_distance);
    if (strength <= 0) continue;
    const auto line = clipped({view.to_pixels(between(static_cast<double>(n) / parts)),
                               view.to_pixels(between(static_cast<double>(n + 1) / parts))},
                              near);
    if (!line) continue;
    QColor faded = colour;
    faded.setAlphaF(colour.alphaF() * strength);
    QPen pen(faded, strength == 1 ? width : 1, interpolated ? Qt::DashLine : Qt::SolidLine, Qt::RoundCap);
    painter.setPen(pen);
    painter.drawLine(*line);
  }
}

void draw_pillar_line(QPainter& painter, const ShapedPillar& pillar, const ViewTransform& view,
                      const QColor& colour, const FaultDrawing& how) {
  for (std::size_t n = 0; n + 1 < pillar.nodes.size(); ++n) {
    draw_segment(painter, pillar.nodes[n], pillar.nodes[n + 1], view, colour, kHoveredLine, false,
                 how.fade_distance);
  }
}

void draw_node(QPainter& painter, const QPointF& at, double pixels, const QColor& fill,
               const QColor& outline) {
  painter.setPen(QPen(outline, 1.4));
  painter.setBrush(fill);
  painter.drawEllipse(at, pixels / 2, pixels / 2);
}

}  // namespace

void draw_fault(QPainter& painter, const ShapedFault& fault, const ViewTransform& view,
                const FaultDrawing& how, const std::set<Id>& selected_pillars,
                const std::set<Id>& selected_nodes) {
  draw_cut(painter, fault.lines, view, QPen(how.colour, 2, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin));
  if (how.face) {
    draw_cut(painter, cut_of_face(fault, how.face), view,
             QPen(how.accent, kSelectedLine, Qt::SolidLine, Qt::RoundCap));
  }
  if (!how.shows_pillars) return;
  for (const ShapedPillar& pillar : fault.pillars) {
    const bool selected = selected_pillars.contains(pillar.id);
    const bool interpolated = pillar.kind == survey::PillarKind::kInterpolated;
    const QColor colour = selected ? how.accent : how.is_active ? how.active : how.colour;
    for (std::size_t n = 0; n + 1 < pillar.nodes.size(); ++n) {
      draw_segment(painter, pillar.nodes[n], pillar.nodes[n + 1], view, colour, 2, interpolated,
                   how.fade_distance);
    }
    for (const ShapedNode& node : pillar.nodes) {
      const QPointF at = view.to_pixels(node.at);
      if (!node.on_section() || !view.area().adjusted(-8, -8, 8, 8).contains(at)) continue;
      const bool chosen = selected || selected_nodes.contains(node.id);
      draw_node(painter, at, interpolated ? kNodePixels - 2 : kNodePixels,
                chosen          ? how.accent
                : how.is_active ? how.active
                                : how.colour,
                how.outline);
    }
  }
}

void draw_hovered(QPainter& painter, const ShapedFault& fault, const Item& item, const ViewTransform& view,
                  const FaultDrawing& how) {
  if (item.kind == Item::Kind::kFault || item.kind == Item::Kind::kFace) {
    draw_cut(painter, fault.lines, view,
             QPen(how.colour.lighter(125), kHoveredLine, Qt::SolidLine, Qt::FlatCap, Qt::BevelJoin));
    // Its pillars are all that there is to see of it.
    for (const ShapedPillar& pillar : fault.pillars) {
      if (fault.lines.empty()) draw_pillar_line(painter, pillar, view, how.colour.lighter(125), how);
    }
    return;
  }
  for (const ShapedPillar& pillar : fault.pillars) {
    if (item.kind == Item::Kind::kPillar && item.id == pillar.id) {
      draw_pillar_line(painter, pillar, view, how.accent, how);
      for (const ShapedNode& node : pillar.nodes) {
        if (node.on_section())
          draw_node(painter, view.to_pixels(node.at), kNodePixels, how.accent, how.outline);
      }
    }
    for (const ShapedNode& node : pillar.nodes) {
      if (item.kind == Item::Kind::kNode && item.id == node.id && node.on_section()) {
        draw_node(painter, view.to_pixels(node.at), kHoveredPixels, how.accent, how.outline);
      }
    }
  }
}

}  // namespace footwall::ui
