#include "engine/mesh/operation.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "storage/base/error.h"

namespace footwall::mesh {
namespace {

static_assert(std::endian::native == std::endian::little, "operations are sent as they stand in memory");

class Writer {
 public:
  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T> && std::has_unique_object_representations_v<T>);
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint32_t>(values.size()));
    for (const T& value : values) put(value);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  bool done() const { return bytes_.empty(); }

  template <typename T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    if (bytes_.size() < sizeof(T)) cut_off();
    T value;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_ = bytes_.subspan(sizeof value);
    return value;
  }
  template <typename T>
  std::vector<T> get_many() {
    const auto count = get<std::uint32_t>();
    if (count > bytes_.size() / sizeof(T)) cut_off();
    std::vector<T> values(count);
    for (T& value : values) value = get<T>();
    return values;
  }

 private:
  [[noreturn]] static void cut_off() {
    throw Error(ErrorCode::kFormat, "the mesh operations end in the middle of one");
  }
  std::span<const std::byte> bytes_;
};

enum class Apex : std::uint8_t { kPosition, kVertex };

void write(const CreateMesh& o, Writer& w) {
  w.put(o.positions);
  w.put(o.faces);
}
void write(const DestroyMesh& o, Writer& w) {
  w.put(o.mesh);
}
void write(const AddFace& o, Writer& w) {
  w.put(o.mesh);
  w.put(o.border_edge);
  const auto* position = std::get_if<LatticePoint>(&o.apex);
  w.put(position != nullptr ? Apex::kPosition : Apex::kVertex);
  if (position != nullptr) {
    w.put(*position);
  } else {
    w.put(std::get<VertexId>(o.apex));
  }
}
void write(const RemoveFaces& o, Writer& w) {
  w.put(o.mesh);
  w.put(o.vertex);
}
void write(const RemoveFace& o, Writer& w) {
  w.put(o.mesh);
  w.put(o.face);
}
void write(const MoveVertex& o, Writer& w) {
  w.put(o.mesh);
  w.put(o.vertex);
  w.put(o.to);
}
void write(const SplitEdge& o, Writer& w) {
  w.put(o.mesh);
  w.put(o.edge);
  w.put(o.at);
}

void read(CreateMesh& o, Reader& r) {
  o.positions = r.get_many<LatticePoint>();
  o.faces = r.get_many<std::array<VertexId, 3>>();
}
void read(DestroyMesh& o, Reader& r) {
  o.mesh = r.get<MeshId>();
}
void read(AddFace& o, Reader& r) {
  o.mesh = r.get<MeshId>();
  o.border_edge = r.get<EdgeId>();
  switch (r.get<std::uint8_t>()) {
    case static_cast<std::uint8_t>(Apex::kPosition):
      o.apex = r.get<LatticePoint>();
      break;
    case static_cast<std::uint8_t>(Apex::kVertex):
      o.apex = r.get<VertexId>();
      break;
    default:
      throw Error(ErrorCode::kFormat, "an ADD-FACE has neither a position nor a vertex");
  }
}
void read(RemoveFaces& o, Reader& r) {
  o.mesh = r.get<MeshId>();
  o.vertex = r.get<VertexId>();
}
void read(RemoveFace& o, Reader& r) {
  o.mesh = r.get<MeshId>();
  o.face = r.get<FaceId>();
}
void read(MoveVertex& o, Reader& r) {
  o.mesh = r.get<MeshId>();
  o.vertex = r.get<VertexId>();
  o.to = r.get<LatticePoint>();
}
void read(SplitEdge& o, Reader& r) {
  o.mesh = r.get<MeshId>();
  o.edge = r.get<EdgeId>();
  o.at = r.get<LatticePoint>();
}

// An operation whose index in the variant is `kind`.
template <std::size_t I = 0>
Operation read_kind(std::size_t kind, Reader& reader) {
  if constexpr (I == std::variant_size_v<Operation>) {
    throw Error(ErrorCode::kFormat, "there is no mesh operation " + std::to_string(kind));
  } else {
    if (kind != I) return read_kind<I + 1>(kind, reader);
    std::variant_alternative_t<I, Operation> operation;
    read(operation, reader);
    return operation;
  }
}

}  // namespace

std::string_view name_of(const Operation& operation) {
  static constexpr std::array<std::string_view, std::variant_size_v<Operation>> kNames{
      "CREATE-MESH", "DESTROY-MESH", "ADD-FACE", "REMOVE-FACES", "REMOVE-FACE", "MOVE-VERTEX", "SPLIT-EDGE"};
  return kNames[operation.index()];
}

std::vector<std::byte> encode(std::span<const Operation> operations) {
  Writer writer;
  for (const Operation& operation : operations) {
    writer.put(static_cast<std::uint8_t>(operation.index()));
    std::visit([&](const auto& each) { write(each, writer); }, operation);
  }
  return writer.take();
}

std::vector<Operation> decode(std::span<const std::byte> bytes) {
  Reader reader(bytes);
  std::vector<Operation> operations;
  while (!reader.done()) operations.push_back(read_kind(reader.get<std::uint8_t>(), reader));
  return operations;
}

}  // namespace footwall::mesh
