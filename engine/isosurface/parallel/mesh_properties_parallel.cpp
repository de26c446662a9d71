#include <mpi.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <type_traits>

#include "engine/isosurface/edges.h"
#include "engine/isosurface/parallel/mesh_properties.h"

namespace footwall::isosurface {
namespace {

template <class T>
void append(comm::Bytes& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* const from = reinterpret_cast<const std::byte*>(&value);
  bytes.insert(bytes.end(), from, from + sizeof value);
}

template <class T, class Visit>
void each_of(const std::vector<comm::Bytes>& messages, const Visit& visit) {
  for (const comm::Bytes& message : messages) {
    for (std::size_t at = 0; at < message.size(); at += sizeof(T)) {
      T value;
      std::memcpy(&value, message.data() + at, sizeof value);
      visit(value);
    }
  }
}

std::vector<comm::Bytes> no_messages(const comm::Communicator& world) {
  return std::vector<comm::Bytes>(static_cast<std::size_t>(world.size()));
}

// Sets that grow together; each is named by its smallest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t member) {
    while (parent_[member] != member) member = parent_[member] = parent_[parent_[member]];
    return member;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

// A component of one rank's part, as told to rank 0.
struct LocalComponent {
  std::uint32_t label = 0;  // counted through all ranks
  std::uint32_t first = 0;  // the smallest number of its vertices
};
struct Joint {
  std::uint32_t a = 0;  // labels that are one component
  std::uint32_t b = 0;
  friend auto operator<=>(const Joint&, const Joint&) = default;
};

// An edge that other ranks may have triangles at, too, as told to the owner of its lower vertex.
struct SharedEdge {
  std::uint32_t a = 0;  // numbers in the whole mesh, a < b
  std::uint32_t b = 0;
  std::uint32_t up = 0;
  std::uint32_t down = 0;
  std::uint32_t component = 0;
  std::uint32_t at_border = 0;
};

struct ToldTally {
  std::uint32_t component = 0;
  ComponentTally tally;
};

class Counting {
 public:
  Counting(comm::Communicator& world, const MeshPart& part, const Measure& measure)
      : world_(world), part_(part), measure_(measure) {}

  MeshProperties run() {
    // 1. Components of each part, joined on rank 0 where parts share a vertex.
    label_components();
    // 2. What each part counts alone, and the edges that parts share.
    const std::vector<comm::Bytes> edges = world_.exchange(world_.collectively([&] { return count(); }));
    world_.collectively([&] { count_shared(edges); });
    // 3. The sums on rank 0.
    add_up();
    return std::move(result_);
  }

 private:
  void label_components();
  std::vector<std::uint32_t> joined(const std::vector<comm::Bytes>& components,
                                    const std::vector<comm::Bytes>& joints, std::uint32_t labels);
  std::vector<comm::Bytes> count();
  void count_shared(const std::vector<comm::Bytes>& messages);
  void count_edge(const SharedEdge& edge);
  void add_up();
  bool at_border(std::uint32_t a, std::uint32_t b) const;
  int owner_of(std::uint32_t vertex) const;

  comm::Communicator& world_;
  const MeshPart& part_;
  const Measure& measure_;
  MeshProperties result_;
  std::vector<ComponentTally> tallies_;    // by component of the whole that has something here
  std::vector<std::uint32_t> tally_of_;    // [component of the whole], or none
  std::vector<std::uint32_t> components_;  // of tallies_
  BoundaryEdges boundary_;

