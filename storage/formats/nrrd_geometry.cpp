#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "storage/base/error.h"
#include "storage/base/text.h"
#include "storage/formats/missing_options.h"
#include "storage/formats/nrrd.h"
#include "storage/survey/units.h"

namespace footwall::formats::nrrd {
namespace {

// Lengths in metres, times in milliseconds; 0 for what is neither.
struct Unit {
  double metres = 0;
  double milliseconds = 0;
};

Unit unit_from(std::string_view name) {
  if (name == "m" || name == "metre" || name == "meter") return {1, 0};
  if (name == "km") return {1000, 0};
  if (name == "cm") return {0.01, 0};
  if (name == "mm" || name == "millimeter" || name == "millimetre") return {0.001, 0};
  if (name == "ft" || name == "feet" || name == "foot") return {survey::kMetresPerFoot, 0};
  if (name == "ms") return {0, 1};
  if (name == "s") return {0, 1000};
  if (name == "us") return {0, 0.001};
  return {};
}

double metres_of(survey::VerticalUnit unit) {
  return unit == survey::VerticalUnit::kFoot ? survey::kMetresPerFoot : 1;
}

[[noreturn]] void contradiction(const std::string& option, const std::string& given,
                                const std::string& stated) {
  throw Error(ErrorCode::kInvalid, fmt::format("{} is {}, the file says {}", option, given, stated),
              "leave the option out, or mend the file's header");
}

class Placing {
 public:
  Placing(const Header& header, const raw::AxisOrder& order, const Meaning& meaning)
      : header_(header), meaning_(meaning) {
    for (std::size_t n = 0; n < 3; ++n) {
      axes_[static_cast<std::size_t>(order[2 - n])] = &header.axes[n];
    }
    geometry_.inlines.count = axes_[0]->size;
    geometry_.crosslines.count = axes_[1]->size;
    geometry_.samples = axes_[2]->size;
  }

  Placed place() {
    set_domain();
    set_lines();
    const bool whole = space_is_usable();
    if (whole) {
      place_in_space();
    } else {
      place_by_spacings();
    }
    if (meaning_.interval) {
      if (interval_stated_ && std::abs(*meaning_.interval - geometry_.interval) > 1e-6 * geometry_.interval) {
        contradiction("--interval", fmt::format("{}", *meaning_.interval),
                      fmt::format("{}", geometry_.interval));
      }
      geometry_.interval = *meaning_.interval;
    } else if (!interval_stated_) {
      assume(fmt::format("the sample interval is 1 {}: the file has no spacing",
                         name_of(geometry_.vertical_unit)));
    }
    geometry_.crs = meaning_.crs.empty() ? key("crs") : meaning_.crs;
    for (const std::string& note : header_.notes) assume(note);
    geometry_.validate();
    return {geometry_, whole && !header_.space_origin.empty(), interval_stated_};
  }

 private:
  void assume(const std::string& what) { geometry_.assumed.push_back(what); }
  std::string key(const std::string& name) const {
    const auto found = header_.keys.find("footwall " + name);
    return found == header_.keys.end() ? std::string() : found->second;
  }

  // The vertical axis' unit as the header has it.
  std::string vertical_text() const {
    if (!axes_[2]->unit.empty()) return axes_[2]->unit;
    if (header_.space_units.size() == 3) return header_.space_units[2];
    return {};
  }

  void set_domain() {
    const std::string text = vertical_text();
    const Unit stated = unit_from(text);
    std::optional<survey::Domain> domain;
    std::optional<survey::VerticalUnit> unit;
    if (stated.milliseconds > 0) {
      domain = survey::Domain::kTime;
      unit = survey::VerticalUnit::kMillisecond;
    } else if (text == "m" || text == "ft") {
      domain = survey::Domain::kDepth;
      unit = survey::vertical_unit_from(text);
    } else if (stated.metres > 0) {
      domain = survey::Domain::kDepth;  // in which unit it is to be kept is not said
    }
    if (meaning_.domain && domain && *meaning_.domain != *domain) {
      contradiction("--domain", std::string(name_of(*meaning_.domain)), fmt::format("z is in {}", text));
    }
    if (meaning_.vertical_unit && unit && *meaning_.vertical_unit != *unit) {
      contradiction("--vertical-unit", std::string(name_of(*meaning_.vertical_unit)), text);
    }
    if (meaning_.domain) domain = meaning_.domain;
    if (meaning_.vertical_unit) unit = meaning_.vertical_unit;
    if (!domain) domain = meaning_.domain_otherwise;
    if (!unit) unit = meaning_.unit_otherwise;
    std::vector<MissingOption> missing;
    if (!domain) missing.push_back(kMissingDomain);
    if (!unit) missing.push_back(kMissingUnit);
    refuse_missing(missing);
    if ((*domain == survey::Domain::kTime) != (*unit == survey::VerticalUnit::kMillisecond)) {
      throw Error(
          ErrorCode::kUsage,
          fmt::format("domain {} does not go with vertical unit {}", name_of(*domain), name_of(*unit)),
          "time is in ms, depth in m or ft");
    }
    geometry_.domain = *domain;
    geometry_.vertical_unit = *unit;
    if (stated.milliseconds > 0) {
      vertical_scale_ = stated.milliseconds;
    } else if (stated.metres > 0) {
      vertical_scale_ = stated.metres / metres_of(*unit);
    } else if (axes_[2]->stated()) {
      assume(fmt::format("z is in {}: the file does not say", name_of(*unit)));
    }
  }

