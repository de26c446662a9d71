#include "ui/model/display.h"

#include <QJsonArray>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "storage/base/log.h"

namespace footwall::ui {
namespace {

constexpr std::array<std::pair<const char*, Section::Kind>, 4> kKinds{
    {{"inline", Section::Kind::kInline},
     {"crossline", Section::Kind::kCrossline},
     {"slice", Section::Kind::kSlice},
     {"line", Section::Kind::kLine}}};
constexpr std::array<std::pair<const char*, FaceColours>, 3> kColours{{{"statistic", FaceColours::kStatistic},
                                                                       {"voxels", FaceColours::kVoxels},
                                                                       {"plain", FaceColours::kPlain}}};

template <class Table, class Value>
QString word_of(const Table& table, Value value) {
  for (const auto& [word, entry] : table) {
    if (entry == value) return QString::fromLatin1(word);
  }
  return {};
}

template <class Table, class Value>
Value from_word(const Table& table, const QJsonValue& json, Value otherwise) {
  for (const auto& [word, entry] : table) {
    if (json.toString() == QLatin1String(word)) return entry;
  }
  return otherwise;
}

double number(const QJsonValue& json, double low, double high, double otherwise) {
  const double value = json.toDouble(otherwise);
  return std::isfinite(value) ? std::clamp(value, low, high) : otherwise;
}

constexpr double kFar = 1 << 23;
constexpr int kMostLines = 100000;

QJsonArray json_of(const survey::IndexPoint& p) {
  return {p.i, p.j};
}

survey::IndexPoint point_from(const QJsonValue& json) {
  const QJsonArray array = json.toArray();
  return {number(array.at(0), -kFar, kFar, 0), number(array.at(1), -kFar, kFar, 0), 0};
}

QJsonObject json_of(const Display::ShownSection& shown) {
  return {{"kind", word_of(kKinds, shown.section.kind)},
          {"index", static_cast<double>(shown.section.index)},
          {"from", json_of(shown.section.from)},
          {"to", json_of(shown.section.to)},
          {"in_scene", shown.in_scene},
          {"linked", shown.linked}};
}

QJsonObject json_of(const IsosurfaceLook& look) {
  return {{"volume", static_cast<double>(look.volume)},
          {"value", look.value},
          {"colour", look.colour},
          {"as_picture", look.as_picture},
          {"visible", look.visible},
          {"name", look.name}};
}

QJsonObject json_of(const SampleLook& look) {
  QJsonObject json{{"colour_map", look.colour_map},
                   {"clip_percentile", look.clip_percentile},
                   {"gain", look.gain},
                   {"wiggle", look.wiggle}};
  if (look.interpolate) json["interpolate"] = *look.interpolate;
  return json;
}

// What the JSON does not say, or says wrongly, stays as it is.
SampleLook look_from(const QJsonObject& json, SampleLook look) {
  look.colour_map = json["colour_map"].toString(look.colour_map);
  look.clip_percentile = number(json["clip_percentile"], 50, 100, look.clip_percentile);
  look.gain = number(json["gain"], 1e-3, 1e3, look.gain);
  look.wiggle = json["wiggle"].toBool(look.wiggle);
  look.interpolate.reset();
  if (json["interpolate"].isBool()) look.interpolate = json["interpolate"].toBool();
  return look;
}

}  // namespace

Display::Display(Document& document, QObject* parent) : QObject(parent), document_(document) {
  if (!document_.volumes().empty()) take_volume(document_.volumes().front().id);
  connect(&document_, &Document::volumes_changed, this, [this] {
    const auto& volumes = document_.volumes();
    const bool here = std::ranges::find(volumes, volume_, &project::VolumeRecord::id) != volumes.end();
    if (!here) set_volume(volumes.empty() ? 0 : volumes.front().id);
  });
  connect(&document_, &Document::runs_changed, this, [this] {
    if (!has_run(faces_.run)) show_run(0);
  });
}

SampleLook Display::first_look(Id volume) const {
  const auto& volumes = document_.volumes();
  const auto found = std::ranges::find(volumes, volume, &project::VolumeRecord::id);
  SampleLook look;
  // A grey scale tells signed samples from one another; what has no sign has an even one.
  if (found != volumes.end() && found->role == "discontinuity") look.colour_map = QStringLiteral("viridis");
  return look;
}

void Display::take_volume(Id volume) {
  looks_[volume_] = samples_;
  volume_ = volume;
  const auto known = looks_.find(volume);
  samples_ = known != looks_.end() ? known->second : first_look(volume);
}

void Display::set_volume(Id volume) {
  if (volume == volume_) return;
  take_volume(volume);
  Q_EMIT samples_changed();
  Q_EMIT changed();
}

void Display::set_samples(const SampleLook& look) {
  if (look == samples_) return;
  samples_ = look;
  Q_EMIT samples_changed();
  Q_EMIT changed();
}

void Display::set_faces(const FaceLook& look) {
  if (look == faces_) return;
  faces_ = look;
  Q_EMIT faces_changed();
  Q_EMIT changed();
}

void Display::show_run(Id run) {
  FaceLook look = faces_;
  look.run = run;
  if (run != 0) look.colours = FaceColours::kStatistic;
  set_faces(look);
}

bool Display::has_run(Id run) const {
  if (run == 0) return false;
  try {
    const auto runs = document_.project().runs();
    return std::ranges::find(runs, run, &project::RunRecord::id) != runs.end();
  } catch (const Error& error) {
    log::warn("the runs cannot be listed: " + error.message());
    return false;
  }
}

void Display::set_visible(const Item& item, bool visible) {
  if (is_visible(item) == visible) return;
  if (visible) {
    hidden_.erase({item.kind, item.id});
  } else {
    hidden_.insert({item.kind, item.id});
  }
  Q_EMIT visibility_changed();
  Q_EMIT changed();
}

Id Display::add_isosurface(Id volume, double value) {
  isosurfaces_.push_back({.id = ++last_id_, .volume = volume, .value = value});
  Q_EMIT isosurfaces_changed();
  Q_EMIT changed();
  return last_id_;
}

void Display::change_isosurface(const IsosurfaceLook& look) {
  const auto found = std::ranges::find(isosurfaces_, look.id, &IsosurfaceLook::id);
  if (found == isosurfaces_.end() || *found == look) return;
  *found = look;
  Q_EMIT isosurfaces_changed();
  Q_EMIT changed();
}

void Display::remove_isosurface(Id id) {
  if (std::erase_if(isosurfaces_, [id](const IsosurfaceLook& look) { return look.id == id; }) == 0) return;
  Q_EMIT isosurfaces_changed();
  Q_EMIT changed();
}

void Display::put_back_isosurface(const IsosurfaceLook& look) {
  const auto place =
      std::ranges::find_if(isosurfaces_, [&](const IsosurfaceLook& other) { return other.id >= look.id; });
  if (place != isosurfaces_.end() && place->id == look.id) return;
  isosurfaces_.insert(place, look);
  last_id_ = std::max(last_id_, look.id);
  Q_EMIT isosurfaces_changed();
  Q_EMIT changed();
}

Id Display::add_section(const Section& section) {
  sections_.push_back({.id = ++last_id_, .section = section});
  Q_EMIT sections_changed();
  Q_EMIT changed();
  return last_id_;
}

void Display::move_section(Id id, const Section& section) {
  const auto found = std::ranges::find(sections_, id, &ShownSection::id);
  if (found == sections_.end()) return;
  ShownSection moved = *found;
  moved.section = section;
  change_section(moved);
}

void Display::change_section(const ShownSection& section) {
  const auto found = std::ranges::find(sections_, section.id, &ShownSection::id);
  if (found == sections_.end() || *found == section) return;
  *found = section;
  Q_EMIT sections_changed();
  Q_EMIT changed();
}

void Display::remove_section(Id id) {
  if (std::erase_if(sections_, [id](const ShownSection& shown) { return shown.id == id; }) == 0) return;
  Q_EMIT sections_changed();
  Q_EMIT changed();
}

void Display::set_own_step(std::optional<int> lines) {
  if (lines) lines = std::clamp(*lines, 1, kMostLines);
  if (std::exchange(own_step_, lines) == lines) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::set_steps_after_pillar(bool on) {
  if (std::exchange(steps_after_pillar_, on) == on) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::set_snapping(bool to_section, bool to_samples) {
  const bool section_same = std::exchange(snaps_to_section_, to_section) == to_section;
  const bool samples_same = std::exchange(snaps_to_samples_, to_samples) == to_samples;
  if (section_same && samples_same) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::set_fade_distance(double voxels) {
  if (std::exchange(fade_distance_, std::max(0.0, voxels)) == fade_distance_) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::set_exaggeration(double factor) {
  if (std::exchange(exaggeration_, std::clamp(factor, 0.01, 1000.0)) == exaggeration_) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::set_perspective(bool on) {
  if (std::exchange(perspective_, on) == on) return;
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

void Display::show_place(const survey::IndexPoint& place, double reach) {
  set_cursor(place);
  Q_EMIT place_shown(place, reach);
}

void Display::set_cursor(const std::optional<survey::IndexPoint>& place) {
  if (std::exchange(cursor_, place) == place) return;
  Q_EMIT cursor_moved();
}

QJsonObject Display::to_json() const {
  QJsonArray sections, isosurfaces, hidden;
  for (const ShownSection& shown : sections_) sections.append(json_of(shown));
  for (const IsosurfaceLook& look : isosurfaces_) isosurfaces.append(json_of(look));
  for (const auto& [kind, id] : hidden_)
    hidden.append(QJsonArray{static_cast<int>(kind), static_cast<double>(id)});
  QJsonObject faces{{"colours", word_of(kColours, faces_.colours)},
                    {"statistic", faces_.statistic},
                    {"colour_map", faces_.colour_map},
                    {"edges", faces_.edges}};
  if (faces_.run != 0) faces["run"] = static_cast<double>(faces_.run);
  if (faces_.low) faces["low"] = *faces_.low;
  if (faces_.high) faces["high"] = *faces_.high;
  QJsonObject looks;
  for (const auto& [volume, look] : looks_) {
    const auto& volumes = document_.volumes();
    if (volume != volume_ && std::ranges::find(volumes, volume, &project::VolumeRecord::id) != volumes.end())
      looks[QString::number(volume)] = json_of(look);
  }
  QJsonObject all{{"volume", static_cast<double>(volume_)},
                  {"samples", json_of(samples_)},
                  {"other_samples", looks},
                  {"faces", faces},
                  {"sections", sections},
                  {"isosurfaces", isosurfaces},
                  {"hidden", hidden},
                  {"steps_after_pillar", steps_after_pillar_},
                  {"snaps_to_section", snaps_to_section_},
                  {"snaps_to_samples", snaps_to_samples_},
                  {"fade_distance", fade_distance_},
                  {"exaggeration", exaggeration_},
                  {"perspective", perspective_}};
  if (own_step_) all["own_step"] = *own_step_;
  return all;
}

void Display::from_json(const QJsonObject& json) {
  const auto& volumes = document_.volumes();
  const Id volume = static_cast<Id>(number(json["volume"], 0, 1e15, 0));
  if (std::ranges::find(volumes, volume, &project::VolumeRecord::id) != volumes.end()) take_volume(volume);
  const QJsonObject looks = json["other_samples"].toObject();
  for (auto look = looks.begin(); look != looks.end(); ++look) {
    const Id of = look.key().toLongLong();
    looks_[of] = look_from(look.value().toObject(), first_look(of));
  }
  samples_ = look_from(json["samples"].toObject(), samples_);
  const QJsonObject faces = json["faces"].toObject();
  faces_.colours = from_word(kColours, faces["colours"], faces_.colours);
  faces_.statistic = faces["statistic"].toString(faces_.statistic);
  faces_.colour_map = faces["colour_map"].toString(faces_.colour_map);
  faces_.edges = faces["edges"].toBool(faces_.edges);
  const Id run = static_cast<Id>(number(faces["run"], 0, 1e15, 0));
  faces_.run = has_run(run) ? run : 0;
  faces_.low.reset();
  faces_.high.reset();
  if (faces["low"].isDouble()) faces_.low = faces["low"].toDouble();
  if (faces["high"].isDouble()) faces_.high = faces["high"].toDouble();
  hidden_.clear();
  for (const auto& entry : json["hidden"].toArray()) {
    const QJsonArray pair = entry.toArray();
    hidden_.insert({static_cast<Item::Kind>(pair.at(0).toInt()), static_cast<Id>(pair.at(1).toDouble())});
  }
  isosurfaces_.clear();
  for (const auto& entry : json["isosurfaces"].toArray()) {
    const QJsonObject look = entry.toObject();
    isosurfaces_.push_back({.id = ++last_id_,
                            .volume = static_cast<Id>(look["volume"].toDouble()),
                            .value = number(look["value"], -3e38, 3e38, 0),
                            .colour = look["colour"].toString(),
                            .as_picture = look["as_picture"].toBool(true),
                            .visible = look["visible"].toBool(true),
                            .name = look["name"].toString()});
  }
  sections_.clear();
  for (const auto& entry : json["sections"].toArray()) {
    const QJsonObject one = entry.toObject();
    Section section{.kind = from_word(kKinds, one["kind"], Section::Kind::kInline),
                    .index = static_cast<std::int64_t>(number(one["index"], 0, kFar, 0)),
                    .from = point_from(one["from"]),
                    .to = point_from(one["to"])};
    if (document_.survey()) section = stepped(section, 0, *document_.survey());
    sections_.push_back({.id = ++last_id_,
                         .section = section,
                         .in_scene = one["in_scene"].toBool(true),
                         .linked = one["linked"].toBool(true)});
  }
  own_step_.reset();
  if (json["own_step"].isDouble()) own_step_ = static_cast<int>(number(json["own_step"], 1, kMostLines, 1));
  steps_after_pillar_ = json["steps_after_pillar"].toBool(steps_after_pillar_);
  snaps_to_section_ = json["snaps_to_section"].toBool(snaps_to_section_);
  snaps_to_samples_ = json["snaps_to_samples"].toBool(snaps_to_samples_);
  fade_distance_ = number(json["fade_distance"], 0, 1e6, fade_distance_);
  exaggeration_ = number(json["exaggeration"], 0.01, 1000, exaggeration_);
  perspective_ = json["perspective"].toBool(perspective_);
  Q_EMIT samples_changed();
  Q_EMIT faces_changed();
  Q_EMIT visibility_changed();
  Q_EMIT isosurfaces_changed();
  Q_EMIT sections_changed();
  Q_EMIT scene_changed();
  Q_EMIT changed();
}

}  // namespace footwall::ui
