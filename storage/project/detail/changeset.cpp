#include "storage/project/detail/changeset.h"

#include <algorithm>

#include "storage/base/error.h"

namespace footwall::project::detail {
namespace {

// Operations and value types of the format; the operations are SQLITE_DELETE, SQLITE_INSERT and
// SQLITE_UPDATE.
constexpr std::uint8_t kTable = 'T', kDelete = 9, kInsert = 18, kUpdate = 23;
constexpr std::uint8_t kUndefined = 0, kInteger = 1, kReal = 2, kText = 3, kBlob = 4, kNull = 5;

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}
  bool done() const { return rest_.empty(); }

  std::uint8_t byte() { return std::to_integer<std::uint8_t>(take(1)[0]); }
  std::span<const std::byte> take(std::size_t count) {
    refuse_if(count > rest_.size());
    const auto front = rest_.first(count);
    rest_ = rest_.subspan(count);
    return front;
  }
  // Big-endian groups of seven bits; lengths here never need more than five of them.
  std::size_t varint() {
    std::size_t value = 0;
    for (int n = 0; n < 5; ++n) {
      const std::uint8_t next = byte();
      value = (value << 7) | (next & 0x7fU);
      if ((next & 0x80U) == 0) return value;
    }
    refuse_if(true);
    return 0;
  }
  std::string name() {
    std::string text;
    for (std::uint8_t c = byte(); c != 0; c = byte()) {
      text += static_cast<char>(c);
      refuse_if(text.size() > 64);
    }
    return text;
  }
  // One value; its type.
  std::uint8_t value() {
    const std::uint8_t type = byte();
    refuse_if(type > kNull);
    if (type == kInteger || type == kReal) take(8);
    if (type == kText || type == kBlob) take(varint());
    return type;
  }
  static void refuse_if(bool bad) {
    if (!bad) return;
    throw Error(ErrorCode::kCorrupt, "a step of the undo log is damaged", "restore the project from a copy");
  }

 private:
  std::span<const std::byte> rest_;
};

std::size_t read_header(Reader& reader, std::span<const ChangesetTable> tables) {
  const std::size_t columns = reader.varint();
  Reader::refuse_if(columns == 0 || columns > 100);
  for (std::size_t c = 0; c < columns; ++c) Reader::refuse_if(reader.byte() != (c == 0 ? 1 : 0));
  const std::string name = reader.name();
  const auto known =
      std::find_if(tables.begin(), tables.end(), [&](const auto& table) { return table.name == name; });
  Reader::refuse_if(known == tables.end() || columns > known->columns);
  return columns;
}

// A whole row, or one side of an update, in which columns that did not change are undefined.
void read_row(Reader& reader, std::size_t columns, bool whole, bool keyed) {
  for (std::size_t c = 0; c < columns; ++c) {
    const std::uint8_t type = reader.value();
    Reader::refuse_if(whole && type == kUndefined);
    Reader::refuse_if(keyed && c == 0 && type != kInteger);
  }
}

}  // namespace

void check_changeset(std::span<const std::byte> bytes, std::span<const ChangesetTable> tables) {
  Reader reader(bytes);
  std::size_t columns = 0;
  Reader::refuse_if(reader.done());
  while (!reader.done()) {
    const std::uint8_t what = reader.byte();
    if (what == kTable) {
      columns = read_header(reader, tables);
      continue;
    }
    Reader::refuse_if(columns == 0 || (what != kDelete && what != kInsert && what != kUpdate));
    Reader::refuse_if(reader.byte() > 1);  // the "indirect" flag
    read_row(reader, columns, what != kUpdate, true);
    if (what == kUpdate) read_row(reader, columns, false, false);
  }
}

}  // namespace footwall::project::detail
