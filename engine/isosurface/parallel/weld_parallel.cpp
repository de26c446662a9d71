#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "engine/isosurface/parallel/detail/spread_numbers.h"
#include "engine/isosurface/parallel/detail/stretches.h"
#include "engine/isosurface/parallel/detail/vertex_order.h"
#include "engine/isosurface/parallel/weld.h"

namespace footwall::isosurface {
namespace {

using detail::VertexOrder;

constexpr std::uint32_t kGuest = 1U << 31;  // in `places`: what follows is the number of a guest

// A vertex of a piece, by where it stands in the whole.
struct Entry {
  std::uint64_t order = 0;
  std::uint32_t piece = 0;
  std::uint32_t vertex = 0;
};

// What the owner of a guest is told.
struct Guest {
  VertexKey key = 0;
  Point position;
  Point normal;
};

bool same_bits(const Point& a, const Point& b) {
  return std::bit_cast<std::array<std::uint32_t, 3>>(a) == std::bit_cast<std::array<std::uint32_t, 3>>(b);
}

// Sorts what consists of a few ascending stretches, as the vertices of pieces do.
void sort_stretches(std::vector<Entry>& entries) {
  const auto less = [](const Entry& a, const Entry& b) { return a.order < b.order; };
  std::vector<std::size_t> ends{0};
  for (std::size_t n = 1; n < entries.size(); ++n) {
    if (less(entries[n], entries[n - 1])) ends.push_back(n);
  }
  ends.push_back(entries.size());
  std::vector<Entry> merged(ends.size() > 2 ? entries.size() : 0);
  while (ends.size() > 2) {
    std::vector<std::size_t> left{0};
    for (std::size_t n = 0; n + 1 < ends.size(); n += 2) {
      const std::size_t end = n + 2 < ends.size() ? ends[n + 2] : ends[n + 1];
      const auto at = [&](std::size_t place) { return entries.begin() + static_cast<std::ptrdiff_t>(place); };
      std::merge(at(ends[n]), at(ends[n + 1]), at(ends[n + 1]), at(end),
                 merged.begin() + static_cast<std::ptrdiff_t>(ends[n]), less);
      left.push_back(end);
    }
    entries.swap(merged);
    ends.swap(left);
  }
}

class Welding {
 public:
  Welding(comm::Communicator& world, const Pillars& pillars, bool normals, std::vector<Piece>& pieces)
      : world_(world), pillars_(pillars), normals_(normals), order_(pillars), pieces_(pieces) {}

  MeshPart run() {
    // 1. The distinct vertices of this rank's pieces: its own, and guests.
    world_.collectively([&] { find_vertices(); });
    // 2. The owners of the guests learn of them.
    std::vector<comm::Bytes> guests = world_.exchange(world_.collectively([&] { return guests_by_owner(); }));
    world_.collectively([&] {
      match(guests);
      copy_vertices();
      copy_triangles();
    });
    // 3. All vertices and triangles are numbered.
    part_.all_vertices = number_runs(world_, part_.vertex_slots, part_.vertex_runs);
    part_.all_triangles = number_runs(world_, part_.triangle_slots, part_.triangle_runs);
    world_.collectively([&] {
      if (std::max(part_.all_vertices, part_.all_triangles) <= std::numeric_limits<std::uint32_t>::max())
        return;
      throw Error(ErrorCode::kUnsupported,
                  fmt::format("a surface of {} vertices and {} triangles cannot be numbered in 32 bits",
                              part_.all_vertices, part_.all_triangles),
                  "choose another isovalue, or a part of the volume");
    });
    detail::spread_numbers(world_, part_);
    return std::move(part_);
  }

 private:
  void find_vertices();
  std::vector<comm::Bytes> guests_by_owner();
  void match(const std::vector<comm::Bytes>& guests);
  void copy_vertices();
  void copy_triangles();

  comm::Communicator& world_;
  const Pillars& pillars_;
  bool normals_;
  VertexOrder order_;
  std::vector<Piece>& pieces_;
  MeshPart part_;

