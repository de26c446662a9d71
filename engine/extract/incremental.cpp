#include "engine/extract/incremental.h"

#include <omp.h>

#include <fmt/format.h>
#include <algorithm>
#include <unordered_map>

#include "engine/extract/balance/area.h"
#include "engine/extract/loaded_survey.h"
#include "engine/extract/report.h"
#include "engine/extract/statistics/wide_integer.h"
#include "storage/base/hash.h"

namespace footwall::extract {
namespace {

constexpr int kFree = -1;
constexpr int kDirty = -1;  // to BalanceInput: deal this one out

struct HashOf {
  std::size_t operator()(const FaceIdentity& id) const {
    const std::array<std::int64_t, 3> words{id.fault, id.owner, id.n};
    return hash64(std::as_bytes(std::span(words)));
  }
};

Error refused(const FaceIdentity& id, std::string_view why) {
  return Error(ErrorCode::kInvalid, fmt::format("face {} of fault {}, {}: {}", id.n, id.fault, id.owner, why),
               "bring the faces up to date from the model and extract again");
}

}  // namespace

struct Incremental::State {
  State(LoadedSurvey& its_survey, double its_max_abs, const Options& options)
      : survey(*its_survey.state_),
        max_abs(its_max_abs),
        plan(plan_of(options, its_max_abs)),
        loads(static_cast<std::size_t>(survey.world.size()), 0) {}

  LoadedSurvey::State& survey;
  double max_abs;
  Plan plan;

  // By place.
  std::vector<Face> faces;  // of a free place: a point, which weighs nothing
  std::vector<int> responsible;
  std::vector<FaceStatistics> statistics;  // at rank 0
  std::vector<std::uint64_t> listed;       // the last update that named the place
  std::vector<Place> free;                 // the last one is taken first
  std::unordered_map<FaceIdentity, Place, HashOf> places;
  std::uint64_t updates = 0;
  std::vector<Int128> loads;  // of each rank: the areas of its faces

  // Of the current update.
  std::vector<Face> dirty;       // added, then changed
  std::vector<int> dirty_ranks;  // of dirty
  Ran ran;
  Update update;