  ComponentTally& tally(std::uint32_t component);
};

void Counting::label_components() {
  Components local;
  std::uint32_t before = 0;
  world_.collectively([&] { local = components_of(part_.mesh); });
  std::uint32_t labels = local.count;
  comm::check(MPI_Exscan(&local.count, &before, 1, MPI_UINT32_T, MPI_SUM, world_.get()), "MPI_Exscan");
  if (world_.rank() == 0) before = 0;
  comm::check(MPI_Allreduce(MPI_IN_PLACE, &labels, 1, MPI_UINT32_T, MPI_SUM, world_.get()), "MPI_Allreduce");
  const auto own_labels = world_.collectively([&] {
    std::vector<std::uint32_t> of_own(part_.own);
    for (std::size_t v = 0; v < part_.own; ++v) of_own[v] = before + local.of_vertex[v];
    return of_own;
  });
  const auto there = fetch_for_guests<std::uint32_t>(world_, part_, own_labels);
  std::vector<comm::Bytes> components = world_.collectively([&] {
    std::vector<comm::Bytes> messages = no_messages(world_);
    std::vector<std::uint32_t> first(local.count, std::numeric_limits<std::uint32_t>::max());
    for (std::size_t v = 0; v < part_.numbers.size(); ++v)
      first[local.of_vertex[v]] = std::min(first[local.of_vertex[v]], part_.numbers[v]);
    for (std::uint32_t n = 0; n < local.count; ++n) append(messages[0], LocalComponent{before + n, first[n]});
    return messages;
  });
  components = world_.exchange(std::move(components));
  std::vector<comm::Bytes> joints = world_.collectively([&] {
    std::vector<comm::Bytes> messages = no_messages(world_);
    std::vector<Joint> some;
    for (std::size_t g = 0; g < there.size(); ++g)
      some.push_back({before + local.of_vertex[part_.own + g], there[g]});
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    for (const Joint& joint : some) append(messages[0], joint);
    return messages;
  });
  joints = world_.exchange(std::move(joints));
  // Rank 0 numbers the components of the whole, and tells each rank what its labels have become.
  std::vector<comm::Bytes> answers = world_.collectively([&] {
    std::vector<comm::Bytes> messages = no_messages(world_);
    if (world_.rank() != 0) return messages;
    const std::vector<std::uint32_t> number = joined(components, joints, labels);
    for (std::size_t rank = 0; rank < messages.size(); ++rank) {
      append(messages[rank], result_.components);
      for (std::size_t at = 0; at < components[rank].size(); at += sizeof(LocalComponent)) {
        LocalComponent one;
        std::memcpy(&one, components[rank].data() + at, sizeof one);
        append(messages[rank], number[one.label]);
      }
    }
    return messages;
  });
  answers = world_.exchange(std::move(answers));
  world_.collectively([&] {
    std::vector<std::uint32_t> number;
    each_of<std::uint32_t>(answers, [&](std::uint32_t value) { number.push_back(value); });
    result_.components = number.front();
    result_.component.reserve(local.of_vertex.size());
    for (const std::uint32_t component : local.of_vertex) result_.component.push_back(number[component + 1]);
    tally_of_.assign(result_.components, std::numeric_limits<std::uint32_t>::max());
  });
}

// By label: the number of its component in the whole.
std::vector<std::uint32_t> Counting::joined(const std::vector<comm::Bytes>& components,
                                            const std::vector<comm::Bytes>& joints, std::uint32_t labels) {
  Sets sets(labels);
  each_of<Joint>(joints, [&](const Joint& joint) { sets.join(joint.a, joint.b); });
  std::vector<std::uint32_t> first(labels, std::numeric_limits<std::uint32_t>::max());
  each_of<LocalComponent>(components, [&](const LocalComponent& one) {
    std::uint32_t& least = first[sets.find(one.label)];
    least = std::min(least, one.first);
  });
  std::vector<std::uint32_t> roots;
  for (std::uint32_t label = 0; label < labels; ++label) {
    if (sets.find(label) == label) roots.push_back(label);
  }
  std::sort(roots.begin(), roots.end(),
            [&](std::uint32_t a, std::uint32_t b) { return first[a] < first[b]; });
  std::vector<std::uint32_t> number(labels);
  for (std::uint32_t n = 0; n < roots.size(); ++n) number[roots[n]] = n;
  for (std::uint32_t label = 0; label < labels; ++label) number[label] = number[sets.find(label)];
  result_.components = static_cast<std::uint32_t>(roots.size());
  return number;
}

ComponentTally& Counting::tally(std::uint32_t component) {
  std::uint32_t& place = tally_of_[component];
  if (place == std::numeric_limits<std::uint32_t>::max()) {
    place = static_cast<std::uint32_t>(tallies_.size());
    tallies_.emplace_back();
    components_.push_back(component);
  }
  return tallies_[place];
}

// Whether an edge lies on a face of the volume.
bool Counting::at_border(std::uint32_t a, std::uint32_t b) const {
  const Point& p = part_.mesh.positions[a];
  const Point& q = part_.mesh.positions[b];
  const auto on_face = [&](float x, float y, int axis) {
    return x == y && (x == 0 || x == static_cast<float>(part_.volume[axis] - 1));
  };
  return on_face(p.i, q.i, 0) || on_face(p.j, q.j, 1) || on_face(p.k, q.k, 2);
}

int Counting::owner_of(std::uint32_t vertex) const {
  if (vertex < part_.own) return world_.rank();
  std::size_t before = part_.own;
  int rank = 0;
  for (; vertex >= before + part_.asked_from[static_cast<std::size_t>(rank)]; ++rank)
    before += part_.asked_from[static_cast<std::size_t>(rank)];
  return rank;
}

void Counting::count_edge(const SharedEdge& edge) {
  ComponentTally& to = tally(edge.component);
  ++to.edges;
  if (edge.up + edge.down == 1) {
    ++to.boundary_edges;
    ++(edge.at_border != 0 ? boundary_.at_border : boundary_.inside);
  }
  if (edge.up > 1 || edge.down > 1) ++to.non_manifold_edges;
}

std::vector<comm::Bytes> Counting::count() {
  const Surface& mesh = part_.mesh;
  const std::vector<std::uint32_t>& component = result_.component;
  for (std::uint32_t v = 0; v < part_.own; ++v) {
    const Point& p = mesh.positions[v];
    ComponentTally one;
    one.vertices = 1;
    one.lo = one.hi = p;
    one.first = mesh.keys[v];
    tally(component[v]).merge(one);
  }
  for (const Triangle& triangle : mesh.triangles.all()) {
    const Point& a = mesh.positions[triangle[0]];
    const Point& b = mesh.positions[triangle[1]];
    const Point& c = mesh.positions[triangle[2]];
    ComponentTally& to = tally(component[triangle[0]]);
    ++to.triangles;
    to.area.add(measure_.area(a, b, c));
    to.volume.add(Measure::volume(a, b, c));
  }
  std::vector<std::uint8_t> shared(mesh.positions.size(), 0);
  std::fill(shared.begin() + static_cast<std::ptrdiff_t>(part_.own), shared.end(), std::uint8_t{1});
  for (const std::vector<std::uint32_t>& asked : part_.asked_by) {
    for (const std::uint32_t vertex : asked) shared[vertex] = 1;
  }
  std::vector<comm::Bytes> messages = no_messages(world_);
  for_each_edge(mesh, [&](const Edge& edge) {
    SharedEdge one{part_.numbers[edge.a],
                   part_.numbers[edge.b],
                   edge.up,
                   edge.down,
                   component[edge.a],
                   at_border(edge.a, edge.b) ? 1U : 0U};
    if (shared[edge.a] == 0 || shared[edge.b] == 0) {
      count_edge(one);
      return;
    }
    const std::uint32_t lower = one.a < one.b ? edge.a : edge.b;
    if (one.a > one.b) {
      std::swap(one.a, one.b);
      std::swap(one.up, one.down);
    }
    append(messages[static_cast<std::size_t>(owner_of(lower))], one);
  });
  return messages;
}

void Counting::count_shared(const std::vector<comm::Bytes>& messages) {
  std::vector<SharedEdge> edges;
  each_of<SharedEdge>(messages, [&](const SharedEdge& edge) { edges.push_back(edge); });
  std::sort(edges.begin(), edges.end(),
            [](const SharedEdge& x, const SharedEdge& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  for (std::size_t n = 0; n < edges.size();) {
    SharedEdge whole = edges[n];
    for (++n; n < edges.size() && edges[n].a == whole.a && edges[n].b == whole.b; ++n) {
      whole.up += edges[n].up;
      whole.down += edges[n].down;
    }
    count_edge(whole);
  }
}

void Counting::add_up() {
  std::array<std::uint64_t, 2> boundary{boundary_.inside, boundary_.at_border};
  comm::check(MPI_Allreduce(MPI_IN_PLACE, boundary.data(), 2, MPI_UINT64_T, MPI_SUM, world_.get()),
              "MPI_Allreduce");
  const std::vector<comm::Bytes> told = world_.exchange(world_.collectively([&] {
    std::vector<comm::Bytes> messages = no_messages(world_);
    for (std::size_t n = 0; n < tallies_.size(); ++n)
      append(messages[0], ToldTally{components_[n], tallies_[n]});
    return messages;
  }));
  world_.collectively([&] {
    if (world_.rank() != 0) return;
    std::vector<ComponentTally> all(result_.components);
    each_of<ToldTally>(told, [&](const ToldTally& one) { all[one.component].merge(one.tally); });
    result_.properties = summary_of(std::move(all), {boundary[0], boundary[1], 0}, measure_);
  });
}

}  // namespace

MeshProperties mesh_properties(comm::Communicator& world, const MeshPart& part, const Measure& measure) {
  return Counting(world, part, measure).run();
}

MeshPart keep_components(comm::Communicator& world, const MeshPart& part, const MeshProperties& properties,
                         const Measure& measure, const ComponentFilter& filter) {
  const auto flags = world.collectively([&] {
    comm::Bytes bytes;
    if (world.rank() == 0) {
      for (const std::uint8_t flag : kept(properties.properties.components, measure, filter))
        append(bytes, flag);
    }
    return bytes;
  });
  const comm::Bytes all = world.broadcast(flags, 0);
  const auto own = world.collectively([&] {
    std::vector<std::uint8_t> of_own(part.own);
    for (std::size_t v = 0; v < part.own; ++v)
      of_own[v] = static_cast<std::uint8_t>(all[properties.component[v]]);
    return of_own;
  });
  return keep(world, part, own);
}

}  // namespace footwall::isosurface