  // "first step": what NRRD itself cannot say.
  void set_lines() {
    const auto read = [&](const std::string& name, survey::LineAxis& axis) {
      const std::string kept = key(name);
      const auto parts = text::words(kept);
      const auto first = parts.size() == 2 ? text::integer(parts[0]) : std::nullopt;
      const auto step = parts.size() == 2 ? text::integer(parts[1]) : std::nullopt;
      constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
      if (!first || !step || *step < 1 || *step > kMost || *first < -kMost - 1 || *first > kMost) {
        assume(fmt::format("{} are numbered from 1", name));
        return;
      }
      axis.first = static_cast<std::int32_t>(*first);
      axis.step = static_cast<std::int32_t>(*step);
    };
    read("inlines", geometry_.inlines);
    read("crosslines", geometry_.crosslines);
  }

  // The scale to the unit of X and Y, which is set.
  double horizontal_scale(const std::string& unit) {
    if (unit == "ft") {
      geometry_.horizontal_unit = "ft";
      return 1;
    }
    const double metres = unit_from(unit).metres;
    if (metres > 0) return metres;
    assume("X and Y are in metres: the file does not say");
    return 1;
  }

  // Directions for all three axes, in a space of three, with level lines and plumb traces.
  bool space_is_usable() {
    bool any = false;
    for (const Axis* axis : axes_) any = any || !axis->direction.empty();
    if (!any) return false;
    double level = 0;
    double tilt = 0;
    bool whole = header_.space_origin.empty() || header_.space_origin.size() == 3;
    for (std::size_t axis = 0; axis < 3 && whole; ++axis) {
      const std::vector<double>& d = axes_[axis]->direction;
      whole = d.size() == 3;
      if (!whole) break;
      const double flat = std::hypot(d[0], d[1]);
      whole = std::isfinite(flat) && std::isfinite(d[2]) && std::hypot(flat, d[2]) > 0;
      level += axis == 2 ? std::abs(d[2]) : flat;
      tilt = std::max(tilt, axis == 2 ? flat : std::abs(d[2]));
    }
    for (const double value : header_.space_origin) whole = whole && std::isfinite(value);
    if (whole && tilt <= 1e-6 * level) return true;
    assume("the file's directions are not of level lines and upright traces: only their lengths are used");
    return false;
  }

  void place_in_space() {
    const std::string unit = header_.space_units.size() == 3 ? header_.space_units[0] : std::string();
    const double scale = horizontal_scale(unit);
    const auto& i = axes_[0]->direction;
    const auto& j = axes_[1]->direction;
    const auto& k = axes_[2]->direction;
    const std::vector<double> origin =
        header_.space_origin.empty() ? std::vector<double>{0, 0, 0} : header_.space_origin;
    if (header_.space_origin.empty()) assume("the first sample is at X 0, Y 0, z 0: the file has no origin");
    geometry_.map = {origin[0] * scale, origin[1] * scale, i[0] * scale,
                     i[1] * scale,      j[0] * scale,      j[1] * scale};
    const double sign = k[2] < 0 ? -1 : 1;
    geometry_.interval = std::abs(k[2]) * vertical_scale_;
    geometry_.z0 = sign * origin[2] * vertical_scale_;
    interval_stated_ = true;
    if (sign < 0) {
      assume("z of the file is elevation, since it falls along the traces: its sign is turned");
    } else if (key("z") != "down") {
      assume("z of the file is positive down, since it grows along the traces");
    }
  }

  double length_of(const Axis& axis) const {
    if (!axis.direction.empty()) {
      double sum = 0;
      for (const double part : axis.direction) sum += part * part;
      return std::sqrt(sum);
    }
    return std::abs(axis.spacing);
  }

  void place_by_spacings() {
    std::string unit = axes_[0]->unit.empty() ? axes_[1]->unit : axes_[0]->unit;
    if (unit.empty() && header_.space_units.size() == 3) unit = header_.space_units[0];
    const double scale = horizontal_scale(unit);
    const auto bin = [&](const Axis& axis, std::string_view what) {
      const double length = length_of(axis) * scale;
      if (std::isfinite(length) && length > 0) return length;
      assume(fmt::format("{} are 1 {} apart: the file has no spacing", what, geometry_.horizontal_unit));
      return 1.0;
    };
    geometry_.map = {0, 0, 0, bin(*axes_[0], "inlines"), bin(*axes_[1], "crosslines"), 0};
    assume("X grows with the crosslines, Y with the inlines, both from 0");
    const double interval = length_of(*axes_[2]) * vertical_scale_;
    interval_stated_ = std::isfinite(interval) && interval > 0;
    if (interval_stated_) geometry_.interval = interval;
    if (std::isfinite(axes_[2]->min)) {
      geometry_.z0 = axes_[2]->min * vertical_scale_;
      assume("z grows along the traces, positive down");
    } else {
      assume("the first sample is at z 0, z is positive down");
    }
  }

  const Header& header_;
  const Meaning& meaning_;
  std::array<const Axis*, 3> axes_{};  // by survey axis
  survey::Geometry geometry_;
  double vertical_scale_ = 1;  // to the survey's vertical unit
  bool interval_stated_ = false;
};

}  // namespace

Placed geometry_of(const Header& header, const raw::AxisOrder& order, const Meaning& meaning) {
  return Placing(header, order, meaning).place();
}

}  // namespace footwall::formats::nrrd