  Place find(const FaceIdentity& id) {
    const auto found = places.find(id);
    if (found == places.end()) throw refused(id, "there is no such face");
    if (listed[found->second] == updates) throw refused(id, "it stands twice in the changes");
    listed[found->second] = updates;
    return found->second;
  }
  void look_up(const FaceChanges& changes);
  void balance();
  void commit(const FaceChanges& changes);
  void fill(const Tally& all);
};

// Checks the changes and finds the places of all faces in them; nothing is changed that a failure would have
// to undo.
void Incremental::State::look_up(const FaceChanges& changes) {
  ++updates;
  update.places.clear();
  update.freed.clear();
  for (const FaceIdentity& id : changes.removed) update.freed.push_back(find(id));
  std::size_t fresh = 0;
  for (std::size_t n = 0; n < changes.added.size(); ++n) {
    const FaceIdentity id = identity_of(changes.added[n]);
    if (places.contains(id)) throw refused(id, "it is there already");
    // Removed ones first become free with this update, so that they are not taken again by it.
    update.places.push_back(fresh < free.size() ? free[free.size() - 1 - fresh]
                                                : static_cast<Place>(faces.size() + fresh - free.size()));
    ++fresh;
  }
  std::vector<FaceIdentity> ids;
  if (!std::is_sorted(changes.added.begin(), changes.added.end(),
                      [](const Face& a, const Face& b) { return identity_of(a) < identity_of(b); })) {
    for (const Face& face : changes.added) ids.push_back(identity_of(face));
    std::sort(ids.begin(), ids.end());
  }
  for (std::size_t n = 1; n < changes.added.size(); ++n) {
    const FaceIdentity id = ids.empty() ? identity_of(changes.added[n]) : ids[n];
    const FaceIdentity before = ids.empty() ? identity_of(changes.added[n - 1]) : ids[n - 1];
    if (id == before) throw refused(id, "it stands twice in the changes");
  }
  for (const Face& face : changes.changed) update.places.push_back(find(identity_of(face)));
  dirty.assign(changes.added.begin(), changes.added.end());
  dirty.insert(dirty.end(), changes.changed.begin(), changes.changed.end());
}

// The responsible ranks of the dirty faces.
void Incremental::State::balance() {
  // Looks at nothing but the face itself; "auto" does the same here.
  if (plan.balancer->run == balance_strategy("none").run) {
    dirty_ranks = plan.balancer->run(survey.to_balance(plan, dirty, {}));
    return;
  }
  const std::size_t limit = std::max<std::size_t>(
      faces.size(),
      update.places.empty() ? 0 : *std::max_element(update.places.begin(), update.places.end()) + 1);
  std::vector<Face> all = faces;
  std::vector<int> previous = responsible;
  all.resize(limit);
  previous.resize(limit, kFree);
  for (const Place place : update.freed) {
    all[place] = {};
    previous[place] = kFree;
  }
  std::replace(previous.begin(), previous.end(), kFree, 0);  // a point of any rank is no load
  for (std::size_t n = 0; n < dirty.size(); ++n) {
    all[update.places[n]] = dirty[n];
    previous[update.places[n]] = kDirty;
  }
  const std::vector<int> ranks = plan.balancer->run(survey.to_balance(plan, all, previous));
  dirty_ranks.clear();
  for (const Place place : update.places) dirty_ranks.push_back(ranks[place]);
}

void Incremental::State::commit(const FaceChanges& changes) {
  const auto load = [&](Place place) -> Int128& {
    return loads[static_cast<std::size_t>(responsible[place])];
  };
  for (std::size_t n = 0; n < update.freed.size(); ++n) {
    const Place place = update.freed[n];
    load(place) -= fixed_area(faces[place].triangle);
    faces[place] = {};
    responsible[place] = kFree;
    places.erase(changes.removed[n]);
  }
  for (std::size_t n = 0; n < update.places.size(); ++n) {
    const Place place = update.places[n];
    if (n < changes.added.size()) {
      if (place < faces.size()) {
        free.pop_back();
      } else {
        faces.emplace_back();
        responsible.push_back(kFree);
        listed.push_back(updates);
        if (survey.world.rank() == 0) statistics.emplace_back();
      }
      places.emplace(identity_of(dirty[n]), place);
    } else {
      load(place) -= fixed_area(faces[place].triangle);
    }
    faces[place] = dirty[n];
    responsible[place] = dirty_ranks[n];
    load(place) += fixed_area(faces[place].triangle);
    if (survey.world.rank() == 0) statistics[place] = ran.faces[n];
  }
  free.insert(free.end(), update.freed.begin(), update.freed.end());
}

void Incremental::State::fill(const Tally& all) {
  Report& report = update.report;
  report = {};
  fill_report(all, survey.world.size(), report);
  report.exchange = name_of_exchange(plan);
  report.balance = plan.options.balance;
  report.threads = plan.options.threads;
  report.faces = static_cast<std::int64_t>(dirty.size());
  report.walked_here = ran.outcome.walked;
  report.loads.resize(loads.size());
  std::transform(loads.begin(), loads.end(), report.loads.begin(), [](Int128 load) {
    return static_cast<FixedArea>(std::min<Int128>(load, std::numeric_limits<FixedArea>::max()));
  });
  report.load_deviation = load_deviation(report.loads);
}

namespace {

// The sign of a fault's offsets hangs on all of its faces.
void refuse_offset(const Options& options) {
  if (!asks_for(options, "offset")) return;
  throw Error(ErrorCode::kUnsupported, "offset is not computed by an extraction of changed faces alone",
              "extract all faces, or leave offset out of the computations");
}

}  // namespace

Incremental::Incremental(LoadedSurvey& survey, double max_abs, Options options)
    : state_(std::make_unique<State>(survey, max_abs, options)) {
  refuse_offset(options);
}
Incremental::~Incremental() = default;

const Update& Incremental::update(const FaceChanges& changes, const JobContext& job) {
  State& s = *state_;
  const double start = omp_get_wtime();
  s.look_up(changes);
  s.balance();
  s.survey.gather.prepare(s.survey.world, s.dirty_ranks, s.ran.faces);
  const double balanced = omp_get_wtime();

  // 2 voxelize, 3 exchange, 4 compute, of the dirty faces alone; the results at rank 0
  const Input input{s.survey.grid.dims(), s.max_abs, s.dirty};
  run_exchange(s.survey, s.plan, input, s.dirty_ranks, job, s.ran);
  if (!s.plan.whole_face.empty()) {
    s.survey.world.agree(s.ran.outcome.failure);
    s.update.blobs =
        gather_blobs(s.survey.world, std::move(s.ran.outcome.blobs), s.plan.whole_face, s.dirty.size());
  }

  Tally mine = tally_of(s.ran);
  Seconds& seconds = s.ran.outcome.seconds;
  seconds.balance = balanced - start;
  seconds.total = omp_get_wtime() - start;
  mine.set(seconds);
  const Tally all = together(s.survey.world, mine, s.ran.outcome.failure);

  s.commit(changes);
  s.update.statistics.assign(s.ran.faces.begin(), s.ran.faces.end());
  s.fill(all);
  return s.update;
}

std::size_t Incremental::size() const {
  return state_->places.size();
}

Place Incremental::place_limit() const {
  return static_cast<Place>(state_->faces.size());
}

std::optional<Place> Incremental::place_of(const FaceIdentity& identity) const {
  const auto found = state_->places.find(identity);
  return found == state_->places.end() ? std::nullopt : std::optional(found->second);
}

const Face* Incremental::face(Place place) const {
  return responsible(place) == kFree ? nullptr : &state_->faces[place];
}

int Incremental::responsible(Place place) const {
  return state_->responsible.at(place);
}

const FaceStatistics& Incremental::statistics(Place place) const {
  require(responsible(place) != kFree && state_->survey.world.rank() == 0,
          "the numbers of a face, at rank 0");
  return state_->statistics[place];
}

std::vector<Place> Incremental::by_identity() const {
  std::vector<Place> order;
  order.reserve(size());
  for (Place place = 0; place < place_limit(); ++place) {
    if (state_->responsible[place] != kFree) order.push_back(place);
  }
  std::sort(order.begin(), order.end(),
            [&](Place a, Place b) { return identity_of(state_->faces[a]) < identity_of(state_->faces[b]); });
  return order;
}

std::vector<Face> Incremental::faces() const {
  std::vector<Face> faces;
  for (const Place place : by_identity()) faces.push_back(state_->faces[place]);
  return faces;
}

std::vector<FaceStatistics> Incremental::all_statistics() const {
  std::vector<FaceStatistics> all;
  if (state_->survey.world.rank() != 0) return all;
  for (const Place place : by_identity()) all.push_back(state_->statistics[place]);
  return all;
}

}  // namespace footwall::extract
