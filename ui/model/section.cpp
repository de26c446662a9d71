#include "ui/model/section.h"

#include <algorithm>
#include <cmath>

namespace footwall::ui {
namespace {

double line_length(const Section& section) {
  return std::hypot(section.to.i - section.from.i, section.to.j - section.from.j);
}

QString z_text(const survey::Geometry& survey, double sample) {
  return QStringLiteral("%1 %2")
      .arg(survey.z0 + sample * survey.interval, 0, 'g', 6)
      .arg(QString::fromUtf8(survey::name_of(survey.vertical_unit).data()));
}

QString place_text(const survey::Geometry& survey, const survey::IndexPoint& p) {
  return QStringLiteral("%1/%2")
      .arg(survey.inlines.line_of(std::llround(p.i)))
      .arg(survey.crosslines.line_of(std::llround(p.j)));
}

}  // namespace

QString title_of(const Section& section, const survey::Geometry& survey) {
  switch (section.kind) {
    case Section::Kind::kInline:
      return QObject::tr("Inline %1").arg(survey.inlines.line_of(section.index));
    case Section::Kind::kCrossline:
      return QObject::tr("Crossline %1").arg(survey.crosslines.line_of(section.index));
    case Section::Kind::kSlice:
      return (survey.domain == survey::Domain::kTime ? QObject::tr("Time slice %1")
                                                     : QObject::tr("Depth slice %1"))
          .arg(z_text(survey, static_cast<double>(section.index)));
    case Section::Kind::kLine:
      break;
  }
  return QObject::tr("Line %1 - %2").arg(place_text(survey, section.from), place_text(survey, section.to));
}

std::int64_t last_index(const Section& section, const survey::Geometry& survey) {
  const survey::Index dims = survey.dims();
  switch (section.kind) {
    case Section::Kind::kInline:
      return dims[0] - 1;
    case Section::Kind::kCrossline:
      return dims[1] - 1;
    case Section::Kind::kSlice:
      return dims[2] - 1;
    case Section::Kind::kLine:
      break;
  }
  return 0;
}

Section stepped(const Section& section, std::int64_t by, const survey::Geometry& survey) {
  Section next = section;
  if (section.kind != Section::Kind::kLine) {
    next.index = std::clamp<std::int64_t>(section.index + by, 0, last_index(section, survey));
  }
  return next;
}

PlanePoint plane_of(const Section& section, const survey::IndexPoint& p) {
  switch (section.kind) {
    case Section::Kind::kInline:
      return {p.j, p.k};
    case Section::Kind::kCrossline:
      return {p.i, p.k};
    case Section::Kind::kSlice:
      return {p.j, p.i};
    case Section::Kind::kLine:
      break;
  }
  const double length = line_length(section);
  if (length == 0) return {0, p.k};
  const double along = ((p.i - section.from.i) * (section.to.i - section.from.i) +
                        (p.j - section.from.j) * (section.to.j - section.from.j)) /
                       length;
  return {along, p.k};
}

survey::IndexPoint index_of(const Section& section, const PlanePoint& p) {
  const auto index = static_cast<double>(section.index);
  switch (section.kind) {
    case Section::Kind::kInline:
      return {index, p.u, p.v};
    case Section::Kind::kCrossline:
      return {p.u, index, p.v};
    case Section::Kind::kSlice:
      return {p.v, p.u, index};
    case Section::Kind::kLine:
      break;
  }
  const double length = line_length(section);
  const double part = length == 0 ? 0 : p.u / length;
  return {section.from.i + part * (section.to.i - section.from.i),
          section.from.j + part * (section.to.j - section.from.j), p.v};
}

double distance_from(const Section& section, const survey::IndexPoint& p) {
  const auto index = static_cast<double>(section.index);
  switch (section.kind) {
    case Section::Kind::kInline:
      return p.i - index;
    case Section::Kind::kCrossline:
      return p.j - index;
    case Section::Kind::kSlice:
      return p.k - index;
    case Section::Kind::kLine:
      break;
  }
  const double length = line_length(section);
  if (length == 0) return std::hypot(p.i - section.from.i, p.j - section.from.j);
  return ((p.i - section.from.i) * (section.to.j - section.from.j) -
          (p.j - section.from.j) * (section.to.i - section.from.i)) /
         length;
}

PlaneSize size_of(const Section& section, const survey::Geometry& survey) {
  const survey::Index dims = survey.dims();
  const auto inlines = static_cast<double>(dims[0]);
  const auto crosslines = static_cast<double>(dims[1]);
  const auto samples = static_cast<double>(dims[2]);
  switch (section.kind) {
    case Section::Kind::kInline:
      return {crosslines, samples};
    case Section::Kind::kCrossline:
      return {inlines, samples};
    case Section::Kind::kSlice:
      return {crosslines, inlines};
    case Section::Kind::kLine:
      break;
  }
  return {std::floor(line_length(section)) + 1, samples};
}

}  // namespace footwall::ui