  std::vector<std::vector<std::uint32_t>> places_;  // of the vertices of each piece in the part
  std::vector<Entry> own_;                          // by order
  std::vector<Entry> guests_;                       // by order, then by owner
  std::vector<int> owners_;                         // of the guests
  std::vector<std::uint32_t> guest_places_;         // in the part, of guests by order
  std::vector<Guest> orphans_;  // own vertices that only other ranks found: their cells here hold nulls
};

void Welding::find_vertices() {
  std::uint64_t all = 0;
  for (const Piece& piece : pieces_) {
    const Surface& surface = piece.surface;
    require(surface.keys.size() == surface.positions.size(), "pieces to be welded have keys");
    require(!normals_ || surface.normals.size() == surface.positions.size(), "pieces have normals");
    all += piece.surface.positions.size();
  }
  if (all >= kGuest) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("rank {} has {} vertices; 2147483647 can be welded", world_.rank(), all),
                "use more ranks");
  }
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(all));
  places_.resize(pieces_.size());
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    const std::span<const VertexKey> keys = std::as_const(pieces_[p].surface.keys).all();
    places_[p].resize(keys.size());
    for (std::size_t v = 0; v < keys.size(); ++v)
      entries.push_back(
          {order_.of(keys[v]).order, static_cast<std::uint32_t>(p), static_cast<std::uint32_t>(v)});
  }
  sort_stretches(entries);
  for (std::size_t n = 0; n < entries.size();) {
    const Entry& first = entries[n];
    const Surface& surface = pieces_[first.piece].surface;
    const survey::Index cell = pillars_.cell_of(order_.of(surface.keys[first.vertex]).sample);
    const int owner = surface.cells.contains(cell) ? world_.rank() : pillars_.owner(cell);
    const bool is_own = owner == world_.rank();
    const auto place = is_own ? static_cast<std::uint32_t>(own_.size())
                              : kGuest | static_cast<std::uint32_t>(guests_.size());
    (is_own ? own_ : guests_).push_back(first);
    if (!is_own) owners_.push_back(owner);
    for (; n < entries.size() && entries[n].order == first.order; ++n)
      places_[entries[n].piece][entries[n].vertex] = place;
  }
  part_.computed = all;
}

std::vector<comm::Bytes> Welding::guests_by_owner() {
  std::vector<comm::Bytes> bytes(static_cast<std::size_t>(world_.size()));
  part_.asked_from.assign(bytes.size(), 0);
  for (const int owner : owners_) ++part_.asked_from[static_cast<std::size_t>(owner)];
  std::vector<std::uint32_t> next(bytes.size(), 0);  // the place of an owner's next guest, after all own ones
  for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
    bytes[rank].reserve(part_.asked_from[rank] * sizeof(Guest));
    if (rank > 0) next[rank] = next[rank - 1] + part_.asked_from[rank - 1];
  }
  guest_places_.reserve(guests_.size());
  for (std::size_t n = 0; n < guests_.size(); ++n) {
    const Surface& surface = pieces_[guests_[n].piece].surface;
    const std::uint32_t v = guests_[n].vertex;
    const Guest guest{surface.keys[v], surface.positions[v], normals_ ? surface.normals[v] : Point{}};
    const auto owner = static_cast<std::size_t>(owners_[n]);
    const auto* const from = reinterpret_cast<const std::byte*>(&guest);
    bytes[owner].insert(bytes[owner].end(), from, from + sizeof guest);
    guest_places_.push_back(next[owner]++);
  }
  return bytes;
}

