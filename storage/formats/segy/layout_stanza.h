// The stanza ((SEG: Layout)) of revision 2.1: a file's own description, in XML, of where its trace headers
// have what.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "storage/formats/segy/header_word.h"

namespace footwall::formats::segy {

struct LayoutStanza {
  std::string name;  // as the stanza calls itself, e.g. "rev2"
  std::optional<HeaderWord> inline_word, crossline_word, x, y, offset;
};

// text: all extended text headers, decoded, without line ends added. Nothing where there is no such stanza,
// or it names neither inline nor crossline. Entries of types that are not read, or outside the first 240
// bytes, are passed over.
std::optional<LayoutStanza> find_layout_stanza(std::string_view text);

}  // namespace footwall::formats::segy