// Finds the guests of other ranks among the own vertices.
void Welding::match(const std::vector<comm::Bytes>& guests) {
  const auto find = [&](std::uint64_t order) {
    return std::lower_bound(own_.begin(), own_.end(), order,
                            [](const Entry& entry, std::uint64_t wanted) { return entry.order < wanted; });
  };
  std::vector<std::vector<std::uint64_t>> orders(guests.size());
  std::vector<std::pair<std::uint64_t, Guest>> missing;
  for (std::size_t rank = 0; rank < guests.size(); ++rank) {
    const std::size_t count = guests[rank].size() / sizeof(Guest);
    orders[rank].reserve(count);
    for (std::size_t n = 0; n < count; ++n) {
      Guest guest;
      std::memcpy(&guest, guests[rank].data() + n * sizeof guest, sizeof guest);
      const std::uint64_t order = order_.of(guest.key).order;
      orders[rank].push_back(order);
      const auto found = find(order);
      if (found == own_.end() || found->order != order) {
        missing.emplace_back(order, guest);
        continue;
      }
      const Surface& surface = pieces_[found->piece].surface;
      if (!same_bits(surface.positions[found->vertex], guest.position) ||
          (normals_ && !same_bits(surface.normals[found->vertex], guest.normal))) {
        throw Error(ErrorCode::kInternal,
                    fmt::format("ranks {} and {} differ about vertex {}", world_.rank(), rank, guest.key));
      }
    }
  }
  if (!missing.empty()) {
    std::sort(missing.begin(), missing.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Entry> orphans;
    for (const auto& [order, guest] : missing) {
      if (!orphans.empty() && orphans.back().order == order) continue;
      // A piece beyond the last: see copy_vertices().
      orphans.push_back(
          {order, static_cast<std::uint32_t>(pieces_.size()), static_cast<std::uint32_t>(orphans_.size())});
      orphans_.push_back(guest);
    }
    std::vector<Entry> all;
    all.reserve(own_.size() + orphans.size());
    std::merge(own_.begin(), own_.end(), orphans.begin(), orphans.end(), std::back_inserter(all),
               [](const Entry& a, const Entry& b) { return a.order < b.order; });
    std::vector<std::uint32_t> moved(own_.size());
    std::size_t before = 0;
    for (std::size_t n = 0; n < own_.size(); ++n) {
      while (before < orphans.size() && orphans[before].order < own_[n].order) ++before;
      moved[n] = static_cast<std::uint32_t>(n + before);
    }
    for (std::vector<std::uint32_t>& places : places_) {
      for (std::uint32_t& place : places) place = (place & kGuest) != 0 ? place : moved[place];
    }
    own_.swap(all);
  }
  part_.asked_by.resize(guests.size());
  for (std::size_t rank = 0; rank < guests.size(); ++rank) {
    for (const std::uint64_t order : orders[rank])
      part_.asked_by[rank].push_back(static_cast<std::uint32_t>(find(order) - own_.begin()));
  }
}

void Welding::copy_vertices() {
  const std::size_t all = own_.size() + guests_.size();
  part_.volume = pillars_.volume();
  part_.own = own_.size();
  part_.mesh.positions.resize_uninitialised(all);
  part_.mesh.keys.resize_uninitialised(all);
  if (normals_) part_.mesh.normals.resize_uninitialised(all);
  const auto put = [&](std::size_t place, const Guest& vertex) {
    part_.mesh.positions[place] = vertex.position;
    part_.mesh.keys[place] = vertex.key;
    if (normals_) part_.mesh.normals[place] = vertex.normal;
  };
  const auto found = [&](const Entry& entry) {
    if (entry.piece == pieces_.size()) return orphans_[entry.vertex];
    const Surface& surface = pieces_[entry.piece].surface;
    return Guest{surface.keys[entry.vertex], surface.positions[entry.vertex],
                 normals_ ? surface.normals[entry.vertex] : Point{}};
  };
  for (std::size_t n = 0; n < own_.size(); ++n) {
    const Guest vertex = found(own_[n]);
    put(n, vertex);
    const std::uint64_t slot = order_.slot(order_.of(vertex.key));
    if (part_.vertex_runs.empty() || part_.vertex_runs.back().slot != slot)
      part_.vertex_runs.push_back({slot, 0, 0});
    ++part_.vertex_runs.back().count;
  }
  part_.vertex_slots = order_.slots();
  for (std::size_t n = 0; n < guests_.size(); ++n) put(own_.size() + guest_places_[n], found(guests_[n]));
}

void Welding::copy_triangles() {
  const std::vector<detail::Stretch> stretches = detail::stretches_of(pillars_, pieces_);
  std::size_t all = 0;
  for (const Piece& piece : pieces_) all += piece.surface.triangles.size();
  part_.mesh.triangles.resize_uninitialised(all);
  Triangle* to = part_.mesh.triangles.data();
  const auto own = static_cast<std::uint32_t>(own_.size());
  for (const detail::Stretch& stretch : stretches) {
    const std::vector<std::uint32_t>& places = places_[stretch.piece];
    const Triangle* const from = pieces_[stretch.piece].surface.triangles.data() + stretch.first;
    for (std::uint32_t n = 0; n < stretch.run.count; ++n, ++to) {
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t place = places[from[n][corner]];
        (*to)[corner] = (place & kGuest) != 0 ? own + guest_places_[place & ~kGuest] : place;
      }
    }
    part_.triangle_runs.push_back(stretch.run);
  }
  part_.triangle_slots = detail::triangle_slots(pillars_);
  std::vector<Piece>().swap(pieces_);
}

}  // namespace

MeshPart weld(comm::Communicator& world, const Pillars& pillars, bool normals, std::vector<Piece>& pieces) {
  return Welding(world, pillars, normals, pieces).run();
}

}  // namespace footwall::isosurface
